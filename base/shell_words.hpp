// Words of a command line as a POSIX shell reads and writes them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace scenec {

// The word, in single quotes where a shell would read it as something else.
[[nodiscard]] std::string shell_word(std::string_view text);
// Blanks part words; single quotes, double quotes and backslashes quote. nullopt: a quote is open.
// Nothing is expanded.
[[nodiscard]] std::optional<std::vector<std::string>> shell_words(std::string_view line);

}  // namespace scenec
