#include "backend/geometry/kernel.hpp"

#include <cmath>

namespace scenec::backend {
namespace {

// The sum rounded away from `from`, so that rounding cannot undo a tiny offset.
double add_away(double from, double offset) {
  const double sum = from + offset;
  return offset > 0 ? next_up(sum) : offset < 0 ? next_down(sum) : sum;
}

}  // namespace

Point3 offset_origin(const Point3& point, const Vector3& error, const UnitVector3& normal,
                     const Vector3& direction) {
  const double reach = spawn_safety * dot(abs(normal), error);
  const double signed_reach = dot(direction, normal) < 0 ? -reach : reach;
  const Vector3 offset = signed_reach * normal.vector();
  return {add_away(point.x, offset.x), add_away(point.y, offset.y), add_away(point.z, offset.z)};
}

Ray spawn_ray(const Hit& hit, const Vector3& direction) {
  return {offset_origin(hit.point, hit.error, hit.geometric_normal, direction), direction};
}

Ray spawn_segment(const Hit& hit, const Point3& target) {
  const Point3 origin =
      offset_origin(hit.point, hit.error, hit.geometric_normal, target - hit.point);
  return {origin, target - origin, 0, next_down(1.0)};
}

Ray spawn_segment(const Hit& hit, const Point3& target, const Vector3& target_error,
                  const UnitVector3& target_normal) {
  const Vector3 way = hit.point - target;
  // The target's kernel will see the segment from afar: its roundings are those of coordinates
  // relative to the origin, as long as the way (numerics anchors, finding 1).
  const double seen = length(way) * gamma(8);
  const Vector3 error = target_error + Vector3{seen, seen, seen};
  return spawn_segment(hit, offset_origin(target, error, target_normal, way));
}

}  // namespace scenec::backend
