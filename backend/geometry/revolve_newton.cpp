// The method of the course's ray casters for surfaces of revolution, for `solver = .newton`: t is
// eliminated by the height, t(s) = (h(s) - o_y) / d_y, and f(s)^2, f = rho(t(s))^2 - r(s)^2, is
// driven to 0 by a damped Newton iteration from both ends of each segment.
//
// Kept to be compared with, faults of method included: level rays are divided by a d_y near 0,
// where f' = 0 (a pole with a horizontal tangent) a start does not move, two starts find at most
// two roots, squaring makes every root a double one. What was merely a slip there is right here:
// hits outside the interval do not hide those inside, and the nearest counts. docs/numerics.md says
// what it misses.
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "backend/geometry/profile_point.hpp"
#include "backend/geometry/revolve.hpp"

namespace scenec::backend {
namespace {

constexpr int max_steps = 1000;
constexpr double damping = 0.1;
// |f| of this share of the profile's squared size counts as 0: about what the original's constant
// says for a profile of size 1 (its square is compared with 1e-10).
constexpr double settled = 0x1p-17;

struct Target {
  Vector3 o;  // the ray, its axis along y
  Vector3 d;
  double tolerance = 0;
};

// Newton on g = f^2 steps by g / g' = f / (2 f').
bool iterate(const Target& ray, std::span<const ProfilePoint> control, double& s, double& t) {
  for (int i = 0; i < max_steps; ++i) {
    const ProfileJet jet = evaluate_profile(control, s);
    t = (jet.point.height - ray.o.y) / ray.d.y;
    const double x = ray.o.x + t * ray.d.x;
    const double z = ray.o.z + t * ray.d.z;
    const double f = x * x + z * z - jet.point.radius * jet.point.radius;
    if (std::fabs(f) <= ray.tolerance) return true;
    const double speed = jet.slope.height / ray.d.y;
    const double slope =
        2 * (x * ray.d.x + z * ray.d.z) * speed - 2 * jet.point.radius * jet.slope.radius;
    s -= damping * f / (2 * slope);
    if (!(s >= 0 && s <= 1)) return false;  // NaN too
  }
  return false;
}

double size_of(const Revolve& revolve) {
  double size = 0;
  for (const Revolve::Piece& p : revolve.pieces())
    size = std::fmax(
        size, std::fmax(p.radius_max, std::fmax(std::fabs(p.height_min), std::fabs(p.height_max))));
  return size;
}

}  // namespace

bool intersect_by_newton(const Revolve& revolve, const Ray& ray, ShapeHit& out) {
  const double size = size_of(revolve);
  const Target target{axis_from_object(as_vector(ray.origin), revolve.axis()),
                      axis_from_object(ray.direction, revolve.axis()), settled * size * size};
  bool found = false;
  double nearest = ray.t_max;
  for (std::size_t i = 0; i < revolve.profile().size(); ++i) {
    for (const double start : {0.0, 1.0}) {
      double s = start;
      double t = 0;
      if (!iterate(target, revolve.profile().segment(i), s, t)) continue;
      if (!(t >= ray.t_min && t <= nearest) || std::isinf(t)) continue;
      if (found && t == nearest) continue;
      nearest = t;
      out = {t, static_cast<std::uint32_t>(i), s, 1};  // not certified
      found = true;
    }
  }
  return found;
}

}  // namespace scenec::backend
