// The value types that keys of the IR hold. All lengths are metres, angles radians, colours linear
// Rec. 709. No value is ever NaN, infinite or negative zero: lowering refuses or normalises them.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "base/ids.hpp"
#include "base/units.hpp"

namespace scenec::ir {

struct Vec2 {
  double x = 0, y = 0;
  friend constexpr auto operator<=>(const Vec2&, const Vec2&) = default;
};
// A dimensionless vector of any length, zero included.
struct Vec3 {
  double x = 0, y = 0, z = 0;
  friend constexpr auto operator<=>(const Vec3&, const Vec3&) = default;
};
// A dimensionless vector that is not zero; stored as written, normalised by who uses it.
struct Direction {
  double x = 0, y = 0, z = 1;
  friend constexpr auto operator<=>(const Direction&, const Direction&) = default;
};
// A position or displacement: three lengths, metres.
struct Point3 {
  double x = 0, y = 0, z = 0;
  friend constexpr auto operator<=>(const Point3&, const Point3&) = default;
};
struct Color {
  double r = 0, g = 0, b = 0;
  friend constexpr auto operator<=>(const Color&, const Color&) = default;
};
inline constexpr Color black{0, 0, 0};
inline constexpr Color white{1, 1, 1};

// Row-major affine matrix acting on column vectors; the last row is 0 0 0 1.
struct Transform {
  std::array<double, 16> m{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  friend constexpr auto operator<=>(const Transform&, const Transform&) = default;
  [[nodiscard]] constexpr bool is_identity() const { return *this == Transform{}; }
};
// `a * b` applies b first.
[[nodiscard]] Transform multiply(const Transform& a, const Transform& b);
[[nodiscard]] Point3 apply(const Transform& transform, const Point3& point);
[[nodiscard]] Vec3 apply_linear(const Transform& transform, const Vec3& vector);
[[nodiscard]] double determinant(const Transform& transform);  // of the linear part

// A file the scene reads. `path` is as messages and dumps name it; the bytes are what counts.
struct Asset;
using AssetId = Id<Asset>;

struct TextureNode;
using TextureId = Id<TextureNode>;

// A constant, or a texture where `texture` is valid.
template <class T>
struct Input {
  T value{};
  TextureId texture;
  friend constexpr auto operator<=>(const Input&, const Input&) = default;
};
using ColorInput = Input<Color>;
using NumberInput = Input<double>;

struct Material;
using MaterialId = Id<Material>;
struct Proto;
using ProtoId = Id<Proto>;
struct Camera;
using CameraId = Id<Camera>;

// The profile of a surface of revolution: points are [radius, height], metres.
enum class CurveKind : std::uint8_t { polyline, bezier, beziers, bspline };
struct Curve {
  CurveKind kind = CurveKind::polyline;
  bool clamped = true;  // bspline only
  std::vector<Vec2> points;
  friend auto operator<=>(const Curve&, const Curve&) = default;
};

// Names of the enumerators of E in their order, as an author writes them behind the dot.
template <class E>
struct EnumNames;
template <class E>
concept NamedEnum = requires { EnumNames<E>::names; };

}  // namespace scenec::ir
