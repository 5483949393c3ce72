#include "frontend/eval/coerce.hpp"

#include <fmt/format.h>

#include <array>

#include "base/text.hpp"

namespace scenec::frontend {

using grammar::NodeRef;
using grammar::SyntaxKind;

namespace {

constexpr std::array<TypeRef, 18> types{{
    {"num", Type::number, dimension::none},
    {"int", Type::integer, dimension::none},
    {"bool", Type::boolean, dimension::none},
    {"string", Type::string, dimension::none},
    {"length", Type::number, dimension::length},
    {"angle", Type::number, dimension::angle},
    {"time", Type::number, dimension::time},
    {"power", Type::number, dimension::power},
    {"temperature", Type::number, dimension::temperature},
    {"color", Type::color, dimension::none},
    {"vec2", Type::vec2, dimension::none, true},
    {"vec3", Type::vec3, dimension::none, true},
    {"point", Type::vec3, dimension::length},
    {"transform", Type::transform, dimension::none},
    {"curve", Type::curve, dimension::none},
    {"texture", Type::texture, dimension::none},
    {"material", Type::material, dimension::none},
    {"proto", Type::proto, dimension::none},
}};

const TypeRef* find_type(std::string_view name) {
  for (const TypeRef& type : types) {
    if (type.name == name) return &type;
  }
  return nullptr;
}

std::string_view example_of(Dimension wanted) {
  if (wanted == dimension::length) return " such as `0.5m`";
  if (wanted == dimension::angle) return " such as `60deg`";
  if (wanted == dimension::time) return " such as `2s`";
  if (wanted == dimension::power) return " such as `60W`";
  if (wanted == dimension::temperature) return " such as `4300K`";
  return "";
}

Value plain_angle(Session& session, const Need& need) {
  Diagnostic diagnostic(
      DiagnosticKind::plain_angle, need.span(),
      fmt::format("{} needs an angle such as `60deg`; found a number without a unit", need.text()));
  const NodeRef node = need.node;
  if (node.is(SyntaxKind::number_literal) ||
      (node.is(SyntaxKind::unary) && node.find_child(SyntaxKind::number_literal))) {
    const std::string repaired = std::string(node.text()) + "deg";
    diagnostic.fixits.push_back({need.span(), repaired});
  } else {
    diagnostic.hints.push_back("multiply by `1deg` or `1rad`");
  }
  return session.error(std::move(diagnostic));
}

}  // namespace

std::string text_of(const TypeRef& type) {
  const auto depth = static_cast<std::size_t>(type.list_depth);
  return std::string(depth, '[') + std::string(type.name) + std::string(depth, ']');
}

std::vector<std::string_view> type_names() {
  std::vector<std::string_view> names;
  for (const TypeRef& type : types) names.push_back(type.name);
  return names;
}

std::optional<TypeRef> read_type(Session& session, NodeRef node) {
  int depth = 0;
  while (node && node.is(SyntaxKind::type)) {
    if (const NodeRef name = node.find_child(SyntaxKind::name)) {
      if (const TypeRef* found = find_type(name.text())) {
        TypeRef type = *found;
        type.list_depth = depth;
        return type;
      }
      session.report(unknown_word(DiagnosticKind::unknown_type, name.span(),
                                  fmt::format("there is no type `{}`", printable(name.text())),
                                  name.text(), type_names(), "types"));
      return std::nullopt;
    }
    node = node.find_child(SyntaxKind::type);
    ++depth;
  }
  return std::nullopt;
}

Value unknown_of(const TypeRef& type) {
  if (type.list_depth > 0) {
    TypeRef element = type;
    --element.list_depth;
    return make_unknown_list(unknown_of(element));
  }
  if (type.number_or_length) return {};  // numbers or lengths: nothing can be said of its parts
  return make_unknown(type.type, type.dimension);
}

std::string Need::text() const {
  if (function.empty()) return fmt::format("`{}`", printable(subject));
  if (subject.empty()) return fmt::format("`{}`", printable(function));
  return fmt::format("`{}` of `{}`", printable(subject), printable(function));
}

Value type_error(Session& session, const Need& need, std::string_view wanted, const Value& found) {
  if (found.poisoned()) return {};
  return session.error(DiagnosticKind::type_mismatch, need.span(),
                       fmt::format("{} needs {}; found {}", need.text(), wanted, described(found)));
}

std::optional<Dimension> common_dimension(const Value& a, const Value& b) {
  if (a.dimension == b.dimension) return a.dimension;
  if (a.dimension.none() &&
      (adopts_si(b.dimension) || (a.literal_zero && b.dimension == dimension::angle)))
    return b.dimension;
  if (b.dimension.none() &&
      (adopts_si(a.dimension) || (b.literal_zero && a.dimension == dimension::angle)))
    return a.dimension;
  return std::nullopt;
}

Value mixed_dimensions(Session& session, Span span, std::string_view what, const Value& a,
                       const Value& b, NodeRef a_node, NodeRef b_node) {
  const auto plain_beside_angle = [](const Value& plain, const Value& angle) {
    return plain.dimension.none() && angle.dimension == dimension::angle;
  };
  if (plain_beside_angle(a, b) && a_node)
    return plain_angle(session, {.subject = what, .node = a_node});
  if (plain_beside_angle(b, a) && b_node)
    return plain_angle(session, {.subject = what, .node = b_node});
  Diagnostic diagnostic(DiagnosticKind::dimension_mismatch, span,
                        fmt::format("`{}` cannot combine {} and {}", what,
                                    with_article(a.dimension), with_article(b.dimension)));
  if (a_node) diagnostic.labels.push_back({a_node.span(), with_article(a.dimension)});
  if (b_node) diagnostic.labels.push_back({b_node.span(), with_article(b.dimension)});
  return session.error(std::move(diagnostic));
}

Value coerce_quantity(Session& session, const Value& value, Dimension wanted, const Need& need) {
  if (value.poisoned()) return {};
  if (!value.is_number())
    return type_error(session, need, with_article(wanted) + std::string(example_of(wanted)), value);
  const bool serves = value.dimension == wanted ||
                      (value.dimension.none() &&
                       (adopts_si(wanted) || (value.literal_zero && wanted == dimension::angle)));
  if (!serves) {
    if (value.dimension.none() && wanted == dimension::angle) return plain_angle(session, need);
    return session.error(DiagnosticKind::dimension_mismatch, need.span(),
                         fmt::format("{} needs {}{}; found {}", need.text(), with_article(wanted),
                                     example_of(wanted), with_article(value.dimension)));
  }
  if (!value.known) return make_unknown(Type::number, wanted);
  return make_number(value.real(), wanted);
}

Value coerce_vector(Session& session, const Value& value, std::size_t size,
                    std::optional<Dimension> wanted, const Need& need) {
  if (value.poisoned()) return {};
  const Type type = size == 2 ? Type::vec2 : Type::vec3;
  if (may_be_vector(value)) {
    if (element_count(value) == 0) return wanted ? make_unknown(type, *wanted) : Value{};
    const Dimension found = value.elements()[0].dimension;
    return coerce_vector(session, make_unknown(type, found), size, wanted, need);
  }
  if (!value.is(type)) {
    const bool lengths = wanted == dimension::length;
    return type_error(session, need,
                      fmt::format("a list of {} {}", size, lengths ? "lengths" : "numbers"), value);
  }
  const bool serves =
      wanted ? value.dimension == *wanted || (value.dimension.none() && adopts_si(*wanted))
             : value.dimension.none() || value.dimension == dimension::length;
  if (!serves) {
    return session.error(
        DiagnosticKind::dimension_mismatch, need.span(),
        fmt::format("{} needs a list of {} {}; found {}", need.text(), size,
                    wanted == dimension::length ? "lengths" : "numbers", described(value)));
  }
  Value vector = value;
  if (wanted && *wanted != value.dimension) {
    vector.dimension = *wanted;
    vector.whole = false;
  }
  return vector;
}

ir::Transform composed(const std::vector<Value>& transforms) {
  ir::Transform product;
  for (const Value& transform : transforms) product = ir::multiply(transform.transform(), product);
  return product;
}

Value coerce_transform(Session& session, const Value& value, const Need& need) {
  if (value.poisoned() || value.is(Type::transform)) return value;
  constexpr std::string_view wanted =
      "a transform such as `move([0, 1, 0])` or a list of transforms";
  if (!value.is(Type::list)) return type_error(session, need, wanted, value);
  if (value.heap == nullptr) return make_unknown(Type::transform);
  for (const Value& element : value.elements()) {
    if (element.poisoned()) return {};
    if (!element.is(Type::transform)) return type_error(session, need, wanted, value);
    if (!element.known) return make_unknown(Type::transform);
  }
  if (!value.known) return make_unknown(Type::transform);
  return make_transform(composed(value.elements()));
}

Value coerce_named(Session& session, const Value& value, const Need& need) {
  if ((!value.is_number() && !value.is_vector()) || is_named(value.dimension)) return value;
  return session.error(DiagnosticKind::compound_dimension, need.span(),
                       fmt::format("{} cannot hold a value of dimension `{}`", need.text(),
                                   name_of(value.dimension)));
}

namespace {

Value coerce_list(Session& session, const Value& value, const TypeRef& type, const Need& need) {
  if (value.poisoned()) return {};
  if (!is_listlike(value))
    return type_error(session, need, fmt::format("a list (`{}`)", text_of(type)), value);
  if (value.is(Type::list) && value.heap == nullptr) return unknown_of(type);
  TypeRef element_type = type;
  --element_type.list_depth;
  ValueList elements;
  elements.reserve(element_count(value));
  for (std::size_t i = 0; i < element_count(value); ++i) {
    elements.push_back(coerce(session, element_of(value, i), element_type, need));
    if (elements.back().poisoned()) return {};
  }
  Value list = make_list(std::move(elements));
  list.known = value.known;
  return list;
}

Value coerce_scalar(Session& session, const Value& value, const TypeRef& type, const Need& need) {
  switch (type.type) {
    case Type::number:
      return coerce_quantity(session, value, type.dimension, need);
    case Type::vec2:
    case Type::vec3:
      return coerce_vector(session, value, type.type == Type::vec2 ? 2 : 3,
                           type.number_or_length ? std::nullopt : std::optional(type.dimension),
                           need);
    case Type::transform:
      return coerce_transform(session, value, need);
    default:
      break;
  }
  if (value.is(type.type)) return value;
  if (type.type == Type::integer && value.is(Type::number) && value.dimension.none()) {
    return session.error(Diagnostic(DiagnosticKind::type_mismatch, need.span(),
                                    fmt::format("{} needs an integer; found a number", need.text()))
                             .hint("`floor`, `ceil` and `round` give integers"));
  }
  if (type.type == Type::texture && value.is(Type::color)) {
    if (!value.known) return make_unknown(Type::texture);
    const ir::Color color = value.color();
    return make_texture(session.builder.add_texture({ir::ConstantTexture{color}}),
                        color.r == color.g && color.g == color.b);
  }
  const bool vowel = type.name.front() == 'i';
  return type_error(session, need, fmt::format("{} `{}`", vowel ? "an" : "a", type.name), value);
}

}  // namespace

Value coerce(Session& session, const Value& value, const TypeRef& type, const Need& need) {
  if (value.poisoned()) return {};
  if (type.list_depth > 0) return coerce_list(session, value, type, need);
  Value coerced = coerce_scalar(session, value, type, need);
  coerced.literal_zero = false;
  return coerced;
}

}  // namespace scenec::frontend
