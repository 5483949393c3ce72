#include "backend/geometry/plane.hpp"

#include <cmath>

#include "backend/math/frame.hpp"

namespace scenec::backend {

bool intersect(const Plane& plane, const Ray& ray, ShapeHit& out) {
  const Vector3 n = as_vector(plane.normal);
  const double slope = dot(n, ray.direction);
  if (!(slope != 0)) return false;
  const double t = (plane.offset - dot(n, as_vector(ray.origin))) / slope;
  if (!(t >= ray.t_min && t <= ray.t_max) || std::isinf(t)) return false;
  out = {t, 0, 0, 0};
  return true;
}

Bounds3 bounds(const Plane&) {
  return {{-Bounds3::infinity, -Bounds3::infinity, -Bounds3::infinity},
          {Bounds3::infinity, Bounds3::infinity, Bounds3::infinity}};
}

Surface surface(const Plane& plane, const Ray& ray, const ShapeHit& hit) {
  const Vector3 n = as_vector(plane.normal);
  const double n2 = dot(n, n);
  Point3 p = ray.at(hit.t);
  p = p + n * ((plane.offset - dot(n, as_vector(p))) / n2);
  Surface s;
  s.point = p;
  const UnitVector3 unit = normalized(n);
  // Along the normal, n.p - offset is known to gamma(5) (sum |n_i p_i| + |offset|) / |n|. The way
  // the ray came stands in where all of that is 0, at the origin of a plane through it.
  const double across = max_abs(as_vector(p)) + std::fabs(plane.offset) / std::sqrt(n2) +
                        max_abs(hit.t * ray.direction);
  s.error = gamma(6) * (abs(as_vector(p)) + across * abs(unit));
  s.geometric_normal = s.shading_normal = plane.normal;
  const Frame frame = frame_about(unit);
  s.u = dot(as_vector(p), frame.x);
  s.v = dot(as_vector(p), frame.y);
  s.dp_du = frame.x;
  s.dp_dv = frame.y;
  return s;
}

}  // namespace scenec::backend
