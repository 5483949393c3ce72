// Cuts a large native text between top-level items, so that its parts can be parsed one by one or
// side by side. Exact about comments, strings and braces, blind to everything else: a part of a
// text without mistakes holds whole items, and where there are mistakes some part has one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "grammar/parse.hpp"

namespace scenec::grammar {

class ItemSplitter {
 public:
  explicit ItemSplitter(std::string_view text, const ParseLimits& limits = {});

  // The next part: it ends behind the first top-level item that ends `least` bytes or more behind
  // its begin, the last one with the text. nullopt behind the last part, and where the text cannot
  // be cut (a brace too many or too few, a comment without end, a line over the limit).
  [[nodiscard]] std::optional<TextPart> next(std::size_t least);
  // Every part was handed out.
  [[nodiscard]] bool finished() const { return place_ == text_.size() && !stuck_; }

 private:
  [[nodiscard]] bool ends_item() const;
  [[nodiscard]] bool end_line();
  std::optional<TextPart> give_up();

  std::string_view text_;
  std::size_t longest_line_;
  std::size_t place_ = 0;
  std::size_t line_begin_ = 0;
  std::size_t depth_ = 0;
  bool stuck_ = false;
};

}  // namespace scenec::grammar
