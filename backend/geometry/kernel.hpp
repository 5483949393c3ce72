// What every shape must offer: the closest hit within a closed ray interval, its bounds, and the
// surface at a hit with a bound on the point's error. Kernels work in object space and know nothing
// of transforms, materials or accelerators.
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <limits>

#include "backend/math/bounds.hpp"
#include "backend/math/vec.hpp"

namespace scenec::backend {

// The points origin + t * direction with t_min <= t <= t_max, both ends included. The direction
// need not be unit: t is in units of its length, and survives transforms unchanged.
struct Ray {
  Point3 origin;
  Vector3 direction{0, 0, 1};
  double t_min = 0;
  double t_max = std::numeric_limits<double>::infinity();

  [[nodiscard]] Point3 at(double t) const { return origin + direction * t; }
};

// Rays that may enter the kernels: finite origin and non-zero finite direction, no NaN in the
// interval. Others hit nothing.
[[nodiscard]] inline bool is_traceable(const Ray& ray) {
  return is_finite(ray.origin) && is_finite(ray.direction) && ray.t_min <= ray.t_max &&
         !(ray.direction == Vector3{0, 0, 0});
}

// What a kernel's `intersect` finds. `part`, `a` and `b` mean what the shape says; its `surface`
// reads them back.
struct ShapeHit {
  double t = std::numeric_limits<double>::infinity();
  std::uint32_t part = 0;
  double a = 0;
  double b = 0;
};

// How much of a surface is wanted: texture coordinates cost angles, which light alone needs none
// of. `where_textured`: on items that were said to need them.
enum class HitDetail : std::uint8_t { place, where_textured, texture };

// The surface at a hit, in the shape's own space. Normals point to the outer side (winding, or
// dp_du x dp_dv), whatever side the ray came from, and need not be unit.
struct Surface {
  Point3 point;   // on the surface as nearly as double allows
  Vector3 error;  // bound on the distance of `point` from the surface, an axis at a time
  Normal3 geometric_normal;
  Normal3 shading_normal;
  // Of no meaning unless they are asked for.
  double u = 0;
  double v = 0;
  Vector3 dp_du;  // zero where u has no direction (a pole)
  Vector3 dp_dv;
};

// A hit in world space.
struct Hit {
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::uint32_t max_instances = 8;

  double t = std::numeric_limits<double>::infinity();
  std::uint32_t item = none;    // the caller's number of the shape hit
  std::uint32_t primitive = 0;  // triangle of a mesh, part of another shape
  std::uint32_t instance_count = 0;
  // The caller's numbers of the instances around the shape, outermost first.
  std::array<std::uint32_t, max_instances> instances{};
  // Not proven where the ray meets the shape: see geometry/revolve.hpp.
  bool uncertified = false;
  double b1 = 0;  // barycentric weights of vertices 1 and 2 (triangles and meshes)
  double b2 = 0;
  Point3 point;
  Vector3 error;                 // bound on the error of `point`, an axis at a time
  UnitVector3 geometric_normal;  // outer side, not turned to the ray
  UnitVector3 shading_normal;
  double u = 0;
  double v = 0;
  Vector3 dp_du;
  Vector3 dp_dv;
  double width = 0;  // of the pixel's cone along the surface; set by who follows the path
};

template <class Shape>
concept ShapeKernel =
    requires(const Shape& shape, const Ray& ray, ShapeHit& out, const ShapeHit& hit) {
      // The hit with the smallest t in [ray.t_min, ray.t_max]; false and `out` untouched if none.
      { intersect(shape, ray, out) } -> std::same_as<bool>;
      // Encloses every point the kernel can report.
      { bounds(shape) } -> std::same_as<Bounds3>;
      { surface(shape, ray, hit) } -> std::same_as<Surface>;
    };

// The error bounds of kernels hold for one evaluation; a spawned ray is judged by a second one with
// other roundings, and an accelerator's transforms add theirs. Four times covers both with room.
inline constexpr double spawn_safety = 4;

// The sum rounded away from `from`, so that rounding cannot undo a tiny offset.
[[nodiscard]] inline double add_away(double from, double offset) {
  const double sum = from + offset;
  return offset > 0 ? next_up(sum) : offset < 0 ? next_down(sum) : sum;
}

// The nearest representable origin off the surface at `point`, on the side `direction` goes to:
// moved along the normal far enough that the error box of the point lies behind it.
[[nodiscard]] inline Point3 offset_origin(const Point3& point, const Vector3& error,
                                          const UnitVector3& normal, const Vector3& direction) {
  const double reach = spawn_safety * dot(abs(normal), error);
  const double signed_reach = dot(direction, normal) < 0 ? -reach : reach;
  const Vector3 offset = signed_reach * normal.vector();
  return {add_away(point.x, offset.x), add_away(point.y, offset.y), add_away(point.z, offset.z)};
}

// A ray leaving a hit.
[[nodiscard]] inline Ray spawn_ray(const Hit& hit, const Vector3& direction) {
  return {offset_origin(hit.point, hit.error, hit.geometric_normal, direction), direction};
}
// What of a hit a segment needs, or a place on a surface that no ray has found.
struct SurfacePoint {
  Point3 point;
  Vector3 error;  // bound on the distance from the surface, an axis at a time
  UnitVector3 normal;
};
[[nodiscard]] inline SurfacePoint surface_point(const Hit& hit) {
  return {hit.point, hit.error, hit.geometric_normal};
}
// The open segment to a point (a point light): t_max is just below 1.
[[nodiscard]] inline Ray spawn_segment(const SurfacePoint& from, const Point3& target) {
  constexpr double before_one = 1 - 0x1p-53;
  const Point3 origin = offset_origin(from.point, from.error, from.normal, target - from.point);
  return {origin, target - origin, 0, before_one};
}
// The segment between places of two surfaces: both ends leave their surface.
[[nodiscard]] inline Ray spawn_segment(const SurfacePoint& from, const SurfacePoint& target) {
  const Vector3 way = from.point - target.point;
  // The target's kernel will see the segment from afar: its roundings are those of coordinates
  // relative to the origin, as long as the way (numerics anchors, finding 1).
  const double seen = length(way) * gamma(8);
  const Vector3 error = target.error + Vector3{seen, seen, seen};
  return spawn_segment(from, offset_origin(target.point, error, target.normal, way));
}

}  // namespace scenec::backend
