// A parallelogram corner, corner + u, corner + u + v, corner + v; outer side u x v.
//
// Domain:     finite corners; finite ray.
// Method:     four sign-consistent edge functions in the sheared ray frame (Woop, Benthin, Wald
//             2013), inclusive zero; t from the plane.
// Error:      inside or outside as for triangles: quads with bit-equal corners share edges without
//             a gap; t as for planes.
// Degenerate: zero area, ray in the plane: miss.
// Proof:      tests/numerics/metamorphic_cases.cpp (G02, G09), derivative_cases.cpp (G27 - G29),
//             tests/unit/backend/geometry/planar_test.cpp.
#pragma once

#include <array>

#include "backend/geometry/kernel.hpp"

namespace scenec::backend {

struct Quad {
  Point3 corner;
  Vector3 edge_u{1, 0, 0};
  Vector3 edge_v{0, 1, 0};
};

[[nodiscard]] bool intersect(const Quad& quad, const Ray& ray, ShapeHit& out);
// In order round it.
[[nodiscard]] std::array<Point3, 4> corners_of(const Quad& quad);
[[nodiscard]] Bounds3 bounds(const Quad& quad);
// u, v in [0, 1] along the edges.
[[nodiscard]] Surface surface(const Quad& quad, const Ray& ray, const ShapeHit& hit);

}  // namespace scenec::backend
