// A round cylinder between two points, with or without its two caps.
//
// Domain:     base != top, radius > 0, finite; finite ray.
// Method:     coordinates along an orthonormal frame about the axis; side by the two-dimensional
//             form of the sphere's stable quadratic; a capped cylinder is convex, so its hit is the
//             meeting of the side's and the slab's intervals and the rim cannot leak.
// Error:      side as for spheres, caps as for planes.
// Degenerate: ray along the axis: caps only; ray lying in the side: the caps if there are any, else
//             miss; tangent: one hit.
// Proof:      tests/numerics/metamorphic_cases.cpp (G02, G09), derivative_cases.cpp (G27 - G29),
//             tests/unit/backend/geometry/solid_test.cpp.
#pragma once

#include "backend/geometry/kernel.hpp"
#include "backend/math/frame.hpp"

namespace scenec::backend {

struct Cylinder {
  Cylinder() = default;
  Cylinder(const Point3& base, const Point3& top, double radius, bool capped);

  Point3 base;
  Frame frame = frame_about(UnitVector3::assume_unit({0, 1, 0}));  // z along the axis
  double height = 1;
  double radius = 1;
  bool capped = true;
};

// `part`: 0 side, 1 base, 2 top.
[[nodiscard]] bool intersect(const Cylinder& cylinder, const Ray& ray, ShapeHit& out);
[[nodiscard]] Bounds3 bounds(const Cylinder& cylinder);
// Side: u the angle about the axis / 2 pi, v from base to top; caps as disks.
[[nodiscard]] Surface surface(const Cylinder& cylinder, const Ray& ray, const ShapeHit& hit);

}  // namespace scenec::backend
