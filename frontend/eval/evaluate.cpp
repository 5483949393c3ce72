#include "frontend/eval/evaluate.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>

#include "base/text.hpp"
#include "frontend/eval/color.hpp"
#include "frontend/eval/operators.hpp"

namespace scenec::frontend {

using grammar::NodeRef;
using grammar::SyntaxKind;

namespace {

struct Numeral {
  std::string_view digits;
  std::string_view unit;
  bool real = false;  // has a point or an exponent
};

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

Numeral split_numeral(std::string_view text) {
  std::size_t i = 0;
  Numeral numeral;
  const auto skip_digits = [&] {
    while (i < text.size() && is_digit(text[i])) ++i;
  };
  skip_digits();
  if (i + 1 < text.size() && text[i] == '.' && is_digit(text[i + 1])) {
    ++i;
    skip_digits();
    numeral.real = true;
  }
  if (i < text.size() && text[i] == 'e') {
    const std::size_t sign =
        i + 1 < text.size() && (text[i + 1] == '+' || text[i + 1] == '-') ? 1 : 0;
    if (i + 1 + sign < text.size() && is_digit(text[i + 1 + sign])) {
      i += 1 + sign;
      skip_digits();
      numeral.real = true;
    }
  }
  numeral.digits = text.substr(0, i);
  numeral.unit = text.substr(i);
  return numeral;
}

int hex_digit(char c) {
  if (is_digit(c)) return c - '0';
  return (c | 0x20) - 'a' + 10;
}

Value color_literal(std::string_view text) {
  std::array<double, 3> linear{};
  const bool is_short = text.size() == 4;
  for (std::size_t i = 0; i < 3; ++i) {
    const int byte = is_short ? hex_digit(text[1 + i]) * 17
                              : hex_digit(text[1 + 2 * i]) * 16 + hex_digit(text[2 + 2 * i]);
    linear[i] = srgb_decoded(byte / 255.0);
  }
  return make_color(linear[0], linear[1], linear[2]);
}

void append_utf8(std::string& out, std::uint32_t point) {
  const auto put = [&](std::uint32_t byte) {
    out += static_cast<char>(static_cast<unsigned char>(byte));
  };
  if (point < 0x80) return put(point);
  if (point < 0x800) {
    put(0xC0 | (point >> 6));
  } else {
    if (point < 0x10000) {
      put(0xE0 | (point >> 12));
    } else {
      put(0xF0 | (point >> 18));
      put(0x80 | ((point >> 12) & 0x3F));
    }
    put(0x80 | ((point >> 6) & 0x3F));
  }
  put(0x80 | (point & 0x3F));
}

}  // namespace

// The grammar has reported broken escapes; here they stand for themselves.
std::string decoded_string(std::string_view quoted) {
  std::string text;
  if (quoted.size() < 2) return text;
  const std::string_view body = quoted.substr(1, quoted.size() - 2);
  for (std::size_t i = 0; i < body.size(); ++i) {
    if (body[i] != '\\' || i + 1 == body.size()) {
      text += body[i];
      continue;
    }
    const char escape = body[++i];
    if (escape == 'u' && i + 1 < body.size() && body[i + 1] == '{') {
      std::uint32_t point = 0;
      for (i += 2; i < body.size() && body[i] != '}'; ++i)
        point = (point * 16 + static_cast<std::uint32_t>(hex_digit(body[i]))) & 0x1FFFFF;
      append_utf8(text, point);
    } else {
      text += escape == 'n' ? '\n' : escape == 't' ? '\t' : escape;
    }
  }
  return text;
}

Value Evaluator::evaluate(NodeRef node, Scope& scope) {
  if (!node || !session_.spend(1, node.span())) return {};
  switch (node.kind()) {
    case SyntaxKind::number_literal:
      return number_literal(node);
    case SyntaxKind::string_literal:
      return make_string(decoded_string(node.text()), node.span().file);
    case SyntaxKind::color_literal:
      return color_literal(node.text());
    case SyntaxKind::enum_literal:
      return make_enumeration(node.text().substr(1));
    case SyntaxKind::bool_literal: {
      const Value value = make_bool(node.text() == "true");
      return session_.checking_only() ? type_of(value) : value;
    }
    case SyntaxKind::name_ref:
      return name_value(node, scope);
    case SyntaxKind::paren:
      return evaluate(ast::expression_of(node), scope);
    case SyntaxKind::unary:
      return unary(node, scope);
    case SyntaxKind::multiply_chain:
    case SyntaxKind::add_chain:
      return chain(node, scope);
    case SyntaxKind::comparison:
      return compare(node, scope);
    case SyntaxKind::and_chain:
    case SyntaxKind::or_chain:
      return logical_chain(node, scope);
    case SyntaxKind::list:
      return list(node, scope);
    case SyntaxKind::comprehension:
      return comprehension(node, scope);
    case SyntaxKind::member:
    case SyntaxKind::index:
    case SyntaxKind::call:
      return postfix(node, scope);
    default:
      return {};  // an error node: reported by the grammar
  }
}

Value Evaluator::number_literal(NodeRef node) {
  const char* place = node.text().data();
  const Value* known = numerals_.find(place);
  Value value = known != nullptr ? *known : read_number(node);
  if (known == nullptr && !value.poisoned()) numerals_.put(place, value);
  if (!session_.checking_only()) return value;
  Value type = type_of(value);
  type.literal_zero = value.literal_zero;
  return type;
}

Value Evaluator::read_number(NodeRef node) {
  const NodeRef token = node.find_child(SyntaxKind::number);
  const std::string_view text = token ? token.text() : node.text();
  const Numeral numeral = split_numeral(text);
  Value value;
  if (!numeral.real && numeral.unit.empty()) {
    std::int64_t integer = 0;
    const auto [end, error] = std::from_chars(
        numeral.digits.data(), numeral.digits.data() + numeral.digits.size(), integer);
    if (error != std::errc{}) {
      return session_.error(
          Diagnostic(DiagnosticKind::numeral_too_large, node.span(),
                     fmt::format("`{}` does not fit into a 64-bit integer", printable(text)))
              .hint("write it with a decimal point to make it a `num`"));
    }
    value = make_int(integer);
    value.literal_zero = integer == 0;
  } else {
    const auto number = parse_double(numeral.digits);
    if (!number) {
      return session_.error(
          DiagnosticKind::numeral_too_large, node.span(),
          fmt::format("`{}` is beyond the largest number, about 1.8e308", printable(text)));
    }
    if (numeral.unit.empty()) {
      value = make_number(*number);
    } else if (const auto unit = find_unit(numeral.unit)) {
      value = finite_number(session_, *number * unit->multiply / unit->divide, unit->dimension,
                            node.span(), printable(text));
    } else {
      std::array<std::string_view, 11> names;
      for (std::size_t i = 0; i < names.size(); ++i) names[i] = all_units()[i].suffix;
      const std::size_t unit_at =
          token ? token.span().begin + numeral.digits.size() : node.span().begin;
      const Span span{node.span().file, static_cast<std::uint32_t>(unit_at),
                      token ? token.span().end : node.span().end};
      session_.report(unknown_word(DiagnosticKind::unknown_unit, span,
                                   fmt::format("there is no unit `{}`", printable(numeral.unit)),
                                   numeral.unit, names, "units"));
      return {};
    }
  }
  return value;
}

Value Evaluator::unary(NodeRef node, Scope& scope) {
  bool negate = false, invert = false;
  for (NodeRef child : node.children()) {
    if (child.is(SyntaxKind::operator_token)) (child.text() == "-" ? negate : invert) = true;
  }
  const NodeRef operand = ast::expression_of(node);
  Value value = evaluate(operand, scope);
  if (negate && invert) {  // no type has both
    return session_.error(DiagnosticKind::operand_types, node.span(),
                          "`!` and `-` cannot be applied to one value");
  }
  for (NodeRef child : node.children()) {
    if (!child.is(SyntaxKind::operator_token)) continue;
    if (value.poisoned()) return {};
    if (negate) {
      value = negated(session_, value, node.span());
    } else {
      value = condition(session_, value, "!", operand);
      if (value.is(Type::boolean) && value.known) value = make_bool(!value.boolean());
    }
  }
  return value;
}

Value Evaluator::chain(NodeRef node, Scope& scope) {
  Value total;
  std::string_view op;
  NodeRef left;
  for (NodeRef child : node.children()) {
    if (child.is(SyntaxKind::operator_token)) {
      op = child.text();
    } else if (op.empty()) {
      total = evaluate(child, scope);
      left = child;
    } else {
      const Value right = evaluate(child, scope);
      const Span span{node.span().file, node.span().begin, child.span().end};
      total = arithmetic(session_, total, right,
                         {.op = op, .span = span, .left = left, .right = child});
      left = {};
    }
  }
  return total;
}

Value Evaluator::compare(NodeRef node, Scope& scope) {
  NodeRef left, right;
  std::string_view op;
  for (NodeRef child : node.children()) {
    if (child.is(SyntaxKind::operator_token)) {
      op = child.text();
    } else {
      (op.empty() ? left : right) = child;
    }
  }
  const Value a = evaluate(left, scope);
  const Value b = evaluate(right, scope);
  if (!right) return {};
  return comparison(session_, a, b, {.op = op, .span = node.span(), .left = left, .right = right});
}

Value Evaluator::logical_chain(NodeRef node, Scope& scope) {
  const bool stops_at = node.is(SyntaxKind::or_chain);  // the operand that decides
  Value result = make_bool(!stops_at);
  bool decided = false;
  for (NodeRef child : node.children()) {
    if (child.is(SyntaxKind::operator_token)) continue;
    if (decided) {  // not needed: only its types are checked
      const Session::CheckOnly check(session_);
      static_cast<void>(condition(session_, evaluate(child, scope), stops_at ? "||" : "&&", child));
      continue;
    }
    const Value operand =
        condition(session_, evaluate(child, scope), stops_at ? "||" : "&&", child);
    if (operand.poisoned()) {
      result = {};
      decided = true;
    } else if (!operand.known) {
      result.known = false;
    } else if (operand.boolean() == stops_at && result.known) {
      result = make_bool(stops_at);
      decided = true;
    }
  }
  return result;
}

}  // namespace scenec::frontend
