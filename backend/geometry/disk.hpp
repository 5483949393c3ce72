// A flat disk.
//
// Domain:     finite centre and non-zero normal, radius > 0; finite ray.
// Method:     t from the plane relative to the centre; inside by the squared distance from it.
// Error:      rim within 8 u of the distance of the origin; t as for planes.
// Degenerate: ray in the plane: miss; a hit exactly on the rim counts.
// Proof:      tests/numerics/metamorphic_cases.cpp (G02, G09), derivative_cases.cpp (G27 - G29),
//             tests/unit/backend/geometry/planar_test.cpp.
#pragma once

#include "backend/geometry/kernel.hpp"

namespace scenec::backend {

struct Disk {
  Point3 center;
  UnitVector3 normal;
  double radius = 1;
};

[[nodiscard]] bool intersect(const Disk& disk, const Ray& ray, ShapeHit& out);
[[nodiscard]] Bounds3 bounds(const Disk& disk);
// u the angle about the normal / 2 pi, v from the rim (0) to the centre (1).
[[nodiscard]] Surface surface(const Disk& disk, const Ray& ray, const ShapeHit& hit,
                              HitDetail detail = HitDetail::texture);

}  // namespace scenec::backend
