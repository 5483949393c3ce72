// A sphere.
//
// Domain:     finite centre, radius > 0, at most 1e300; any finite ray.
// Method:     closest-approach discriminant (Haines et al., Ray Tracing Gems 7) when the origin is
//             far away, b^2 - ac when it is near or inside (there ac is small and nothing cancels);
//             roots by q = b + sign(b) sqrt(d), so that neither subtracts like quantities.
// Error:      t within 8 u D / sqrt(r^2 - h^2) relative, D the distance of the origin and h that of
//             the line from the centre; hit or miss exact unless |h - r| <= 4 u D.
// Degenerate: tangent (h = r): one hit, closed; radius 0 or NaN: no hit; |d| of any size.
// Proof:      tests/numerics/sphere_cases.cpp (G01 - G08, G25), metamorphic_cases.cpp (G02, G09),
//             derivative_cases.cpp (G27 - G29).
#pragma once

#include "backend/geometry/kernel.hpp"

namespace scenec::backend {

struct Sphere {
  Point3 center;
  double radius = 1;
};

[[nodiscard]] bool intersect(const Sphere& sphere, const Ray& ray, ShapeHit& out);
[[nodiscard]] Bounds3 bounds(const Sphere& sphere);
// u counter-clockwise about +y from +x, v from south (0) to north (1).
[[nodiscard]] Surface surface(const Sphere& sphere, const Ray& ray, const ShapeHit& hit,
                              HitDetail detail = HitDetail::texture);

}  // namespace scenec::backend
