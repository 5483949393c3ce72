#include "grammar/split.hpp"

#include <algorithm>
#include <array>

#include "grammar/scan.hpp"

namespace scenec::grammar {

namespace {

// What a brace can hide behind, the braces themselves, and line ends.
constexpr std::array<bool, 256> is_mark = [] {
  std::array<bool, 256> table{};
  for (char c : {'"', '/', '{', '}', ';', '\n'}) table[static_cast<unsigned char>(c)] = true;
  return table;
}();

}  // namespace

ItemSplitter::ItemSplitter(std::string_view text, const ParseLimits& limits)
    : text_(text), longest_line_(limits.line), stuck_(text.size() > limits.file) {}

std::optional<TextPart> ItemSplitter::give_up() {
  stuck_ = true;
  return std::nullopt;
}

bool ItemSplitter::end_line() {
  const bool fits = place_ - line_begin_ <= longest_line_;
  line_begin_ = place_ + 1;
  return fits;
}

// Behind the `}` of a branch an `else` may follow, which belongs to it.
bool ItemSplitter::ends_item() const {
  const std::size_t next = scan::skip_trivia(text_, place_);
  return text_.substr(next, scan::name_end(text_, next) - next) != "else";
}

std::optional<TextPart> ItemSplitter::next(std::size_t least) {
  if (stuck_ || place_ == text_.size()) return std::nullopt;
  const std::size_t begin = place_;
  const auto part = [&] {
    return TextPart{static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(place_)};
  };
  while (true) {
    while (place_ < text_.size() && !is_mark[static_cast<unsigned char>(text_[place_])]) ++place_;
    if (place_ == text_.size()) {
      if (depth_ != 0 || !end_line()) return give_up();
      return part();
    }
    const bool is_long_enough = place_ + 1 - begin >= least;
    switch (text_[place_]) {
      case '\n':
        if (!end_line()) return give_up();
        ++place_;
        break;
      case '"':
        place_ = scan::token_end(text_, place_);
        break;
      case '/': {
        const char second = scan::at(text_, place_ + 1);
        if (second == '*') {
          // Its lines count as lines: what is behind the last line end begins one.
          const std::size_t end = scan::comment_end(text_, place_);
          if (end == std::string_view::npos) return give_up();
          while (place_ < end) {
            place_ = std::min(text_.find('\n', place_), end);
            if (place_ < end && !end_line()) return give_up();
            if (place_ < end) ++place_;
          }
        } else {
          place_ = second == '/' ? scan::comment_end(text_, place_) : place_ + 1;
        }
        break;
      }
      case '{':
        ++depth_;
        ++place_;
        break;
      case '}':
        if (depth_ == 0) return give_up();
        --depth_;
        ++place_;
        if (depth_ == 0 && is_long_enough && ends_item()) return part();
        break;
      default:
        ++place_;
        if (depth_ == 0 && is_long_enough) return part();
    }
  }
}

}  // namespace scenec::grammar
