#include "backend/geometry/quad.hpp"

#include <array>
#include <cmath>

#include "backend/geometry/planar.hpp"
#include "backend/geometry/triangle.hpp"

namespace scenec::backend {
namespace {

double edge_function(const RayShear::Sheared& a, const RayShear::Sheared& b) {
  return a.x * b.y - a.y * b.x;
}

}  // namespace

std::array<Point3, 4> corners_of(const Quad& quad) {
  return {quad.corner, quad.corner + quad.edge_u, (quad.corner + quad.edge_u) + quad.edge_v,
          quad.corner + quad.edge_v};
}

bool intersect(const Quad& quad, const Ray& ray, ShapeHit& out) {
  const RayShear shear(ray);
  const std::array<Point3, 4> p = corners_of(quad);
  const RayShear::Sheared a = shear.of(p[0]);
  const RayShear::Sheared b = shear.of(p[1]);
  const RayShear::Sheared c = shear.of(p[2]);
  const RayShear::Sheared d = shear.of(p[3]);
  const double ab = edge_function(a, b);
  const double bc = edge_function(b, c);
  const double cd = edge_function(c, d);
  const double da = edge_function(d, a);
  if ((ab < 0 || bc < 0 || cd < 0 || da < 0) && (ab > 0 || bc > 0 || cd > 0 || da > 0))
    return false;
  const Vector3 n = cross(quad.edge_u, quad.edge_v);
  const double slope = dot(n, ray.direction);
  if (!(slope != 0)) return false;
  const double t = dot(n, quad.corner - ray.origin) / slope;
  if (!(t >= ray.t_min && t <= ray.t_max) || std::isinf(t)) return false;
  // da grows from 0 on the first edge v to the whole area on the opposite one, and so does ab for
  // v. A zero sum means that the ray lies in the plane as the edge functions see it.
  if (!(da + bc != 0 && ab + cd != 0)) return false;
  out = {t, 0, da / (da + bc), ab / (ab + cd)};
  return true;
}

Bounds3 bounds(const Quad& quad) {
  Bounds3 b;
  for (const Point3& p : corners_of(quad)) b.grow(p);
  return outward(b);
}

Surface surface(const Quad& quad, const Ray&, const ShapeHit& hit) {
  Surface s;
  const Vector3 n = cross(quad.edge_u, quad.edge_v);
  const Vector3 u = hit.a * quad.edge_u;
  const Vector3 v = hit.b * quad.edge_v;
  s.point = quad.corner + (u + v);
  s.error = gamma(6) * (abs(as_vector(quad.corner)) + abs(u) + abs(v)) +
            planar_self_error(n, length(quad.edge_u) + length(quad.edge_v));
  s.geometric_normal = s.shading_normal = as_normal(n);
  s.u = hit.a;
  s.v = hit.b;
  s.dp_du = quad.edge_u;
  s.dp_dv = quad.edge_v;
  return s;
}

}  // namespace scenec::backend
