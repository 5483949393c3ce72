// A right-handed orthonormal basis and the change to and from it.
//
// Domain:     any unit vector.
// Method:     Duff et al. 2017, "Building an Orthonormal Basis, Revisited": branchless, no
//             singular direction; copysign makes -0 and the lower hemisphere safe.
// Error:      orthonormal to 4 unit round-offs.
// Degenerate: none; x x y = z for every z.
// Proof:      tests/unit/backend/math/frame_test.cpp.
#pragma once

#include <cmath>

#include "backend/math/vec.hpp"

namespace scenec::backend {

struct Frame {
  UnitVector3 x = UnitVector3::assume_unit({1, 0, 0});
  UnitVector3 y = UnitVector3::assume_unit({0, 1, 0});
  UnitVector3 z;

  // Coordinates in the frame of a vector given in the frame's outer space.
  [[nodiscard]] Vector3 local_of(const Vector3& v) const {
    return {dot(v, x), dot(v, y), dot(v, z)};
  }
  [[nodiscard]] Vector3 world_of(const Vector3& v) const {
    return x.vector() * v.x + y.vector() * v.y + z.vector() * v.z;
  }
  [[nodiscard]] UnitVector3 local_of(const UnitVector3& v) const {
    return normalized(local_of(v.vector()), v);
  }
  [[nodiscard]] UnitVector3 world_of(const UnitVector3& v) const {
    return normalized(world_of(v.vector()), v);
  }
};

[[nodiscard]] inline Frame frame_about(const UnitVector3& z) {
  const double sign = std::copysign(1.0, z.z());
  const double a = -1.0 / (sign + z.z());
  const double b = z.x() * z.y() * a;
  return {UnitVector3::assume_unit({1.0 + sign * z.x() * z.x() * a, sign * b, -sign * z.x()}),
          UnitVector3::assume_unit({b, sign + z.y() * z.y() * a, -z.y()}), z};
}

// As above, with x along the part of `tangent` orthogonal to z where there is one.
[[nodiscard]] inline Frame frame_about(const UnitVector3& z, const Vector3& tangent) {
  const Vector3 side = cross(z, tangent);
  if (!(length_squared(side) > 0)) return frame_about(z);
  const UnitVector3 y = normalized(side);
  return {normalized(cross(y, z)), y, z};
}

}  // namespace scenec::backend
