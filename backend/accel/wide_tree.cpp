#include "backend/accel/wide_tree.hpp"

#include <cmath>

namespace scenec::backend {
namespace {

// Coordinates up to four times the size cost two of a float's 24 bits; beyond that rebasing pays.
constexpr double far_off = 4;
// Scales within this range leave room for everything else that is multiplied with them.
constexpr int max_exponent = 1000;

}  // namespace

TreeSpace space_of(const Bounds3& bounds) {
  TreeSpace space;
  if (bounds.empty() || !bounds.finite()) return space;
  const Vector3 half = 0.5 * as_vector(bounds.max) - 0.5 * as_vector(bounds.min);
  const Point3 middle = bounds.centroid();
  const double size = max_abs(half);
  double reach = std::fmax(max_abs(as_vector(bounds.min)), max_abs(as_vector(bounds.max)));
  if (reach > far_off * size) {
    space.center = middle;
    // The rounding of the centre counts too.
    const Point3 low{bounds.min.x - middle.x, bounds.min.y - middle.y, bounds.min.z - middle.z};
    const Point3 high{bounds.max.x - middle.x, bounds.max.y - middle.y, bounds.max.z - middle.z};
    reach = std::fmax(max_abs(as_vector(low)), max_abs(as_vector(high)));
  }
  if (!(reach > 0)) return space;
  int exponent = 0;
  std::frexp(reach, &exponent);
  exponent = exponent > max_exponent    ? max_exponent
             : exponent < -max_exponent ? -max_exponent
                                        : exponent;
  space.scale = std::ldexp(1.0, -exponent);
  space.inverse_scale = std::ldexp(1.0, exponent);
  return space;
}

}  // namespace scenec::backend
