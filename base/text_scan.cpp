#include "base/text_scan.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cstring>
#include <system_error>

#include "base/limits.hpp"
#include "base/text.hpp"

namespace scenec {
namespace {

constexpr std::size_t shown_word = 40;

// After `from_chars` said out of range: did the value vanish rather than overflow?
bool is_tiny(std::string_view word) {
  const std::size_t exponent = word.find_first_of("eE");
  if (exponent != std::string_view::npos) {
    return exponent + 1 < word.size() && word[exponent + 1] == '-';
  }
  const std::size_t first = word.find_first_not_of("+-0");
  return first != std::string_view::npos && word[first] == '.';
}

bool is_comment(std::string_view line) {
  std::size_t i = 0;
  while (i < line.size() && is_blank(line[i])) ++i;
  return i < line.size() && line[i] == '#';
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

LineScanner::LineScanner(std::string_view bytes, std::size_t longest_line,
                         Continuation continuation)
    : rest_(bytes), longest_line_(longest_line), continuation_(continuation) {
  if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);
}

AssetProblem LineScanner::too_long_problem() const {
  return {line_, fmt::format("line longer than {} bytes", longest_line_), limit_option::line_bytes};
}

bool LineScanner::next_physical(std::string_view& line) {
  if (rest_.empty()) return false;
  const void* newline = std::memchr(rest_.data(), '\n', rest_.size());
  const std::size_t length =
      newline == nullptr
          ? rest_.size()
          : static_cast<std::size_t>(static_cast<const char*>(newline) - rest_.data());
  ++lines_read_;
  if (length > longest_line_) {
    too_long_ = true;
    return false;
  }
  line = rest_.substr(0, length);
  rest_.remove_prefix(newline == nullptr ? length : length + 1);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return true;
}

bool LineScanner::next(std::string_view& line) {
  line_ = lines_read_ + 1;
  if (!next_physical(line)) return false;
  if (continuation_ == Continuation::none || line.empty() || line.back() != '\\') return true;
  return is_comment(line) || join(line);
}

bool LineScanner::join(std::string_view& line) {
  joined_.clear();
  while (!line.empty() && line.back() == '\\') {
    joined_.append(line.substr(0, line.size() - 1));
    joined_.push_back(' ');
    line = {};
    if (!next_physical(line)) break;
    if (joined_.size() + line.size() > longest_line_) too_long_ = true;
    if (too_long_) return false;
  }
  if (too_long_) return false;
  joined_.append(line);
  line = joined_;
  return true;
}

std::string_view WordCursor::peek() const {
  const char* begin = cursor_;
  while (begin != end_ && is_blank(*begin)) ++begin;
  const char* stop = begin;
  while (stop != end_ && !is_blank(*stop)) ++stop;
  return {begin, static_cast<std::size_t>(stop - begin)};
}

std::string_view WordCursor::word() {
  const std::string_view found = peek();
  cursor_ = found.data() + found.size();
  return found;
}

std::string_view WordCursor::rest() const {
  return trimmed({cursor_, static_cast<std::size_t>(end_ - cursor_)});
}

NumberProblem WordCursor::number(double& value) {
  if (at_end()) return NumberProblem::missing;
  const char* begin = cursor_;
  if (*begin == '+' && end_ - begin > 1 && begin[1] != '-') ++begin;
  const std::from_chars_result result = std::from_chars(begin, end_, value);
  if (result.ptr != end_ && !is_blank(*result.ptr)) return NumberProblem::unparsable;
  if (result.ec == std::errc::invalid_argument) return NumberProblem::unparsable;
  if (result.ec == std::errc::result_out_of_range) {
    if (!is_tiny({begin, static_cast<std::size_t>(result.ptr - begin)})) {
      return NumberProblem::not_finite;
    }
    value = 0;
  }
  if (!std::isfinite(value)) return NumberProblem::not_finite;
  cursor_ = result.ptr;
  return NumberProblem::none;
}

std::string describe(NumberProblem problem, std::string_view word) {
  switch (problem) {
    case NumberProblem::missing:
      return "is missing";
    case NumberProblem::not_finite:
      return fmt::format("is `{}`; needs a finite number", printable(word, shown_word));
    case NumberProblem::none:
    case NumberProblem::unparsable:
      break;
  }
  return fmt::format("is `{}`; needs a number", printable(word, shown_word));
}

}  // namespace scenec
