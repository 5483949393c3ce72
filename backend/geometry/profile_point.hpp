// Points and tangents of one Bezier segment of a profile, and the coordinates about its axis.
//
// Domain:     degree 1..15, s in [0, 1].
// Method:     de Casteljau, stable on [0, 1].
// Error:      gamma(2 n) of the largest control coordinate.
// Degenerate: where the derivative vanishes the tangent is that of the limit; a segment that is one
//             point has none (zero).
// Proof:      tests/unit/backend/geometry/revolve_test.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "backend/geometry/revolve.hpp"

namespace scenec::backend {

struct ProfileJet {
  ProfilePoint point;
  ProfilePoint slope;  // d/ds
};

// The same for coordinates in two rows, which are used up.
[[nodiscard]] inline ProfileJet evaluate_in_place(double* radius, double* height, std::size_t n,
                                                  double s) {
  const double r = 1 - s;
  for (std::size_t level = n; level > 1; --level) {
    for (std::size_t i = 0; i < level; ++i) {
      radius[i] = r * radius[i] + s * radius[i + 1];
      height[i] = r * height[i] + s * height[i + 1];
    }
  }
  const auto degree = static_cast<double>(n);
  return {{r * radius[0] + s * radius[1], r * height[0] + s * height[1]},
          {degree * (radius[1] - radius[0]), degree * (height[1] - height[0])}};
}

[[nodiscard]] inline ProfileJet evaluate_profile(std::span<const ProfilePoint> control, double s) {
  const std::size_t n = control.size() - 1;
  // Rows of plain numbers: an array of points would be zeroed first, at the cost of all the rest.
  std::array<double, max_profile_degree + 1> radius;
  std::array<double, max_profile_degree + 1> height;
  for (std::size_t i = 0; i <= n; ++i) {
    radius[i] = control[i].radius;
    height[i] = control[i].height;
  }
  return evaluate_in_place(radius.data(), height.data(), n, s);
}

// The slope, or where it is zero the limit of its direction at the nearer end.
[[nodiscard]] inline ProfilePoint profile_tangent(std::span<const ProfilePoint> control,
                                                  const ProfileJet& jet, double s) {
  if (jet.slope.radius != 0 || jet.slope.height != 0) return jet.slope;
  const std::size_t n = control.size() - 1;
  for (std::size_t i = 1; i <= n; ++i) {
    const ProfilePoint& a = s < 0.5 ? control[0] : control[n - i];
    const ProfilePoint& b = s < 0.5 ? control[i] : control[n];
    if (a.radius != b.radius || a.height != b.height)
      return {b.radius - a.radius, b.height - a.height};
  }
  return {};
}

// Cyclic permutations, so that handedness is kept: the axis becomes y.
[[nodiscard]] inline Vector3 axis_from_object(const Vector3& v, Axis axis) {
  return axis == Axis::y ? v : axis == Axis::x ? Vector3{v.z, v.x, v.y} : Vector3{v.y, v.z, v.x};
}
[[nodiscard]] inline Vector3 object_from_axis(const Vector3& v, Axis axis) {
  return axis == Axis::y ? v : axis == Axis::x ? Vector3{v.y, v.z, v.x} : Vector3{v.z, v.x, v.y};
}

}  // namespace scenec::backend
