// Values of keys as source text in canonical form: SI numbers, shortest exact, whole numbers
// without a point, angles with `rad`. Ids are printed by who knows their names.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "ir/cameras.hpp"
#include "ir/render_settings.hpp"
#include "ir/shapes.hpp"
#include "ir/values.hpp"

namespace scenec::ir {

[[nodiscard]] std::string value_text(bool value);
[[nodiscard]] std::string value_text(std::int64_t value);
[[nodiscard]] std::string value_text(std::uint32_t value);
[[nodiscard]] std::string value_text(double value);
[[nodiscard]] std::string value_text(const std::string& value);  // a string literal
[[nodiscard]] std::string value_text(Angle value);
template <class Tag>
[[nodiscard]] std::string value_text(Quantity<Tag> value) {
  return value_text(value.value);
}
[[nodiscard]] std::string value_text(const Vec2& v);
[[nodiscard]] std::string value_text(const Vec3& v);
[[nodiscard]] std::string value_text(const Direction& v);
[[nodiscard]] std::string value_text(const Point3& v);
[[nodiscard]] std::string value_text(const Color& c);
[[nodiscard]] std::string value_text(const Transform& t);
[[nodiscard]] std::string value_text(const Curve& c);
[[nodiscard]] std::string value_text(const MeshNormals& n);
[[nodiscard]] std::string value_text(const FocusDistance& f);
[[nodiscard]] std::string value_text(const PixelFilter& f);
[[nodiscard]] std::string value_text(const ImageSize& s);
[[nodiscard]] std::string value_text(const Region& r);
template <NamedEnum E>
[[nodiscard]] std::string value_text(E value) {
  return "." + std::string(EnumNames<E>::names[static_cast<std::size_t>(value)]);
}

template <class T>
[[nodiscard]] std::string list_text(const T& values) {
  std::string text = "[";
  for (const auto& value : values) {
    if (text.size() > 1) text += ", ";
    if constexpr (requires { value_text(value); }) {
      text += value_text(value);
    } else {
      text += list_text(value);
    }
  }
  return text + "]";
}
template <class T, std::size_t N>
[[nodiscard]] std::string value_text(const std::array<T, N>& values) {
  return list_text(values);
}
template <class T>
[[nodiscard]] std::string value_text(const std::vector<T>& values) {
  return list_text(values);
}

}  // namespace scenec::ir
