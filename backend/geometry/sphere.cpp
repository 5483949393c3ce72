#include "backend/geometry/sphere.hpp"

#include <cmath>

#include "backend/geometry/angle.hpp"
#include "backend/geometry/quadratic.hpp"

namespace scenec::backend {

bool intersect(const Sphere& sphere, const Ray& ray, ShapeHit& out) {
  const double s = safe_scale(ray.direction);  // 1 but for absurd lengths, which would not square
  RootPair roots;
  if (!line_meets_sphere(ray.origin - sphere.center, s * ray.direction, sphere.radius, roots))
    return false;
  if (s != 1) roots = {roots.near * s, roots.far * s};
  double t = 0;
  if (!first_root_within(roots, ray.t_min, ray.t_max, t) || std::isinf(t)) return false;
  out = {t, 0, 0, 0};
  return true;
}

Bounds3 bounds(const Sphere& sphere) {
  const double r = sphere.radius;
  const Point3 c = sphere.center;
  // A line is judged to hit up to 4 u D off the surface (sphere.hpp); boxes take that of the size.
  const double slack = gamma(8) * r;
  return outward({{c.x - r, c.y - r, c.z - r}, {c.x + r, c.y + r, c.z + r}}, {slack, slack, slack});
}

Surface surface(const Sphere& sphere, const Ray& ray, const ShapeHit& hit,
                HitDetail detail) {
  const double r = sphere.radius;
  const Vector3 raw = (ray.origin - sphere.center) + hit.t * ray.direction;
  const double raw_length = length(raw);
  // t carries an error; pulling the point to the radius takes it out of the normal direction.
  const Vector3 p = raw_length > 0 ? raw * (r / raw_length) : Vector3{0, r, 0};
  Surface s;
  s.point = sphere.center + p;
  // The pull leaves 5 roundings of p. A second ray judges its origin by |o - c|^2 - r^2, which
  // knows it to 3 u r along the normal: below gamma(8) |p| there. Adding the centre rounds once
  // more, and subtracting it again once.
  s.error = gamma(8) * abs(p) + gamma(2) * abs(as_vector(s.point));
  s.geometric_normal = s.shading_normal = as_normal(p);
  if (detail == HitDetail::place) return s;
  const double rho = std::sqrt(p.x * p.x + p.z * p.z);
  s.u = turn_fraction(-p.z, p.x);
  s.v = 0.5 + atan2(p.y, rho) / pi;
  s.dp_du = 2 * pi * Vector3{p.z, 0, -p.x};
  const double cos_phi = rho > 0 ? p.x / rho : 1;
  const double sin_phi = rho > 0 ? -p.z / rho : 0;
  s.dp_dv = pi * Vector3{-p.y * cos_phi, rho, p.y * sin_phi};
  return s;
}

}  // namespace scenec::backend
