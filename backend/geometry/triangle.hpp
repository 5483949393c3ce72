// A triangle; outer side counter-clockwise.
//
// Domain:     finite vertices; finite ray.
// Method:     Woop, Benthin, Wald 2013: vertices relative to the ray origin, sheared so that the
//             ray runs along its largest axis; edge functions a*b - c*d, exactly antisymmetric in an
//             edge's ends because nothing is fused.
// Error:      inside or outside consistent for both triangles at a shared edge (no leak, ever);
//             t within gamma(16) |A||B||C| / (2 area) of distance, A, B, C the vertices seen from
//             the origin.
// Degenerate: zero determinant (zero area, ray in the plane), non-finite t: miss. Zero edge
//             function counts as inside, so edges and vertices are hits of all that share them.
// Proof:      tests/numerics/watertight_cases.cpp (G14 - G16), planar_cases.cpp (G11 - G18).
#pragma once

#include <cmath>

#include "backend/geometry/kernel.hpp"

namespace scenec::backend {

struct Triangle {
  Point3 a;
  Point3 b;
  Point3 c;
};

// The shear of one ray, shared by all triangles it is tested with.
struct RayShear {
  explicit RayShear(const Ray& ray);

  Point3 origin;
  int kx = 0;
  int ky = 1;
  int kz = 2;
  double sx = 0;
  double sy = 0;
  double sz = 1;

  struct Sheared {
    double x;
    double y;
    double z;  // in units of the ray's t, before division by the determinant
  };
  [[nodiscard]] Sheared of(const Point3& p) const {
    const Vector3 v = p - origin;
    const double z = component(v, kz);
    return {component(v, kx) - sx * z, component(v, ky) - sy * z, sz * z};
  }
};

// The kernel shared by triangles and meshes. `a`, `b` of the hit are the barycentric weights of the
// second and third vertex.
[[nodiscard]] inline bool intersect_triangle(const RayShear& shear, const Point3& pa,
                                             const Point3& pb, const Point3& pc, double t_min,
                                             double t_max, ShapeHit& out) {
  const RayShear::Sheared a = shear.of(pa);
  const RayShear::Sheared b = shear.of(pb);
  const RayShear::Sheared c = shear.of(pc);
  const double u = c.x * b.y - c.y * b.x;
  const double v = a.x * c.y - a.y * c.x;
  const double w = b.x * a.y - b.y * a.x;
  if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) return false;
  const double det = u + v + w;
  if (!(det != 0)) return false;
  const double inverse = 1 / det;
  const double t = (u * a.z + v * b.z + w * c.z) * inverse;
  // NaN fails both comparisons.
  if (!(t >= t_min && t <= t_max) || std::isinf(t)) return false;
  out.t = t;
  out.part = 0;
  out.a = v * inverse;
  out.b = w * inverse;
  return true;
}

[[nodiscard]] bool intersect(const Triangle& triangle, const Ray& ray, ShapeHit& out);
[[nodiscard]] Bounds3 bounds(const Triangle& triangle);
// u, v are the barycentric weights of b and c.
[[nodiscard]] Surface surface(const Triangle& triangle, const Ray& ray, const ShapeHit& hit);

}  // namespace scenec::backend
