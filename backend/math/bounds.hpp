// Axis-aligned boxes of doubles, closed; empty is min > max. Bounds of geometry are rounded
// outward by whoever computes them (`outward`).
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "backend/math/vec.hpp"

namespace scenec::backend {

// The neighbours of x, as std::nextafter (a call into libm) gives them.
[[nodiscard]] inline double next_up(double x) {
  if (!(x < std::numeric_limits<double>::infinity())) return x;  // infinity, NaN
  if (x == 0) return std::numeric_limits<double>::denorm_min();
  const auto bits = std::bit_cast<std::uint64_t>(x);
  return std::bit_cast<double>(x > 0 ? bits + 1 : bits - 1);
}
[[nodiscard]] inline double next_down(double x) {
  return -next_up(-x);
}

struct Bounds3 {
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  Point3 min{infinity, infinity, infinity};
  Point3 max{-infinity, -infinity, -infinity};

  friend constexpr bool operator==(const Bounds3&, const Bounds3&) = default;

  [[nodiscard]] bool empty() const { return !(min.x <= max.x && min.y <= max.y && min.z <= max.z); }
  [[nodiscard]] bool finite() const { return is_finite(min) && is_finite(max); }
  [[nodiscard]] Vector3 extent() const { return max - min; }
  [[nodiscard]] Point3 centroid() const {
    return {0.5 * min.x + 0.5 * max.x, 0.5 * min.y + 0.5 * max.y, 0.5 * min.z + 0.5 * max.z};
  }
  // Half the surface, 0 when empty.
  [[nodiscard]] double half_area() const {
    if (empty()) return 0;
    const Vector3 e = extent();
    return e.x * e.y + e.y * e.z + e.z * e.x;
  }
  void grow(const Point3& p) {
    // NaN never enters: the comparison is then false.
    if (p.x < min.x) min.x = p.x;
    if (p.y < min.y) min.y = p.y;
    if (p.z < min.z) min.z = p.z;
    if (p.x > max.x) max.x = p.x;
    if (p.y > max.y) max.y = p.y;
    if (p.z > max.z) max.z = p.z;
  }
  // An empty box changes nothing.
  void grow(const Bounds3& b) {
    min = {b.min.x < min.x ? b.min.x : min.x, b.min.y < min.y ? b.min.y : min.y,
           b.min.z < min.z ? b.min.z : min.z};
    max = {b.max.x > max.x ? b.max.x : max.x, b.max.y > max.y ? b.max.y : max.y,
           b.max.z > max.z ? b.max.z : max.z};
  }
  [[nodiscard]] bool contains(const Point3& p) const {
    return p.x >= min.x && p.x <= max.x && p.y >= min.y && p.y <= max.y && p.z >= min.z &&
           p.z <= max.z;
  }
  [[nodiscard]] bool contains(const Bounds3& b) const {
    return b.empty() || (contains(b.min) && contains(b.max));
  }
};

// The box grown on every side by the absolute `error` of its corners and one ulp for the rounding
// of the growth itself.
[[nodiscard]] inline Bounds3 outward(const Bounds3& b, const Vector3& error = {}) {
  return {
      {next_down(b.min.x - error.x), next_down(b.min.y - error.y), next_down(b.min.z - error.z)},
      {next_up(b.max.x + error.x), next_up(b.max.y + error.y), next_up(b.max.z + error.z)}};
}

}  // namespace scenec::backend
