#include "frontend/check/convert.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/text.hpp"
#include "frontend/check/invertible.hpp"
#include "frontend/eval/operators.hpp"
#include "ir/verify.hpp"

namespace scenec::frontend {

namespace {

std::string range_text(const ir::Range& range, Dimension dimension) {
  const auto quantity = [&](double value) { return quantity_text(value, dimension); };
  const bool low = std::isfinite(range.low), high = std::isfinite(range.high);
  if (low && high) {
    const std::string from =
        range.low_open ? "above " + quantity(range.low) : "from " + quantity(range.low);
    return fmt::format("a value {} {} {}", from,
                       range.high_open  ? "and below"
                       : range.low_open ? "and at most"
                                        : "to",
                       quantity(range.high));
  }
  if (low)
    return fmt::format("a value {} {}", range.low_open ? "above" : "of at least",
                       quantity(range.low));
  return fmt::format("a value {} {}", range.high_open ? "below" : "of at most",
                     quantity(range.high));
}

bool check_components(const KeyContext& key, const Value& value, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    if (!check_range(key, value.n[i], value.dimension)) return false;
  }
  return true;
}

// A key's value of a kind that is only referred to by id.
template <class Tag>
bool convert_id(const KeyContext& key, const Value& value, Type type, std::string_view wanted,
                Id<Tag>& out) {
  if (value.poisoned()) return false;
  if (!value.is(type)) {
    type_error(key.session, key.need, wanted, value);
    return false;
  }
  if (value.known) out = value.id<Tag>();
  return value.known;
}

}  // namespace

bool check_range(const KeyContext& key, double value, Dimension dimension) {
  if (key.range.contains(value)) return true;
  key.session.error(DiagnosticKind::out_of_range, key.need.span(),
                    fmt::format("{} is {}; needs {}", key.need.text(),
                                quantity_text(value, dimension), range_text(key.range, dimension)));
  return false;
}

bool convert_quantity(const KeyContext& key, const Value& value, Dimension dimension, double& out) {
  const Value quantity = coerce_quantity(key.session, value, dimension, key.need);
  if (quantity.poisoned() || !quantity.known || !check_range(key, quantity.n[0], dimension))
    return false;
  out = quantity.n[0];
  return true;
}

bool convert(const KeyContext& key, const Value& value, double& out) {
  return convert_quantity(key, value, dimension::none, out);
}

bool convert(const KeyContext& key, const Value& value, std::int64_t& out) {
  const Value integer = coerce(key.session, value, integer_type, key.need);
  if (integer.poisoned() || !integer.known || !check_range(key, integer.real(), {})) return false;
  out = integer.integer;
  return true;
}

bool convert(const KeyContext& key, const Value& value, std::uint32_t& out) {
  KeyContext bounded = key;
  bounded.range = ir::range::between(0, 4294967294.0);
  std::int64_t integer = 0;
  if (!convert(bounded, value, integer)) return false;
  out = static_cast<std::uint32_t>(integer);
  return true;
}

bool convert(const KeyContext& key, const Value& value, bool& out) {
  const Value flag = accepted(key.session, value, Accept::boolean, key.need);
  if (flag.poisoned() || !flag.known) return false;
  out = flag.boolean();
  return true;
}

bool convert(const KeyContext& key, const Value& value, ir::Vec2& out) {
  const Value vector = coerce_vector(key.session, value, 2, dimension::none, key.need);
  if (vector.poisoned() || !vector.known || !check_components(key, vector, 2)) return false;
  out = {vector.n[0], vector.n[1]};
  return true;
}

bool convert(const KeyContext& key, const Value& value, ir::Direction& out) {
  const Value vector = coerce_vector(key.session, value, 3, std::nullopt, key.need);
  if (vector.poisoned() || !vector.known) return false;
  out = {vector.n[0], vector.n[1], vector.n[2]};
  if (out.x != 0 || out.y != 0 || out.z != 0) return true;
  key.session.error(DiagnosticKind::zero_direction, key.need.span(),
                    fmt::format("{} is zero; needs a direction", key.need.text()));
  return false;
}

bool convert(const KeyContext& key, const Value& value, ir::Point3& out) {
  const Value vector = coerce_vector(key.session, value, 3, dimension::length, key.need);
  if (vector.poisoned() || !vector.known || !check_components(key, vector, 3)) return false;
  out = {vector.n[0], vector.n[1], vector.n[2]};
  return true;
}

bool convert(const KeyContext& key, const Value& value, ir::Color& out) {
  if (value.poisoned()) return false;
  const bool grey = value.is_number() && value.dimension.none();
  if (!grey && !value.is(Type::color)) {
    type_error(key.session, key.need, "a color such as `rgb(0.8, 0.2, 0.1)` or `#c83218`", value);
    return false;
  }
  if (!value.known ||
      !check_components(key, grey ? make_color(value.real(), value.real(), value.real()) : value,
                        3))
    return false;
  out = color_input(value).value;
  return true;
}

bool convert(const KeyContext& key, const Value& value, ir::ColorInput& out) {
  if (!value.is(Type::texture)) return convert(key, value, out.value);
  return convert(key, value, out.texture);
}

bool convert(const KeyContext& key, const Value& value, ir::NumberInput& out) {
  if (!value.is(Type::texture)) return convert(key, value, out.value);
  if (accepted(key.session, value, Accept::number_input, key.need).poisoned()) return false;
  return convert(key, value, out.texture);
}

bool convert(const KeyContext& key, const Value& value, ir::TextureId& out) {
  return convert_id(key, value, Type::texture, "a texture such as `image(\"wood.png\")`", out);
}
bool convert(const KeyContext& key, const Value& value, ir::MaterialId& out) {
  return convert_id(key, value, Type::material, "the name of a material", out);
}
bool convert(const KeyContext& key, const Value& value, ir::ProtoId& out) {
  return convert_id(key, value, Type::proto, "the name of a proto", out);
}

bool convert(const KeyContext& key, const Value& value, ir::AssetId& out) {
  const Value path = accepted(key.session, value, Accept::string, key.need);
  if (path.poisoned() || !path.known || key.session.checking_only()) return false;
  out = key.session.asset(path.text(), path.id<SourceFile>(), key.need.span());
  return out.valid();
}

bool convert(const KeyContext& key, const Value& value, std::string& out) {
  const Value text = accepted(key.session, value, Accept::string, key.need);
  if (text.poisoned() || !text.known) return false;
  out = text.text();
  return true;
}

bool convert(const KeyContext& key, const Value& value, ir::Curve& out) {
  if (value.poisoned()) return false;
  if (!value.is(Type::curve)) {
    type_error(key.session, key.need, "a curve such as `bezier([[0, 0], [0.1, 0.2]])`", value);
    return false;
  }
  if (value.known) out = value.curve();
  return value.known;
}

bool convert(const KeyContext& key, const Value& value, ir::Transform& out) {
  const Value transform = coerce_transform(key.session, value, key.need);
  if (transform.poisoned() || !transform.known) return false;
  if (!check_invertible(key.session, transform.transform(), key.need.span())) return false;
  out = transform.transform();
  const double determinant = ir::determinant(out);
  if (determinant < 0) {
    key.session.lint(
        Diagnostic(DiagnosticKind::mirrored_transform, key.need.span(),
                   fmt::format("the transform mirrors: its determinant is {}",
                               short_number_text(determinant)))
            .hint("use an even number of negative factors, or a rotation by `180deg`"));
  }
  return true;
}

bool convert(const KeyContext& key, const Value& value, ir::MeshNormals& out) {
  if (!is_listlike(value)) return convert(key, value, out.mode);
  return convert(key, value, out.list);
}

bool convert(const KeyContext& key, const Value& value, ir::FocusDistance& out) {
  if (!value.is(Type::enumeration)) return convert(key, value, out.distance);
  static constexpr std::array<std::string_view, 1> choices{"aim"};
  out.at_aim = choice_of(key.session, value, choices, key.need).has_value();
  return out.at_aim;
}

bool convert(const KeyContext& key, const Value& value, ir::PixelFilter& out) {
  if (value.poisoned()) return false;
  if (value.is(Type::filter)) {
    if (value.known) out = {static_cast<ir::FilterKind>(value.integer), value.n[0]};
    return value.known;
  }
  if (!value.is(Type::enumeration)) {
    type_error(key.session, key.need, "a pixel filter such as `tent(1.0)` or `.box`", value);
    return false;
  }
  if (!convert(key, value, out.kind)) return false;
  out.radius = ir::usual_radius(out.kind);
  return true;
}

bool convert(const KeyContext& key, const Value& value, ir::ImageSize& out) {
  std::array<std::int64_t, 2> size{};
  if (!convert(key, value, size)) return false;
  out = {size[0], size[1]};
  if (size[0] * size[1] <= ir::largest_pixel_count) return true;  // each is in its range
  key.session.error(DiagnosticKind::out_of_range, key.need.span(),
                    fmt::format("{} is {} x {} pixels; needs at most {} in all", key.need.text(),
                                size[0], size[1], ir::largest_pixel_count));
  return false;
}

bool convert(const KeyContext& key, const Value& value, ir::Region& out) {
  std::array<std::int64_t, 4> edges{};
  if (!convert(key, value, edges)) return false;
  out = {edges[0], edges[1], edges[2], edges[3]};
  return true;
}

}  // namespace scenec::frontend
