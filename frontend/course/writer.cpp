#include "frontend/course/writer.hpp"

namespace scenec::frontend::course {

namespace {
constexpr std::size_t line_width = 100;
}

Text& Text::put(const Text& piece) {
  const auto shift = static_cast<std::uint32_t>(text_.size());
  text_ += piece.text_;
  for (DerivedRange range : piece.ranges_) {
    range.begin += shift;
    range.end += shift;
    ranges_.push_back(range);
  }
  return *this;
}

void Text::cover(std::size_t begin, Span origin) {
  if (!origin.valid() || begin == text_.size()) return;
  ranges_.push_back({static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(text_.size()),
                     origin.begin, origin.end});
}

void Item::add(std::string_view key, const Text& value, Span origin_of_field) {
  Text field;
  field.put(key).put(" = ").put(value);
  field.cover(0, origin_of_field);
  fields.push_back(std::move(field));
}

void write_indent(Text& out, std::size_t indent) {
  out.put(std::string(2 * indent, ' '));
}

void write_item(Text& out, const Item& item, std::size_t indent) {
  std::size_t width = 2 * indent + item.head.size() + 4;
  for (const Text& field : item.fields) width += field.size() + 2;
  const bool one_line = width <= line_width;
  write_indent(out, indent);
  const std::size_t begin = out.size();
  out.put(item.head).put(" {");
  for (const Text& field : item.fields) {
    if (one_line) {
      out.put(" ");
    } else {
      out.put("\n");
      write_indent(out, indent + 1);
    }
    out.put(field).put(";");
  }
  if (one_line) {
    out.put(" ");
  } else {
    out.put("\n");
    write_indent(out, indent);
  }
  out.put("}");
  out.cover(begin, item.origin);
  out.put("\n");
}

}  // namespace scenec::frontend::course
