// Reading line-oriented asset text (OBJ, MTL, ascii PLY): logical lines with their numbers, and
// blank-separated numbers and words within a line. Locale-free; never reads outside the bytes.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/asset_problem.hpp"

namespace scenec {

[[nodiscard]] constexpr bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}
[[nodiscard]] std::string_view trimmed(std::string_view text);

// Line ends are LF or CR LF, the last one may be missing; a UTF-8 byte order mark is read over.
class LineScanner {
 public:
  enum class Continuation : std::uint8_t { none, backslash };

  LineScanner(std::string_view bytes, std::size_t longest_line, Continuation continuation);

  // The next line without its end. With `backslash`, a line that ends in one continues on the next
  // (a blank stands in between); comment lines never do, as exporters end them in paths.
  // The view is good until the next call. False: no more lines, or the line is too long.
  bool next(std::string_view& line);
  // Of the line returned last: where it began.
  [[nodiscard]] std::uint64_t line() const { return line_; }
  [[nodiscard]] bool too_long() const { return too_long_; }
  [[nodiscard]] AssetProblem too_long_problem() const;
  // Bytes not yet handed out.
  [[nodiscard]] std::string_view rest() const { return rest_; }

 private:
  bool next_physical(std::string_view& line);
  bool join(std::string_view& line);

  std::string_view rest_;
  std::size_t longest_line_;
  Continuation continuation_;
  std::uint64_t line_ = 0;
  std::uint64_t lines_read_ = 0;
  bool too_long_ = false;
  std::string joined_;
};

// Hands out line after line as long as `take(line)` answers true. True: all lines were handed out.
// A line that is too long ends it and is told in `problem`.
template <class Take>
bool for_each_line(LineScanner& scanner, AssetProblem& problem, Take&& take) {
  std::string_view line;
  while (scanner.next(line)) {
    if (!take(line)) return false;
  }
  if (scanner.too_long()) problem = scanner.too_long_problem();
  return !scanner.too_long();
}

enum class NumberProblem : std::uint8_t { none, missing, unparsable, not_finite };

// Walks over the words of one line; `#` begins a comment where `comments` says so.
class WordCursor {
 public:
  explicit WordCursor(std::string_view line)
      : cursor_(line.data()), end_(line.data() + line.size()) {}

  void skip_blanks() {
    while (cursor_ != end_ && is_blank(*cursor_)) ++cursor_;
  }
  // Nothing but blanks and perhaps a `#` comment is left.
  [[nodiscard]] bool at_end() {
    skip_blanks();
    return cursor_ == end_ || *cursor_ == '#';
  }
  // The word at the cursor, up to a blank; empty at the end.
  [[nodiscard]] std::string_view word();
  // As `word`, without moving on.
  [[nodiscard]] std::string_view peek() const;
  // What is left of the line, trimmed (a `#` is part of it).
  [[nodiscard]] std::string_view rest() const;
  // A decimal number that fills a whole word. Values below the smallest double become zero.
  [[nodiscard]] NumberProblem number(double& value);

  [[nodiscard]] const char* position() const { return cursor_; }
  [[nodiscard]] const char* end() const { return end_; }
  void move_to(const char* position) { cursor_ = position; }

 private:
  const char* cursor_;
  const char* end_;
};

// "is missing", "`1.2.3` is not a number", "`nan` is not finite": the end of a sentence.
[[nodiscard]] std::string describe(NumberProblem problem, std::string_view word);

}  // namespace scenec
