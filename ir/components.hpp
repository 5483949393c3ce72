// Walks the numbers inside a key's value, whatever its type: the common ground of range checks,
// finiteness checks and hashing.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "ir/cameras.hpp"
#include "ir/render_settings.hpp"
#include "ir/shapes.hpp"
#include "ir/values.hpp"

namespace scenec::ir {

template <class F>
void for_each_number(double value, F&& f) {
  f(value);
}
template <class T, class F>
  requires(std::integral<T> && !std::same_as<T, bool>)
void for_each_number(T value, F&& f) {
  f(static_cast<double>(value));
}
template <class Tag, class F>
void for_each_number(const Quantity<Tag>& value, F&& f) {
  f(value.value);
}
template <class F>
void for_each_number(const Vec2& v, F&& f) {
  f(v.x), f(v.y);
}
template <class T, class F>
  requires(std::same_as<T, Vec3> || std::same_as<T, Direction> || std::same_as<T, Point3>)
void for_each_number(const T& v, F&& f) {
  f(v.x), f(v.y), f(v.z);
}
template <class F>
void for_each_number(const Color& c, F&& f) {
  f(c.r), f(c.g), f(c.b);
}
template <class F>
void for_each_number(const Transform& t, F&& f) {
  for (double entry : t.m) f(entry);
}
template <class F>
void for_each_number(const FocusDistance& focus, F&& f) {
  if (!focus.at_aim) f(focus.distance.value);
}
template <class F>
void for_each_number(const PixelFilter& filter, F&& f) {
  f(filter.radius);
}
template <class F>
void for_each_number(const ImageSize& size, F&& f) {
  f(static_cast<double>(size.width)), f(static_cast<double>(size.height));
}
template <class F>
void for_each_number(const Region& r, F&& f) {
  for (std::int64_t edge : {r.x0, r.y0, r.x1, r.y1}) f(static_cast<double>(edge));
}
// Values without numbers of their own.
template <class T, class F>
  requires(std::same_as<T, bool> || std::is_enum_v<T>)
void for_each_number(T, F&&) {}
template <class Tag, class F>
void for_each_number(Id<Tag>, F&&) {}
template <class F>
void for_each_number(const std::string&, F&&) {}

template <class T, class F>
void for_each_number(const Input<T>& input, F&& f);
template <class T, class F>
void for_each_number(const std::optional<T>& value, F&& f);
template <class T, std::size_t N, class F>
void for_each_number(const std::array<T, N>& values, F&& f);
template <class T, class F>
void for_each_number(const std::vector<T>& values, F&& f);

template <class F>
void for_each_number(const MeshNormals& normals, F&& f) {
  for_each_number(normals.list, f);
}
template <class F>
void for_each_number(const Curve& curve, F&& f) {
  for_each_number(curve.points, f);
}

template <class T, class F>
void for_each_number(const Input<T>& input, F&& f) {
  if (!input.texture.valid()) for_each_number(input.value, f);
}
template <class T, class F>
void for_each_number(const std::optional<T>& value, F&& f) {
  if (value) for_each_number(*value, f);
}
template <class T, std::size_t N, class F>
void for_each_number(const std::array<T, N>& values, F&& f) {
  for (const T& value : values) for_each_number(value, f);
}
template <class T, class F>
void for_each_number(const std::vector<T>& values, F&& f) {
  for (const T& value : values) for_each_number(value, f);
}

}  // namespace scenec::ir
