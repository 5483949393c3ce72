// What an expression evaluates to. A value is one cache line, copied freely: scalars, vectors and
// colours inside, everything longer shared on the heap and immutable.
// A poison value stands for a mistake already reported: it silences everything that uses it. A
// value that is not `known` has a type and no payload: bodies are checked with such values once,
// where they are written, before they are expanded.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/span.hpp"
#include "base/units.hpp"
#include "ir/values.hpp"

namespace scenec::frontend {

enum class Type : std::uint8_t {
  poison,
  boolean,
  integer,
  number,
  string,
  enumeration,  // `.name`, text on the heap
  color,
  vec2,  // also a list of two numbers
  vec3,  // also a list of three numbers
  list,
  transform,
  curve,
  texture,
  material,
  proto,
  filter,  // kind in `integer`, radius in n[0]
};

struct Heap;

struct Value {
  Type type = Type::poison;
  bool known = true;
  bool literal_zero = false;  // the numeral `0`, the only plain number that serves as an angle
  bool whole = false;         // a vector written with integers only: its elements are integers
  bool grey = false;          // a texture that serves as a number
  Dimension dimension;        // of numbers and vectors
  std::array<double, 3> n{};
  std::int64_t integer = 0;  // also: booleans, ids, and of a string the file it was written in
  std::shared_ptr<const Heap> heap;

  [[nodiscard]] bool poisoned() const { return type == Type::poison; }
  [[nodiscard]] bool is(Type wanted) const { return type == wanted; }
  [[nodiscard]] bool is_number() const { return type == Type::number || type == Type::integer; }
  [[nodiscard]] bool is_vector() const { return type == Type::vec2 || type == Type::vec3; }
  [[nodiscard]] std::size_t vector_size() const { return type == Type::vec2 ? 2 : 3; }
  [[nodiscard]] bool boolean() const { return integer != 0; }
  // Of integers and numbers.
  [[nodiscard]] double real() const {
    return type == Type::integer ? static_cast<double>(integer) : n[0];
  }
  [[nodiscard]] const std::string& text() const;
  [[nodiscard]] const std::vector<Value>& elements() const;
  [[nodiscard]] const ir::Transform& transform() const;
  [[nodiscard]] const ir::Curve& curve() const;
  [[nodiscard]] ir::Color color() const { return {n[0], n[1], n[2]}; }
  template <class Tag>
  [[nodiscard]] Id<Tag> id() const {
    return Id<Tag>(static_cast<std::uint32_t>(integer));
  }
};

using ValueList = std::vector<Value>;
struct Heap {
  std::variant<std::string, ValueList, ir::Transform, ir::Curve> content;
};

[[nodiscard]] Value make_bool(bool value);
[[nodiscard]] Value make_int(std::int64_t value);
[[nodiscard]] Value make_number(double value, Dimension dimension = {});
// `n` beyond the size is ignored.
[[nodiscard]] Value make_vector(std::size_t size, const std::array<double, 3>& n,
                                Dimension dimension = {});
[[nodiscard]] Value make_color(double r, double g, double b);
[[nodiscard]] Value make_string(std::string text, FileId file);
[[nodiscard]] Value make_enumeration(std::string_view name);
// A list; two or three numbers of one dimension become a vector. Elements must already agree.
[[nodiscard]] Value make_list(ValueList elements);
[[nodiscard]] Value make_transform(const ir::Transform& transform);
[[nodiscard]] Value make_curve(ir::Curve curve);
[[nodiscard]] Value make_texture(ir::TextureId id, bool grey);
[[nodiscard]] Value make_material(ir::MaterialId id);
[[nodiscard]] Value make_proto(ir::ProtoId id);
[[nodiscard]] Value make_filter(std::int64_t kind, double radius);
// A value of which only the type is known.
[[nodiscard]] Value make_unknown(Type type, Dimension dimension = {});
// The same type without the payload; lists keep one element as the pattern of all (stops of a ramp
// both of theirs).
[[nodiscard]] Value type_of(const Value& value);
// A list of which only the pattern of its elements is known; poison: not even that.
[[nodiscard]] Value make_unknown_list(const Value& pattern);
// Of a list of any length, as those two give it: element_count is not the number of its elements.
[[nodiscard]] bool has_any_length(const Value& value);
// Of such a list that serves as a vector if it turns out to have two or three elements.
[[nodiscard]] bool may_be_vector(const Value& value);
// `[0.5, red]`: the one list whose elements differ in type.
[[nodiscard]] bool is_ramp_stop(const ValueList& elements);

// Number of elements of a list or vector, and one of them.
[[nodiscard]] bool is_listlike(const Value& value);
[[nodiscard]] std::size_t element_count(const Value& value);
[[nodiscard]] Value element_of(const Value& value, std::size_t index);

// "a length", "an integer", "a vector of 3 lengths", "a list of 5": for messages.
[[nodiscard]] std::string described(const Value& value);
// "a length", "an angle", "a number".
[[nodiscard]] std::string with_article(Dimension dimension);
// "0.5 m": value and SI unit, for messages.
[[nodiscard]] std::string quantity_text(double value, Dimension dimension);

}  // namespace scenec::frontend
