#include "frontend/eval/value.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/assert.hpp"
#include "base/text.hpp"

namespace scenec::frontend {

namespace {

template <class T>
const T& content_of(const Value& value) {
  SCENEC_ASSERT(value.heap != nullptr);
  return std::get<T>(value.heap->content);
}

template <class T>
Value on_heap(Type type, T content) {
  Value value;
  value.type = type;
  value.heap = std::make_shared<const Heap>(Heap{std::move(content)});
  return value;
}

template <class Tag>
Value with_id(Type type, Id<Tag> id) {
  Value value;
  value.type = type;
  value.integer = id.value();
  return value;
}

// Beyond it a double does not hold every integer, so such integers stay in a list.
constexpr std::int64_t largest_exact_integer = std::int64_t{1} << 53;

bool fits_vector(const ValueList& elements) {
  if (elements.size() != 2 && elements.size() != 3) return false;
  for (const Value& element : elements) {
    if (!element.is_number() || element.dimension != elements[0].dimension) return false;
    if (element.is(Type::integer) &&
        (element.integer > largest_exact_integer || element.integer < -largest_exact_integer)) {
      return false;
    }
  }
  return true;
}

}  // namespace

const std::string& Value::text() const {
  return content_of<std::string>(*this);
}
const ValueList& Value::elements() const {
  return content_of<ValueList>(*this);
}
const ir::Transform& Value::transform() const {
  return content_of<ir::Transform>(*this);
}
const ir::Curve& Value::curve() const {
  return content_of<ir::Curve>(*this);
}

Value make_bool(bool flag) {
  Value value;
  value.type = Type::boolean;
  value.integer = flag ? 1 : 0;
  return value;
}

Value make_int(std::int64_t number) {
  Value value;
  value.type = Type::integer;
  value.integer = number;
  return value;
}

Value make_number(double number, Dimension dimension) {
  Value value;
  value.type = Type::number;
  value.dimension = dimension;
  value.n[0] = number + 0.0;  // no negative zero in the scene
  return value;
}

Value make_vector(std::size_t size, const std::array<double, 3>& n, Dimension dimension) {
  Value value;
  value.type = size == 2 ? Type::vec2 : Type::vec3;
  value.dimension = dimension;
  for (std::size_t i = 0; i < size; ++i) value.n[i] = n[i] + 0.0;
  return value;
}

Value make_color(double r, double g, double b) {
  Value value;
  value.type = Type::color;
  value.n = {r + 0.0, g + 0.0, b + 0.0};
  return value;
}

Value make_string(std::string text, FileId file) {
  Value value = on_heap(Type::string, std::move(text));
  value.integer = file.value();
  return value;
}

Value make_enumeration(std::string_view name) {
  return on_heap(Type::enumeration, std::string(name));
}

Value make_list(ValueList elements) {
  if (!fits_vector(elements)) return on_heap(Type::list, std::move(elements));
  Value value = make_vector(elements.size(), {}, elements[0].dimension);
  value.whole = true;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    value.n[i] = elements[i].real();
    value.whole = value.whole && elements[i].is(Type::integer);
    value.known = value.known && elements[i].known;
  }
  return value;
}

Value make_transform(const ir::Transform& transform) {
  return on_heap(Type::transform, transform);
}
Value make_curve(ir::Curve curve) {
  return on_heap(Type::curve, std::move(curve));
}

Value make_texture(ir::TextureId id, bool grey) {
  Value value = with_id(Type::texture, id);
  value.grey = grey;
  return value;
}

Value make_material(ir::MaterialId id) {
  return with_id(Type::material, id);
}
Value make_proto(ir::ProtoId id) {
  return with_id(Type::proto, id);
}

Value make_filter(std::int64_t kind, double radius) {
  Value value;
  value.type = Type::filter;
  value.integer = kind;
  value.n[0] = radius;
  return value;
}

Value make_unknown(Type type, Dimension dimension) {
  Value value;
  value.type = type;
  value.dimension = dimension;
  value.known = false;
  return value;
}

Value type_of(const Value& value) {
  Value copy = value;
  if (value.poisoned()) return copy;
  copy.known = false;
  copy.literal_zero = false;
  copy.n = {};
  copy.integer = 0;
  if (!value.is(Type::list)) {
    copy.heap = nullptr;
    return copy;
  }
  if (value.heap == nullptr || value.elements().empty()) return make_unknown_list({});
  const ValueList& elements = value.elements();
  if (!is_ramp_stop(elements)) return make_unknown_list(type_of(elements.front()));
  copy = on_heap(Type::list, ValueList{type_of(elements[0]), type_of(elements[1])});
  copy.known = false;
  return copy;
}

Value make_unknown_list(const Value& pattern) {
  Value list = make_unknown(Type::list);
  if (!pattern.poisoned()) list = on_heap(Type::list, ValueList{pattern});
  list.known = false;
  return list;
}

bool has_any_length(const Value& value) {
  return value.is(Type::list) && !value.known && element_count(value) < 2;
}

bool may_be_vector(const Value& value) {
  return has_any_length(value) && (element_count(value) == 0 || value.elements()[0].is_number());
}

bool is_ramp_stop(const ValueList& elements) {
  return elements.size() == 2 && elements[0].is_number() && elements[1].is(Type::color);
}

bool is_listlike(const Value& value) {
  return value.is(Type::list) || value.is_vector();
}

std::size_t element_count(const Value& value) {
  if (value.is_vector()) return value.vector_size();
  return value.heap == nullptr ? 0 : value.elements().size();
}

Value element_of(const Value& value, std::size_t index) {
  if (!value.is_vector()) return value.elements()[index];
  Value element = value.whole ? make_int(static_cast<std::int64_t>(value.n[index]))
                              : make_number(value.n[index], value.dimension);
  element.known = value.known;
  return element;
}

std::string with_article(Dimension dimension) {
  const std::string name = name_of(dimension);
  return (name.front() == 'a' ? "an " : "a ") + name;
}

std::string quantity_text(double value, Dimension dimension) {
  const std::string unit = si_unit_of(dimension);
  if (dimension == dimension::angle) {
    return short_number_text(value * 180 / 3.141592653589793) + " deg";
  }
  return unit.empty() ? short_number_text(value) : short_number_text(value) + ' ' + unit;
}

namespace {

std::string described_vector(const Value& value) {
  const std::size_t size = value.vector_size();
  if (value.dimension.none()) return fmt::format("a list of {} numbers", size);
  if (value.dimension == dimension::length) return fmt::format("a list of {} lengths", size);
  return fmt::format("a list of {} values of dimension {}", size, name_of(value.dimension));
}

}  // namespace

std::string described(const Value& value) {
  switch (value.type) {
    case Type::poison:
      return "nothing";
    case Type::boolean:
      return "a truth value";
    case Type::integer:
      return "an integer";
    case Type::number:
      return with_article(value.dimension);
    case Type::string:
      return "a string";
    case Type::enumeration:
      return value.heap ? fmt::format("`.{}`", printable(value.text())) : "a choice";
    case Type::color:
      return "a color";
    case Type::vec2:
    case Type::vec3:
      return described_vector(value);
    case Type::list:
      return value.known ? fmt::format("a list of {}", element_count(value))
                         : std::string("a list");
    case Type::transform:
      return "a transform";
    case Type::curve:
      return "a curve";
    case Type::texture:
      return "a texture";
    case Type::material:
      return "a material";
    case Type::proto:
      return "a proto";
    case Type::filter:
      return "a pixel filter";
  }
  return "nothing";
}

}  // namespace scenec::frontend
