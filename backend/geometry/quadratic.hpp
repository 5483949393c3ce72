// The two parameters where a line meets a circle or sphere of given radius, in any dimension.
//
// Domain:     `to_origin` from the centre to the origin; a = |direction|^2 a normal number.
// Method:     see sphere.hpp; shared by spheres, cylinders and whatever else is round.
// Error:      see sphere.hpp.
// Degenerate: no root or NaN: false.
// Proof:      tests/numerics/sphere_cases.cpp, tests/unit/backend/geometry/solid_test.cpp.
#pragma once

#include <cmath>

#include "backend/math/vec.hpp"

namespace scenec::backend {

struct RootPair {
  double near = 0;
  double far = 0;
};

[[nodiscard]] inline bool line_meets_sphere(const Vector3& to_origin, const Vector3& direction,
                                            double radius, RootPair& roots) {
  const double a = dot(direction, direction);
  const double b = -dot(to_origin, direction);
  const double r2 = radius * radius;
  const double c = dot(to_origin, to_origin) - r2;
  double discriminant = 0;
  if (b * b + a * std::fabs(c) <= a * r2) {
    // Near or inside: c is small against r^2, so b^2 - ac keeps what the origin knows of the
    // surface.
    discriminant = b * b - a * c;
  } else {
    // Far: b^2 - ac would cancel; the line's distance h from the centre does not.
    const Vector3 nearest = to_origin + (b / a) * direction;
    const double h = std::sqrt(dot(nearest, nearest));
    discriminant = a * ((radius - h) * (radius + h));
  }
  if (!(discriminant >= 0)) return false;
  const double root = std::sqrt(discriminant);
  const double q = b < 0 ? b - root : b + root;
  // b = 0 and discriminant = 0: the origin is on the surface and the line tangent there.
  const double first = q != 0 ? c / q : 0;
  const double second = q / a;
  roots = first <= second ? RootPair{first, second} : RootPair{second, first};
  return true;
}

// The first of the two roots within the closed interval.
[[nodiscard]] inline bool first_root_within(const RootPair& roots, double t_min, double t_max,
                                            double& t) {
  if (roots.near >= t_min && roots.near <= t_max) {
    t = roots.near;
    return true;
  }
  if (roots.far >= t_min && roots.far <= t_max) {
    t = roots.far;
    return true;
  }
  return false;
}

}  // namespace scenec::backend
