#include "backend/geometry/cylinder.hpp"

#include <cmath>
#include <limits>

#include "backend/geometry/angle.hpp"
#include "backend/geometry/quadratic.hpp"

namespace scenec::backend {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Interval {
  double near = -infinity;
  double far = infinity;
  std::uint32_t near_part = 0;
  std::uint32_t far_part = 0;
};

// Between the planes z = 0 and z = height.
bool slab_interval(double o, double d, double height, Interval& out) {
  if (d == 0) return o >= 0 && o <= height;
  const double low = -o / d;
  const double high = (height - o) / d;
  out = d > 0 ? Interval{low, high, 1, 2} : Interval{high, low, 2, 1};
  return true;
}

// Within the infinite round wall; a ray along the axis is all inside or all outside.
bool wall_interval(const Vector3& o, const Vector3& d, double radius, Interval& out) {
  const Vector3 flat_o{o.x, o.y, 0};
  const Vector3 flat_d{d.x, d.y, 0};
  if (flat_d == Vector3{0, 0, 0}) return dot(flat_o, flat_o) <= radius * radius;
  const double s = safe_scale(flat_d);
  RootPair roots;
  if (!line_meets_sphere(flat_o, s * flat_d, radius, roots)) return false;
  out = {roots.near * s, roots.far * s, 0, 0};
  return true;
}

bool report(double t, std::uint32_t part, const Ray& ray, ShapeHit& out) {
  if (!(t >= ray.t_min && t <= ray.t_max) || std::isinf(t)) return false;
  out = {t, part, 0, 0};
  return true;
}

}  // namespace

Cylinder::Cylinder(const Point3& base_center, const Point3& top, double r, bool with_caps)
    : base(base_center),
      frame(frame_about(normalized(top - base_center))),
      height(distance(top, base_center)),
      radius(r),
      capped(with_caps) {}

bool intersect(const Cylinder& cylinder, const Ray& ray, ShapeHit& out) {
  const Vector3 o = cylinder.frame.local_of(ray.origin - cylinder.base);
  const Vector3 d = cylinder.frame.local_of(ray.direction);
  Interval wall;
  if (!wall_interval(o, d, cylinder.radius, wall)) return false;
  if (!cylinder.capped) {
    const auto on_wall = [&](double t) {
      const double z = o.z + t * d.z;
      return z >= 0 && z <= cylinder.height && report(t, 0, ray, out);
    };
    return on_wall(wall.near) || on_wall(wall.far);
  }
  Interval slab;
  if (!slab_interval(o.z, d.z, cylinder.height, slab)) return false;
  const bool wall_first = wall.near >= slab.near;
  const bool wall_last = wall.far <= slab.far;
  const double near = wall_first ? wall.near : slab.near;
  const double far = wall_last ? wall.far : slab.far;
  if (!(near <= far)) return false;
  return report(near, wall_first ? 0 : slab.near_part, ray, out) ||
         report(far, wall_last ? 0 : slab.far_part, ray, out);
}

Bounds3 bounds(const Cylinder& cylinder) {
  const UnitVector3& axis = cylinder.frame.z;
  const auto reach = [&](double n) {
    return cylinder.radius * std::sqrt(std::fmax(0, 1 - n * n) + gamma(16));
  };
  const Vector3 e{reach(axis.x()), reach(axis.y()), reach(axis.z())};
  const Point3 top = cylinder.base + cylinder.height * axis.vector();
  Bounds3 b{cylinder.base - e, cylinder.base + e};
  b.grow(Bounds3{top - e, top + e});
  return outward(b, gamma(8) * abs(cylinder.height * axis.vector()));
}

Surface surface(const Cylinder& cylinder, const Ray& ray, const ShapeHit& hit) {
  const Frame& f = cylinder.frame;
  Vector3 p = f.local_of((ray.origin - cylinder.base) + hit.t * ray.direction);
  const double rho = std::sqrt(p.x * p.x + p.y * p.y);
  const Vector3 outward_flat = rho > 0 ? Vector3{p.x / rho, p.y / rho, 0} : Vector3{1, 0, 0};
  Surface s;
  s.u = turn_fraction(p.y, p.x);
  if (hit.part == 0) {
    p = {outward_flat.x * cylinder.radius, outward_flat.y * cylinder.radius,
         std::fmin(std::fmax(p.z, 0), cylinder.height)};
    s.geometric_normal = as_normal(f.world_of(outward_flat));
    s.v = p.z / cylinder.height;
    s.dp_du = 2 * pi * f.world_of(Vector3{-p.y, p.x, 0});
    s.dp_dv = cylinder.height * f.z.vector();
  } else {
    // Counter-clockwise about the cap's own normal, as on a disk.
    const double side = hit.part == 1 ? -1 : 1;
    s.u = turn_fraction(side * p.y, p.x);
    p.z = hit.part == 1 ? 0 : cylinder.height;
    s.geometric_normal = as_normal(side * f.z.vector());
    s.v = 1 - std::fmin(1, rho / cylinder.radius);
    s.dp_du = 2 * pi * side * f.world_of(Vector3{-p.y, p.x, 0});
    s.dp_dv = -cylinder.radius * f.world_of(outward_flat);
  }
  s.shading_normal = s.geometric_normal;
  s.point = cylinder.base + f.world_of(p);
  // Into the frame and out of it mixes the axes, so the error is the same in all: of the local
  // coordinates, and of the base they are added to.
  const double local = gamma(16) * (cylinder.radius + std::fabs(p.z));
  s.error = Vector3{local, local, local} +
            gamma(4) * (abs(as_vector(s.point)) + abs(as_vector(cylinder.base)));
  return s;
}

}  // namespace scenec::backend
