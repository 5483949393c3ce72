#include "frontend/eval/operators.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "base/text.hpp"
#include "frontend/eval/coerce.hpp"

namespace scenec::frontend {

using grammar::NodeRef;

Value finite_number(Session& session, double value, Dimension dimension, Span span,
                    std::string_view what) {
  if (std::isfinite(value)) return make_number(value, dimension);
  return session.error(DiagnosticKind::not_finite, span,
                       fmt::format("the result of `{}` is {}", what,
                                   std::isnan(value) ? "not a number" : "infinite"));
}

bool is_grey(const Value& value) {
  return value.is_number() || (value.is(Type::texture) && value.grey);
}

ir::ColorInput color_input(const Value& value) {
  if (value.is(Type::texture)) return {{}, value.id<ir::TextureNode>()};
  if (value.is_number()) return {{value.real(), value.real(), value.real()}, {}};
  return {value.color(), {}};
}

ir::NumberInput number_input(const Value& value) {
  if (value.is(Type::texture)) return {0, value.id<ir::TextureNode>()};
  return {value.real(), {}};
}

Value texture_product(Session& session, const Value& a, const Value& b) {
  const bool grey = is_grey(a) && is_grey(b);
  Value result = make_unknown(Type::texture);
  result.grey = grey;
  if (!a.known || !b.known) return result;
  return make_texture(
      session.builder.add_texture({ir::ProductTexture{color_input(a), color_input(b)}, grey}),
      grey);
}

namespace {

Value operand_error(Session& session, const Value& a, const Value& b, const Operation& where,
                    std::string_view hint = {}) {
  Diagnostic diagnostic(
      DiagnosticKind::operand_types, where.span,
      fmt::format("`{}` cannot combine {} and {}", where.op, described(a), described(b)));
  if (where.left) diagnostic.labels.push_back({where.left.span(), described(a)});
  if (where.right) diagnostic.labels.push_back({where.right.span(), described(b)});
  if (!hint.empty()) diagnostic.hints.emplace_back(hint);
  return session.error(std::move(diagnostic));
}

Value zero_divisor(Session& session, const Operation& where) {
  return session.error(DiagnosticKind::division_by_zero,
                       where.right ? where.right.span() : where.span,
                       fmt::format("the right side of `{}` is zero", where.op));
}

Value integer_arithmetic(Session& session, std::int64_t a, std::int64_t b, const Operation& where) {
  std::int64_t result = 0;
  bool overflow = false;
  switch (where.op.front()) {
    case '+':
      overflow = __builtin_add_overflow(a, b, &result);
      break;
    case '-':
      overflow = __builtin_sub_overflow(a, b, &result);
      break;
    case '*':
      overflow = __builtin_mul_overflow(a, b, &result);
      break;
    default:  // floored remainder
      if (b == 0) return zero_divisor(session, where);
      result = b == -1 ? 0 : a % b;
      if (result != 0 && (result < 0) != (b < 0)) result += b;
  }
  if (!overflow) return make_int(result);
  return session.error(
      Diagnostic(DiagnosticKind::integer_overflow, where.span,
                 fmt::format("`{} {} {}` does not fit into a 64-bit integer", a, where.op, b))
          .hint("write one factor with a decimal point to compute with `num`"));
}

double floored_remainder(double a, double b) {
  const double rest = std::fmod(a, b);
  return rest != 0 && (rest < 0) != (b < 0) ? rest + b : rest;
}

// Sum or difference of exponents; nullopt beyond what a dimension can hold.
std::optional<Dimension> dimension_product(Dimension a, Dimension b, int sign) {
  Dimension result;
  const auto combine = [&](std::int8_t Dimension::* exponent) {
    const int sum = a.*exponent + sign * b.*exponent;
    result.*exponent = static_cast<std::int8_t>(sum);
    return sum >= -100 && sum <= 100;
  };
  const bool fits = combine(&Dimension::length) && combine(&Dimension::angle) &&
                    combine(&Dimension::time) && combine(&Dimension::power) &&
                    combine(&Dimension::temperature);
  return fits ? std::optional(result) : std::nullopt;
}

std::optional<Dimension> result_dimension(Session& session, const Value& a, const Value& b,
                                          const Operation& where) {
  const char op = where.op.front();
  if (op == '*' || op == '/') {
    const auto product = dimension_product(a.dimension, b.dimension, op == '*' ? 1 : -1);
    if (!product)
      session.error(DiagnosticKind::compound_dimension, where.span,
                    "the dimension of the result is beyond any use");
    return product;
  }
  const auto common = common_dimension(a, b);
  if (!common) mixed_dimensions(session, where.span, where.op, a, b, where.left, where.right);
  return common;
}

Value number_arithmetic(Session& session, const Value& a, const Value& b, const Operation& where) {
  const char op = where.op.front();
  const bool integers = a.is(Type::integer) && b.is(Type::integer) && op != '/';
  const auto dimension = result_dimension(session, a, b, where);
  if (!dimension) return {};
  if (!a.known || !b.known)
    return make_unknown(integers ? Type::integer : Type::number, *dimension);
  if (integers) return integer_arithmetic(session, a.integer, b.integer, where);
  const double x = a.real(), y = b.real();
  double result = 0;
  switch (op) {
    case '+':
      result = x + y;
      break;
    case '-':
      result = x - y;
      break;
    case '*':
      result = x * y;
      break;
    default:
      if (y == 0) return zero_divisor(session, where);
      result = op == '/' ? x / y : floored_remainder(x, y);
  }
  return finite_number(session, result, *dimension, where.span, where.op);
}

Value finite_vector(Session& session, std::size_t size, const std::array<double, 3>& n,
                    Dimension dimension, const Operation& where) {
  for (double component : n) {
    if (!std::isfinite(component))
      return finite_number(session, component, dimension, where.span, where.op);
  }
  return make_vector(size, n, dimension);
}

// Vectors of one size are added; a vector is scaled by a number.
Value vector_arithmetic(Session& session, const Value& a, const Value& b, const Operation& where) {
  const char op = where.op.front();
  const bool additive = op == '+' || op == '-';
  if (additive != (a.is_vector() && b.is_vector()) || op == '%' || (op == '/' && b.is_vector())) {
    const bool product = op == '*' && a.is_vector() && b.is_vector();
    return operand_error(session, a, b, where, product ? "`dot` and `cross` multiply vectors" : "");
  }
  if (additive && a.type != b.type) return operand_error(session, a, b, where);
  const auto dimension = result_dimension(session, a, b, where);
  if (!dimension) return {};
  const Value& vector = a.is_vector() ? a : b;
  if (!a.known || !b.known) return make_unknown(vector.type, *dimension);
  if (op == '/' && b.real() == 0) return zero_divisor(session, where);
  std::array<double, 3> n{};
  for (std::size_t i = 0; i < vector.vector_size(); ++i) {
    const double x = a.is_vector() ? a.n[i] : a.real();
    const double y = b.is_vector() ? b.n[i] : b.real();
    n[i] = op == '+' ? x + y : op == '-' ? x - y : op == '*' ? x * y : x / y;
  }
  return finite_vector(session, vector.vector_size(), n, *dimension, where);
}

bool is_color_or_plain(const Value& value) {
  return value.is(Type::color) || (value.is_number() && value.dimension.none());
}

Value color_arithmetic(Session& session, const Value& a, const Value& b, const Operation& where) {
  const char op = where.op.front();
  const bool both = a.is(Type::color) && b.is(Type::color);
  const bool fits =
      op == '*' || ((op == '+' || op == '-') && both) || (op == '/' && !b.is(Type::color));
  if (!fits || !is_color_or_plain(a) || !is_color_or_plain(b))
    return operand_error(session, a, b, where);
  if (!a.known || !b.known) return make_unknown(Type::color);
  if (op == '/' && b.real() == 0) return zero_divisor(session, where);
  std::array<double, 3> n{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double x = a.is(Type::color) ? a.n[i] : a.real();
    const double y = b.is(Type::color) ? b.n[i] : b.real();
    n[i] = op == '+' ? x + y : op == '-' ? x - y : op == '*' ? x * y : x / y;
    if (!std::isfinite(n[i])) return finite_number(session, n[i], {}, where.span, where.op);
  }
  return make_color(n[0], n[1], n[2]);
}

Value texture_arithmetic(Session& session, const Value& a, const Value& b, const Operation& where) {
  const auto fits = [](const Value& value) {
    return value.is(Type::texture) || is_color_or_plain(value);
  };
  if (where.op != "*" || !fits(a) || !fits(b)) {
    return operand_error(session, a, b, where,
                         "textures are multiplied by numbers and colors, and blended by `mix`");
  }
  return texture_product(session, a, b);
}

}  // namespace

Value arithmetic(Session& session, const Value& a, const Value& b, const Operation& where) {
  if (a.poisoned() || b.poisoned() || may_be_vector(a) || may_be_vector(b)) return {};
  if (a.is_number() && b.is_number()) return number_arithmetic(session, a, b, where);
  if (a.is(Type::texture) || b.is(Type::texture)) return texture_arithmetic(session, a, b, where);
  const bool vectors = (a.is_vector() || a.is_number()) && (b.is_vector() || b.is_number());
  if (vectors) return vector_arithmetic(session, a, b, where);
  if (a.is(Type::color) || b.is(Type::color)) return color_arithmetic(session, a, b, where);
  if (a.is(Type::string) || b.is(Type::string))
    return operand_error(session, a, b, where, "`str(a, b)` joins texts");
  return operand_error(session, a, b, where);
}

Value negated(Session& session, const Value& value, Span span) {
  if (value.poisoned() || may_be_vector(value)) return {};
  if (value.is(Type::integer)) {
    if (!value.known) return value;
    if (value.integer == std::numeric_limits<std::int64_t>::min()) {
      return session.error(DiagnosticKind::integer_overflow, span,
                           "the negative does not fit into a 64-bit integer");
    }
    return make_int(-value.integer);
  }
  if (value.is(Type::number))
    return value.known ? make_number(-value.n[0], value.dimension) : value;
  if (value.is_vector()) {
    Value result = value;
    for (double& component : result.n) component = 0.0 - component;
    return result;
  }
  return session.error(DiagnosticKind::operand_types, span,
                       fmt::format("`-` needs a number or a vector; found {}", described(value)));
}

Value condition(Session& session, const Value& value, std::string_view subject, NodeRef node) {
  if (value.poisoned() || value.is(Type::boolean)) return value;
  return type_error(session, {.subject = subject, .node = node}, "`true` or `false`", value);
}

namespace {

bool equal_content(const Value& a, const Value& b) {
  switch (a.type) {
    case Type::boolean:
      return a.integer == b.integer;
    case Type::string:
    case Type::enumeration:
      return a.text() == b.text();
    default:
      return a.n == b.n;
  }
}

Value number_comparison(Session& session, const Value& a, const Value& b, const Operation& where) {
  if (!common_dimension(a, b))
    return mixed_dimensions(session, where.span, where.op, a, b, where.left, where.right);
  if (!a.known || !b.known) return make_unknown(Type::boolean);
  const auto decide = [&](auto x, auto y) {
    if (where.op == "==") return x == y;
    if (where.op == "!=") return x != y;
    if (where.op == "<") return x < y;
    if (where.op == "<=") return x <= y;
    if (where.op == ">") return x > y;
    return x >= y;
  };
  const bool integers = a.is(Type::integer) && b.is(Type::integer);
  return make_bool(integers ? decide(a.integer, b.integer) : decide(a.real(), b.real()));
}

}  // namespace

Value comparison(Session& session, const Value& a, const Value& b, const Operation& where) {
  if (a.poisoned() || b.poisoned() || may_be_vector(a) || may_be_vector(b)) return {};
  if (a.is_number() && b.is_number()) return number_comparison(session, a, b, where);
  const bool equality = where.op == "==" || where.op == "!=";
  const bool comparable = a.is(Type::boolean) || a.is(Type::string) || a.is(Type::color) ||
                          a.is_vector() || a.is(Type::enumeration);
  if (!equality || a.type != b.type || !comparable) {
    const bool ordered = !equality && a.type == b.type;
    return operand_error(session, a, b, where, ordered ? "only numbers have an order" : "");
  }
  if (a.is_vector() && !common_dimension(a, b)) {
    return mixed_dimensions(session, where.span, where.op, a, b, where.left, where.right);
  }
  if (!a.known || !b.known) return make_unknown(Type::boolean);
  return make_bool(equal_content(a, b) == (where.op == "=="));
}

}  // namespace scenec::frontend
