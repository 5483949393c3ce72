// The functions and constants of the language: one row a function (name, parameters, what it does).
// Arguments arrive bound, coerced and free of poison; a function works out the type of its result
// first, so that it also serves when only types are known.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "base/inline_list.hpp"
#include "frontend/eval/coerce.hpp"
#include "frontend/eval/value.hpp"
#include "frontend/session.hpp"
#include "grammar/syntax_tree.hpp"

namespace scenec::frontend {

enum class Accept : std::uint8_t {
  any,
  plain,  // number without dimension
  integer,
  angle,
  temperature,
  boolean,
  string,
  choice,  // `.name`
  list,    // list or vector
  vector,  // 2 or 3 components, any dimension
  vec2,    // 2 plain numbers
  vec3,    // 3 numbers of any one dimension
  offset,  // 3 lengths
  color,
  color_input,   // color, number or texture
  number_input,  // plain number or grey texture
};

struct Parameter {
  std::string_view name;
  Accept accept = Accept::any;
  bool required = true;
};

struct Call {
  Session& session;
  grammar::NodeRef node;  // the whole call
  std::string_view function;
  std::span<const Parameter> parameters;
  InlineList<Value, 4> arguments;         // parallel to parameters; variadic: as given
  InlineList<grammar::NodeRef, 4> nodes;  // empty where a default stands
  bool known = true;                      // every argument is

  [[nodiscard]] bool has(std::size_t i) const {
    return i < nodes.size() && static_cast<bool>(nodes[i]);
  }
  [[nodiscard]] const Value& operator[](std::size_t i) const { return arguments[i]; }
  [[nodiscard]] Need need(std::size_t i) const;
  [[nodiscard]] Span span() const { return node.span(); }
  [[nodiscard]] Span span(std::size_t i) const { return has(i) ? nodes[i].span() : node.span(); }
  // Reports that argument i lies outside the function's domain.
  Value outside(std::size_t i, std::string_view needs) const;
};

struct Builtin {
  std::string_view name;
  std::span<const Parameter> parameters;  // of a variadic function: one, which all arguments are
  Value (*run)(Call&);
  bool variadic = false;
};

[[nodiscard]] const Builtin* find_builtin(std::string_view name);
[[nodiscard]] std::vector<std::string_view> builtin_names();
[[nodiscard]] std::optional<Value> find_constant(std::string_view name);
[[nodiscard]] std::span<const std::string_view> constant_names();

// The value as what a parameter accepts; poison (reported) when it is not.
[[nodiscard]] Value accepted(Session& session, const Value& value, Accept accept, const Need& need);
// The choice of an enumeration: its index, or nullopt (reported).
[[nodiscard]] std::optional<std::size_t> choice_of(Session& session, const Value& value,
                                                   std::span<const std::string_view> names,
                                                   const Need& need);

// The rows, by theme.
[[nodiscard]] std::span<const Builtin> number_functions();
[[nodiscard]] std::span<const Builtin> list_functions();
[[nodiscard]] std::span<const Builtin> vector_functions();
[[nodiscard]] std::span<const Builtin> color_functions();
[[nodiscard]] std::span<const Builtin> texture_functions();
[[nodiscard]] std::span<const Builtin> geometry_functions();

}  // namespace scenec::frontend
