#include "backend/geometry/disk.hpp"

#include <cmath>

#include "backend/geometry/angle.hpp"
#include "backend/math/frame.hpp"

namespace scenec::backend {

bool intersect(const Disk& disk, const Ray& ray, ShapeHit& out) {
  const Vector3 to_origin = ray.origin - disk.center;
  const double slope = dot(disk.normal, ray.direction);
  if (!(slope != 0)) return false;
  const double t = -dot(disk.normal, to_origin) / slope;
  if (!(t >= ray.t_min && t <= ray.t_max) || std::isinf(t)) return false;
  const Vector3 p = to_origin + t * ray.direction;
  if (!(dot(p, p) <= disk.radius * disk.radius)) return false;
  out = {t, 0, 0, 0};
  return true;
}

Bounds3 bounds(const Disk& disk) {
  // The rim reaches r sqrt(1 - n_i^2) along axis i; a little more covers a normal unit to 2 ulp.
  const auto reach = [&](double n) {
    return disk.radius * std::sqrt(std::fmax(0, 1 - n * n) + gamma(16));
  };
  const Vector3 e{reach(disk.normal.x()), reach(disk.normal.y()), reach(disk.normal.z())};
  return outward({disk.center - e, disk.center + e});
}

Surface surface(const Disk& disk, const Ray& ray, const ShapeHit& hit,
                HitDetail detail) {
  Vector3 p = (ray.origin - disk.center) + hit.t * ray.direction;
  p = p - dot(p, disk.normal) * disk.normal.vector();
  Surface s;
  s.point = disk.center + p;
  s.error =
      gamma(8) * (abs(p) + disk.radius * abs(disk.normal)) + gamma(2) * abs(as_vector(s.point));
  s.geometric_normal = s.shading_normal = as_normal(disk.normal);
  if (detail == HitDetail::place) return s;
  const Frame frame = frame_about(disk.normal);
  const Vector3 q = frame.local_of(p);
  const double rho = std::sqrt(q.x * q.x + q.y * q.y);
  s.u = turn_fraction(q.y, q.x);
  s.v = 1 - std::fmin(1, rho / disk.radius);
  s.dp_du = 2 * pi * frame.world_of(Vector3{-q.y, q.x, 0});
  s.dp_dv = rho > 0 ? frame.world_of(Vector3{-q.x, -q.y, 0} * (disk.radius / rho))
                    : frame.x.vector() * -disk.radius;
  return s;
}

}  // namespace scenec::backend
