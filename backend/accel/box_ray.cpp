#include "backend/accel/box_ray.hpp"

#include <bit>
#include <cstddef>

namespace scenec::backend {
namespace {

constexpr double move_slack = 0x1p-49;    // of the move, in units of |o as given| |r|
constexpr double addend_limit = 0x1p100;  // beyond it a slab decides nothing, whatever its plane

double max_abs(const double (&v)[3]) {
  return std::fmax(std::fabs(v[0]), std::fmax(std::fabs(v[1]), std::fabs(v[2])));
}

void set_axis(std::size_t axis, double origin, double direction, double absolute_slack,
              BoxRay& out) {
  const auto d = static_cast<float>(direction);
  const float r = 1 / std::copysign(std::fmax(std::fabs(d), BoxRay::smallest), d);
  const double product = -(origin * static_cast<double>(r));
  const double m = (static_cast<double>(BoxRay::slack) * (1 + std::fabs(origin)) + absolute_slack) *
                   std::fabs(static_cast<double>(r));
  out.reciprocal[axis] = r;
  if (r < 0) out.negative |= 1U << axis;
  out.near_add[axis] = static_cast<float>(product - m);
  out.far_add[axis] = static_cast<float>(product + m);
}

// The part of the ray within the tree's cube and a margin; false if there is none.
bool clip(const LocalRay& ray, double margin, double& enter) {
  enter = ray.t_min;
  double leave = ray.t_max;
  for (std::size_t k = 0; k < 3; ++k) {
    const double o = ray.origin[k];
    const double d = ray.direction[k];
    if (d == 0) {
      if (std::fabs(o) > 1 + margin) return false;
      continue;
    }
    const double side = std::copysign(1 + margin, d);
    enter = std::fmax(enter, (-side - o) / d);
    leave = std::fmin(leave, (side - o) / d);
  }
  return enter <= leave && std::isfinite(enter);
}

bool make_moved(const LocalRay& ray, BoxRay& out) {
  const double far = max_abs(ray.origin);
  if (!std::isfinite(far)) return false;
  double enter = 0;
  if (!clip(ray, 0x1p-10 + move_slack * far, enter)) return false;
  out.shift = enter;
  out.negative = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    set_axis(k, ray.origin[k] + ray.direction[k] * enter, ray.direction[k], move_slack * far, out);
    out.near_add[k] = std::fmax(out.near_add[k], static_cast<float>(-addend_limit));
    out.far_add[k] = std::fmin(out.far_add[k], static_cast<float>(addend_limit));
  }
  return true;
}

}  // namespace

LocalRay make_local(const TreeSpace& space, const Ray& ray) {
  Vector3 d = ray.direction;
  double lift = 1;
  if (backend::max_abs(d) < std::numeric_limits<double>::min()) {  // subnormal: make it normal
    lift = 0x1p200;
    d = d * lift;
  }
  const double largest = backend::max_abs(d);
  const bool fits = largest >= LocalRay::least && largest <= LocalRay::most;
  const double size = fits ? 1 : power_of_two_below(largest);
  const double inverse = 1 / size;
  const LocalTimes times{{space.inverse_scale, inverse, lift}, {space.scale, size / lift}};
  const Point3 o = space.to_local(ray.origin);
  return {{o.x, o.y, o.z},
          {d.x * inverse, d.y * inverse, d.z * inverse},
          times.to_local(ray.t_min),
          times.to_local(ray.t_max),
          times};
}

bool make_box_ray(const LocalRay& ray, BoxRay& out) {
  if (!(max_abs(ray.origin) <= BoxRay::reach) || ray.t_min != 0) return make_moved(ray, out);
  out.shift = 0;
  out.negative = 0;
  for (std::size_t k = 0; k < 3; ++k) set_axis(k, ray.origin[k], ray.direction[k], 0, out);
  return true;
}

}  // namespace scenec::backend
