// Whether a value serves where a type is required, and the value it becomes: the only place that
// knows the implicit conversions (int to num, plain number to SI, list to vector, list of
// transforms to transform) and the words for what does not fit.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/eval/value.hpp"
#include "frontend/session.hpp"
#include "grammar/syntax_tree.hpp"

namespace scenec::frontend {

// A declared type: `length`, `point`, `[color]`.
struct TypeRef {
  std::string_view name;  // of the innermost element
  Type type = Type::poison;
  Dimension dimension;
  bool number_or_length = false;  // vec2 and vec3 hold either
  int list_depth = 0;
};
inline constexpr TypeRef integer_type{"int", Type::integer, {}, false, 0};
[[nodiscard]] std::string text_of(const TypeRef& type);
[[nodiscard]] std::vector<std::string_view> type_names();
// nullopt when the type does not exist (reported) or is missing (a syntax error, reported before).
[[nodiscard]] std::optional<TypeRef> read_type(Session& session, grammar::NodeRef node);
// A value of that type with nothing else known.
[[nodiscard]] Value unknown_of(const TypeRef& type);

// What the value is needed for, kept as parts: text is made only when something is wrong.
struct Need {
  std::string_view subject;        // key, parameter or name
  std::string_view function = {};  // of an argument
  grammar::NodeRef node;           // the expression
  [[nodiscard]] Span span() const { return node.span(); }
  [[nodiscard]] std::string text() const;  // "`radius`", "`x` of `sqrt`"
};

// "needs a length such as `0.5m`; found an angle"; poison.
Value type_error(Session& session, const Need& need, std::string_view wanted, const Value& found);

[[nodiscard]] Value coerce(Session& session, const Value& value, const TypeRef& type,
                           const Need& need);
// A number of the dimension.
[[nodiscard]] Value coerce_quantity(Session& session, const Value& value, Dimension wanted,
                                    const Need& need);
// A vector of `size` components; with `dimension` nullopt plain numbers or lengths.
[[nodiscard]] Value coerce_vector(Session& session, const Value& value, std::size_t size,
                                  std::optional<Dimension> wanted, const Need& need);
[[nodiscard]] Value coerce_transform(Session& session, const Value& value, const Need& need);
// Refuses dimensions that have no name (m^2): bindings, arguments, keys and elements cannot hold
// them.
[[nodiscard]] Value coerce_named(Session& session, const Value& value, const Need& need);

// True when a plain number becomes this dimension by itself.
[[nodiscard]] constexpr bool adopts_si(Dimension wanted) {
  return wanted == dimension::length || wanted == dimension::time || wanted == dimension::power ||
         wanted == dimension::temperature;
}
[[nodiscard]] constexpr bool is_named(Dimension d) {
  return d.none() || d == dimension::angle || adopts_si(d);
}
// The common dimension of two operands, a plain number taking the other's; nullopt: they do not
// mix.
[[nodiscard]] std::optional<Dimension> common_dimension(const Value& a, const Value& b);
// The diagnostic when they do not.
Value mixed_dimensions(Session& session, Span span, std::string_view what, const Value& a,
                       const Value& b, grammar::NodeRef a_node, grammar::NodeRef b_node);

// Transforms applied in the order of the list.
[[nodiscard]] ir::Transform composed(const std::vector<Value>& transforms);

}  // namespace scenec::frontend
