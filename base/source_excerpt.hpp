// One source line as a terminal shows it: tabs expanded, control characters escaped, and a long
// line cut round the place of interest. Knows in which column each byte of the line ended up. Looks
// only at bytes near that place, so a line of 64 MiB costs no more than a short one.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace scenec {

class SourceExcerpt {
 public:
  struct Columns {
    std::size_t begin;  // 0-based, in terminal columns of text()
    std::size_t width;  // at least 1
  };

  // [begin, end) is the place of interest, in bytes of `line`; the text is at most `max_width`
  // columns wide.
  SourceExcerpt(std::string_view line, std::size_t begin, std::size_t end, std::size_t max_width);

  [[nodiscard]] const std::string& text() const { return text_; }
  // Where the bytes [begin, end) stand; what was cut off is clamped to the nearer edge.
  [[nodiscard]] Columns columns(std::size_t begin, std::size_t end) const;

 private:
  struct Cell {
    std::size_t offset;  // in the line
    std::size_t column;  // in text_
  };
  [[nodiscard]] std::size_t column_of(std::size_t offset) const;

  std::string text_;
  std::vector<Cell> cells_;  // by offset; the last one stands behind the last code point shown
};

}  // namespace scenec
