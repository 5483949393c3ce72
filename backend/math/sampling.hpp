// Warps of the unit square, each a triple: sample_x (point from two numbers in [0, 1)), pdf_x
// (its density) and, where it exists, invert_x (the numbers back).
//
// Domain:     u, v in [0, 1).
// Method:     concentric map (Shirley and Chiu 1997); cosine hemisphere by lifting it (Malley);
//             cones by 1 - cos in the form s^2 / (1 + sqrt(1 - s^2)), which keeps its digits for
//             lights that look small (numerics rule: 1 - sqrt(1 - s^2) turns such lights black).
// Error:      points on their domain to 2 ulp; densities to 4 ulp.
// Degenerate: s = 0 gives an infinite density and the axis; u = v = 0.5 the disk's centre.
// Proof:      tests/unit/backend/math/sampling_test.cpp.
#pragma once

#include <cmath>

#include "backend/math/turn.hpp"
#include "backend/math/vec.hpp"
#include "base/elementary.hpp"

namespace scenec::backend {

struct Sample2 {
  double u = 0;
  double v = 0;
};

// The unit disk (x, y), area-preserving.
[[nodiscard]] inline Sample2 sample_concentric_disk(Sample2 s) {
  const double a = 2 * s.u - 1;
  const double b = 2 * s.v - 1;
  const bool wide = std::fabs(a) > std::fabs(b);
  const double radius = wide ? a : b;
  // The middle: any angle will do.
  const double slope = (wide ? b : a) / (radius == 0 ? 1 : radius);
  const double along = radius * cos_within_eighth(pi / 4 * slope);
  const double across = radius * sin_within_eighth(pi / 4 * slope);
  return wide ? Sample2{along, across} : Sample2{across, along};
}
[[nodiscard]] constexpr double pdf_concentric_disk() {
  return 1 / pi;
}
[[nodiscard]] Sample2 invert_concentric_disk(Sample2 point);

// Directions about +z with density cos / pi.
[[nodiscard]] inline UnitVector3 sample_cosine_hemisphere(Sample2 s) {
  const Sample2 d = sample_concentric_disk(s);
  const double z2 = 1 - d.u * d.u - d.v * d.v;
  return UnitVector3::assume_unit({d.u, d.v, std::sqrt(z2 > 0 ? z2 : 0.0)});
}
[[nodiscard]] constexpr double pdf_cosine_hemisphere(double cos_theta) {
  return cos_theta > 0 ? cos_theta / pi : 0;
}
[[nodiscard]] Sample2 invert_cosine_hemisphere(const UnitVector3& w);

[[nodiscard]] UnitVector3 sample_uniform_hemisphere(Sample2 s);
[[nodiscard]] constexpr double pdf_uniform_hemisphere() {
  return 1 / (2 * pi);
}
[[nodiscard]] Sample2 invert_uniform_hemisphere(const UnitVector3& w);

[[nodiscard]] UnitVector3 sample_uniform_sphere(Sample2 s);
[[nodiscard]] constexpr double pdf_uniform_sphere() {
  return 1 / (4 * pi);
}
[[nodiscard]] Sample2 invert_uniform_sphere(const UnitVector3& w);

// 1 - cos of the angle whose squared sine is `sin_squared` (angle up to 90 degrees).
[[nodiscard]] double one_minus_cos(double sin_squared);

// Directions about +z within the cone whose squared sine is `sin_squared_max` in (0, 1]: for a
// sphere of radius r at distance d it is (r / d)^2.
[[nodiscard]] UnitVector3 sample_uniform_cone(Sample2 s, double sin_squared_max);
[[nodiscard]] double pdf_uniform_cone(double sin_squared_max);
[[nodiscard]] Sample2 invert_uniform_cone(const UnitVector3& w, double sin_squared_max);

// Barycentric weights (b1, b2) of a triangle's second and third vertex, uniform in area.
[[nodiscard]] inline Sample2 sample_uniform_triangle(Sample2 s) {
  // Heitz 2019: the square folded along its diagonal, without a square root.
  if (s.v > s.u) return {0.5 * s.u, s.v - 0.5 * s.u};
  return {s.u - 0.5 * s.v, 0.5 * s.v};
}
[[nodiscard]] constexpr double pdf_uniform_triangle(double area) {
  return 1 / area;
}

}  // namespace scenec::backend
