// The unbounded plane n . p = offset.
//
// Domain:     finite non-zero normal of any length; finite ray.
// Method:     t = (offset - n.o) / (n.d), then the point is moved onto the plane along n.
// Error:      t within 8 u relative to (|offset| + |n|.|o|) / |n.o - offset| .
// Degenerate: n.d = 0 or t not finite: miss, also for a ray within the plane.
// Proof:      tests/numerics/planar_cases.cpp (G10, G11), derivative_cases.cpp (G27 - G29).
#pragma once

#include "backend/geometry/kernel.hpp"

namespace scenec::backend {

struct Plane {
  Normal3 normal{0, 1, 0};
  double offset = 0;  // n . p, so a distance only when the normal is unit
};

[[nodiscard]] bool intersect(const Plane& plane, const Ray& ray, ShapeHit& out);
// Infinite: accelerators keep planes in a list of their own.
[[nodiscard]] Bounds3 bounds(const Plane& plane);
// u, v in metres along a fixed orthonormal pair with u x v = n (for +y: u = x, v = -z).
[[nodiscard]] Surface surface(const Plane& plane, const Ray& ray, const ShapeHit& hit);

}  // namespace scenec::backend
