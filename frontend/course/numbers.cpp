// Numerals as scanf reads them.
#include <string>

#include "base/text.hpp"
#include "frontend/course/reader.hpp"

namespace scenec::frontend::course {

std::optional<Number> number_of(grammar::NodeRef node) {
  if (!node.is(grammar::SyntaxKind::course_number)) return std::nullopt;
  std::string_view text = node.text();
  const Span span = node.span();
  std::string_view digits = text;
  if (digits.starts_with('+')) digits.remove_prefix(1);
  std::optional<double> value = parse_double(digits);
  if (!value && digits.ends_with('.')) value = parse_double(digits.substr(0, digits.size() - 1));
  if (!value) {
    // `.5`, `-.5`, `1.e3`: forms of the course's scanf that the numerals of the language lack.
    std::string padded;
    for (std::size_t i = 0; i < digits.size(); ++i) {
      const bool digit_before = i > 0 && digits[i - 1] >= '0' && digits[i - 1] <= '9';
      const bool digit_behind =
          i + 1 < digits.size() && digits[i + 1] >= '0' && digits[i + 1] <= '9';
      if (digits[i] == '.' && !digit_before) padded += '0';
      padded += digits[i];
      if (digits[i] == '.' && !digit_behind) padded += '0';
    }
    value = parse_double(padded);
  }
  if (!value) return std::nullopt;
  return Number{*value, span, text};
}

}  // namespace scenec::frontend::course
