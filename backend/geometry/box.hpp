// A closed box with its faces along the axes.
//
// Domain:     min <= max in every axis (a flat box is a rectangle), finite; finite ray.
// Method:     slab distances by division, so a coordinate of the hit is exactly that of its face.
// Error:      t within 2 u of the slab distance, itself exact up to the rounding of face - origin.
// Degenerate: direction component 0: the slab holds the origin (faces included) or the ray misses;
//             edges and corners are hits.
// Proof:      tests/numerics/accel_cases.cpp (G19, G20), derivative_cases.cpp (G27 - G29),
//             tests/unit/backend/geometry/solid_test.cpp.
#pragma once

#include "backend/geometry/kernel.hpp"

namespace scenec::backend {

struct Box {
  Point3 min{-1, -1, -1};
  Point3 max{1, 1, 1};
};

// `part`: 0 -x, 1 +x, 2 -y, 3 +y, 4 -z, 5 +z.
[[nodiscard]] bool intersect(const Box& box, const Ray& ray, ShapeHit& out);
[[nodiscard]] Bounds3 bounds(const Box& box);
// u, v in [0, 1] on each face, v up on the four sides.
[[nodiscard]] Surface surface(const Box& box, const Ray& ray, const ShapeHit& hit);

}  // namespace scenec::backend
