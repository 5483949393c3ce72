// A native text in a file read as course text, and the other way round, would be a page of
// consequences: it is one error that says how to have it read right.
#pragma once

#include <optional>
#include <string_view>

#include "base/diagnostic.hpp"
#include "base/span.hpp"
#include "grammar/parse.hpp"

namespace scenec::frontend {

// The error for a text whose first word belongs to the other dialect; nothing for all others.
[[nodiscard]] std::optional<Diagnostic> find_wrong_dialect(FileId file, std::string_view text,
                                                           grammar::Dialect dialect);

}  // namespace scenec::frontend
