// Comments as the formatter writes them.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace scenec::frontend::layout {

// The comment with LF line ends and without blanks at the ends of its lines.
[[nodiscard]] std::string comment_text(std::string_view text);
// Moves all lines but the first from an indentation of `from` blanks to `to`; a line that has fewer
// blanks in front keeps what it can.
[[nodiscard]] std::string shifted_lines(std::string_view text, std::size_t from, std::size_t to);

}  // namespace scenec::frontend::layout
