// The angle of a point around an axis as a texture coordinate in [0, 1).
#pragma once

#include "base/elementary.hpp"

namespace scenec::backend {

// Counter-clockwise from +x; (0, 0) gives 0.
[[nodiscard]] inline double turn_fraction(double y, double x) {
  const double turn = atan2(y, x) / (2 * pi);
  const double wrapped = turn < 0 ? turn + 1 : turn;
  return wrapped < 1 ? wrapped : 0.0;  // a tiny negative turn rounds to 1
}

}  // namespace scenec::backend
