// Checks of a text before it is parsed (encoding, control characters, direction marks), the blanks
// of the course dialect, and the choice of the dialect.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "grammar/parse.hpp"

namespace scenec::grammar {

struct CharacterFaults {
  static constexpr std::size_t none = std::string_view::npos;
  std::size_t first_control = none;  // NUL and others but tab and line ends
  std::size_t first_invalid = none;  // first byte that is not UTF-8
  std::vector<std::size_t> bidi_controls;
};
[[nodiscard]] CharacterFaults character_faults(std::string_view text, Dialect dialect);

// In course files blanks are C's isspace; `#` and `//` at the start of a word begin a comment.
[[nodiscard]] constexpr bool is_course_blank(char c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}
[[nodiscard]] std::size_t skip_course_trivia(std::string_view text, std::size_t offset);

}  // namespace scenec::grammar
