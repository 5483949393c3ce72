#include "backend/geometry/triangle.hpp"

#include "backend/geometry/planar.hpp"

namespace scenec::backend {

RayShear::RayShear(const Ray& ray) : origin(ray.origin) {
  const Vector3 d = abs(ray.direction);
  kz = d.x > d.y ? (d.x > d.z ? 0 : 2) : (d.y > d.z ? 1 : 2);
  kx = kz == 2 ? 0 : kz + 1;
  ky = kx == 2 ? 0 : kx + 1;
  const double along = component(ray.direction, kz);
  // The winding seen along the ray stays the same on both sides of the axis.
  if (along < 0) {
    const int k = kx;
    kx = ky;
    ky = k;
  }
  sx = component(ray.direction, kx) / along;
  sy = component(ray.direction, ky) / along;
  sz = 1 / along;
}

bool intersect(const Triangle& triangle, const Ray& ray, ShapeHit& out) {
  return intersect_triangle(RayShear(ray), triangle.a, triangle.b, triangle.c, ray.t_min, ray.t_max,
                            out);
}

Bounds3 bounds(const Triangle& triangle) {
  Bounds3 b;
  b.grow(triangle.a);
  b.grow(triangle.b);
  b.grow(triangle.c);
  return b;
}

Surface surface(const Triangle& triangle, const Ray&, const ShapeHit& hit) {
  const double b1 = hit.a;
  const double b2 = hit.b;
  const double b0 = 1 - b1 - b2;
  const Vector3 a = b0 * as_vector(triangle.a);
  const Vector3 b = b1 * as_vector(triangle.b);
  const Vector3 c = b2 * as_vector(triangle.c);
  Surface s;
  s.point = as_point(a + b + c);
  s.dp_du = triangle.b - triangle.a;
  s.dp_dv = triangle.c - triangle.a;
  const Vector3 n = cross(s.dp_du, s.dp_dv);
  s.geometric_normal = s.shading_normal = as_normal(n);
  s.u = b1;
  s.v = b2;
  s.error = gamma(7) * (abs(a) + abs(b) + abs(c)) +
            planar_self_error(n, std::fmax(length(triangle.c - triangle.b),
                                           std::fmax(length(s.dp_du), length(s.dp_dv))));
  return s;
}

}  // namespace scenec::backend
