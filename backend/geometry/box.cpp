#include "backend/geometry/box.hpp"

#include <cmath>
#include <limits>
#include <utility>

namespace scenec::backend {

bool intersect(const Box& box, const Ray& ray, ShapeHit& out) {
  double near = -std::numeric_limits<double>::infinity();
  double far = std::numeric_limits<double>::infinity();
  std::uint32_t near_face = 0;
  std::uint32_t far_face = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double o = component(ray.origin, axis);
    const double d = component(ray.direction, axis);
    const double low = component(box.min, axis);
    const double high = component(box.max, axis);
    if (d == 0) {
      if (!(o >= low && o <= high)) return false;
      continue;
    }
    double enter = (low - o) / d;
    double leave = (high - o) / d;
    std::uint32_t enter_face = static_cast<std::uint32_t>(2 * axis);
    std::uint32_t leave_face = enter_face + 1;
    if (d < 0) {
      std::swap(enter, leave);
      std::swap(enter_face, leave_face);
    }
    if (enter > near) {
      near = enter;
      near_face = enter_face;
    }
    if (leave < far) {
      far = leave;
      far_face = leave_face;
    }
  }
  if (!(near <= far)) return false;
  const bool from_outside = near >= ray.t_min;
  const double t = from_outside ? near : far;
  if (!(t >= ray.t_min && t <= ray.t_max) || std::isinf(t)) return false;
  out = {t, from_outside ? near_face : far_face, 0, 0};
  return true;
}

Bounds3 bounds(const Box& box) {
  return {box.min, box.max};
}

Surface surface(const Box& box, const Ray& ray, const ShapeHit& hit) {
  const int axis = static_cast<int>(hit.part / 2);
  const bool high = hit.part % 2 == 1;
  const double side = high ? 1 : -1;
  Point3 p = ray.at(hit.t);
  // Kept within the face, and exactly on it in its own axis.
  for (int i = 0; i < 3; ++i)
    set_component(
        p, i, std::fmin(std::fmax(component(p, i), component(box.min, i)), component(box.max, i)));
  set_component(p, axis, high ? component(box.max, axis) : component(box.min, axis));
  Surface s;
  s.point = p;
  Vector3 n;
  set_component(n, axis, side);
  s.geometric_normal = s.shading_normal = as_normal(n);
  const Vector3 extent = box.max - box.min;
  // The face coordinate is exact; a share of the size keeps spawned origins off a face at 0.
  s.error = gamma(2) * (abs(as_vector(p)) + max_abs(extent) * abs(n));
  // u runs so that u x v points outward with v up (y) on the sides, and away from +z on the lids.
  const int u_axis = axis == 0 ? 2 : 0;
  const int v_axis = axis == 1 ? 2 : 1;
  const double u_sign = axis == 0 ? -side : axis == 2 ? side : 1;
  const double v_sign = axis == 1 ? -side : 1;
  const auto fraction = [&](int i, double sign) {
    const double e = component(extent, i);
    const double f = e > 0 ? (component(p, i) - component(box.min, i)) / e : 0;
    return sign > 0 ? f : 1 - f;
  };
  s.u = fraction(u_axis, u_sign);
  s.v = fraction(v_axis, v_sign);
  set_component(s.dp_du, u_axis, u_sign * component(extent, u_axis));
  set_component(s.dp_dv, v_axis, v_sign * component(extent, v_axis));
  return s;
}

}  // namespace scenec::backend
