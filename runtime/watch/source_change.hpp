// Writing a parameter's value back into the scene's file: one text is replaced, everything else
// stays byte for byte, and a file that somebody has changed meanwhile is left alone.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/hash.hpp"
#include "base/result.hpp"
#include "runtime/watch/attempt.hpp"

namespace scenec::runtime {

struct SourceChange {
  std::string path;
  Hash128 before;         // of the file the change was made for
  std::string text;       // the whole file as it will be
  std::string diff = {};  // unified, for people
};
// What putting `value` in the place of the default of the param makes of the file that the attempt
// has read; else why it cannot be done.
[[nodiscard]] Result<SourceChange, std::string> change_of_param(const Attempt& attempt,
                                                                std::string_view name,
                                                                const std::string& value);
// What went wrong, if something did. `hash`: of the file as the author has seen it.
[[nodiscard]] std::optional<std::string> apply_change(const SourceChange& change,
                                                      std::string_view hash);

}  // namespace scenec::runtime
