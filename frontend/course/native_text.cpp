#include "frontend/course/native_text.hpp"

#include <cmath>
#include <cstdint>

#include "base/text.hpp"

namespace scenec::frontend::course {

namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

std::size_t skip_digits(std::string_view text, std::size_t at) {
  while (at < text.size() && is_digit(text[at])) ++at;
  return at;
}

// [-] digits [. digits], without superfluous leading zeros and short enough to be exact as an int.
bool is_native_numeral(std::string_view text) {
  if (text.starts_with('-')) text.remove_prefix(1);
  if (text.size() > 15 || text.empty() || !is_digit(text.front())) return false;
  if (text.size() > 1 && text[0] == '0' && is_digit(text[1])) return false;
  const std::size_t whole = skip_digits(text, 0);
  if (whole == text.size()) return true;
  if (text[whole] != '.') return false;
  return whole + 1 < text.size() && skip_digits(text, whole + 1) == text.size();
}

std::string numeral(double value) {
  if (value == 0) return "0";
  if (std::abs(value) < 1e15 && value == std::trunc(value)) {
    return std::to_string(static_cast<std::int64_t>(value));
  }
  return number_text(value);
}

std::string numeral_of(const Number& number) {
  if (number.value == 0) return "0";
  return is_native_numeral(number.text) ? std::string(number.text) : numeral(number.value);
}

template <class Items, class Write>
Text joined(std::string_view open, const Items& items, std::string_view close, Write&& write) {
  Text text;
  text.put(open);
  bool first = true;
  for (const auto& item : items) {
    if (!first) text.put(", ");
    first = false;
    write(text, item);
  }
  text.put(close);
  return text;
}

bool all_equal(double a, double b, double c) {
  return a == b && b == c;
}

}  // namespace

Text text_of(const Number& number) {
  return {numeral_of(number), number.span};
}

Text text_of_value(double value, Span origin) {
  return {numeral(value), origin};
}

Text list_of(std::span<const Number> numbers) {
  const std::size_t begin = 0;
  Text text =
      joined("[", numbers, "]", [](Text& out, const Number& number) { out.put(text_of(number)); });
  if (!numbers.empty()) text.cover(begin, join(numbers.front().span, numbers.back().span));
  return text;
}

Text list_of_values(std::span<const double> values, Span origin) {
  Text text = joined("[", values, "]", [](Text& out, double value) { out.put(numeral(value)); });
  text.cover(0, origin);
  return text;
}

Text color_of(std::span<const Number> numbers) {
  if (numbers.empty()) return "white";
  const Span span = join(numbers.front().span, numbers.back().span);
  if (numbers.size() < 3 || all_equal(numbers[0].value, numbers[1].value, numbers[2].value)) {
    if (numbers[0].value == 0) return {"black", span};
    if (numbers[0].value == 1) return {"white", span};
    Text text("gray(");
    text.put(text_of(numbers[0])).put(")");
    text.cover(0, span);
    return text;
  }
  Text text = joined("rgb(", numbers, ")",
                     [](Text& out, const Number& number) { out.put(text_of(number)); });
  text.cover(0, span);
  return text;
}

Text color_of_values(std::span<const double> values, Span origin) {
  if (values.size() >= 3 && all_equal(values[0], values[1], values[2])) {
    if (values[0] == 0) return {"black", origin};
    if (values[0] == 1) return {"white", origin};
    return {"gray(" + numeral(values[0]) + ")", origin};
  }
  Text text = joined("rgb(", values, ")", [](Text& out, double value) { out.put(numeral(value)); });
  text.cover(0, origin);
  return text;
}

Text degrees_of(const Number& number) {
  std::string text = numeral_of(number);
  if (text == "0") return {"0deg", number.span};
  return {text + "deg", number.span};
}

}  // namespace scenec::frontend::course
