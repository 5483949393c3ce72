// Builds native source together with the ranges of course text it came from. Texts are put together
// from texts: ranges move along, so pieces can be written in any order.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/source_map.hpp"
#include "base/span.hpp"

namespace scenec::frontend::course {

class Text {
 public:
  Text() = default;
  Text(std::string_view text) : text_(text) {}    // NOLINT: a text without origin
  Text(const char* text) : text_(text) {}         // NOLINT
  Text(const std::string& text) : text_(text) {}  // NOLINT
  Text(std::string_view text, Span origin) { put(text, origin); }

  Text& put(std::string_view text) {
    text_ += text;
    return *this;
  }
  Text& put(std::string_view text, Span origin) {
    const std::size_t begin = text_.size();
    text_ += text;
    cover(begin, origin);
    return *this;
  }
  Text& put(const std::string& text) { return put(std::string_view(text)); }
  Text& put(const char* text) { return put(std::string_view(text)); }
  Text& put(const Text& piece);
  // Everything written since `begin` came from `origin`; ignored when the origin is invalid.
  void cover(std::size_t begin, Span origin);

  [[nodiscard]] const std::string& text() const { return text_; }
  [[nodiscard]] std::size_t size() const { return text_.size(); }
  [[nodiscard]] bool empty() const { return text_.empty(); }
  [[nodiscard]] const std::vector<DerivedRange>& ranges() const { return ranges_; }
  [[nodiscard]] std::string take_text() && { return std::move(text_); }
  [[nodiscard]] std::vector<DerivedRange> take_ranges() && { return std::move(ranges_); }

 private:
  std::string text_;
  std::vector<DerivedRange> ranges_;
};

// `head { field; field; }` on one line when it fits, else one field a line. `origin` is the course
// block it came from.
struct Item {
  Text head;
  std::vector<Text> fields;  // `key = value`, without the semicolon
  Span origin;

  void add(std::string_view key, const Text& value, Span origin_of_field = {});
};
void write_item(Text& out, const Item& item, std::size_t indent);
void write_indent(Text& out, std::size_t indent);

}  // namespace scenec::frontend::course
