// Sine and cosine of angles given in turns, for warps: nothing to reduce but whole quarters, which
// is exact. Cheaper than base/elementary.hpp, whose last half ulp no sample can tell.
//
// Domain:     |turns| <= 2^20.
// Method:     the nearest quarter is taken off exactly; Taylor series to x^17 on |x| <= pi / 4.
// Error:      2 ulp of 1, absolute; sin^2 + cos^2 = 1 to 4 u.
// Degenerate: none; whole quarters give exact 0 and 1.
// Proof:      tests/unit/backend/math/turn_test.cpp.
#pragma once

#include <cmath>

#include "base/elementary.hpp"

namespace scenec::backend {

// |x| slightly above pi / 4 at most.
[[nodiscard]] inline double sin_within_eighth(double x) {
  const double z = x * x;
  const double high = -1.0 / 39916800 + z * (1.0 / 6227020800 + z * (-1.0 / 1307674368000));
  const double low = -1.0 / 6 + z * (1.0 / 120 + z * (-1.0 / 5040 + z * (1.0 / 362880)));
  const double z2 = z * z;
  return x + x * z * (low + z2 * z2 * high);
}
[[nodiscard]] inline double cos_within_eighth(double x) {
  const double z = x * x;
  const double high = 1.0 / 479001600 + z * (-1.0 / 87178291200 + z * (1.0 / 20922789888000));
  const double low = 1.0 / 24 + z * (-1.0 / 720 + z * (1.0 / 40320 + z * (-1.0 / 3628800)));
  const double z2 = z * z;
  return 1 - (0.5 * z - z2 * (low + z2 * z2 * high));
}

// The sine and cosine of 2 pi turns.
[[nodiscard]] inline SinCos sin_cos_of_turns(double turns) {
  const double quarters = std::floor(turns * 4 + 0.5);
  const double x = (turns - quarters * 0.25) * (2 * pi);
  const double s = sin_within_eighth(x);
  const double c = cos_within_eighth(x);
  // Without branches: which quarter it is nobody can predict.
  const auto quarter = static_cast<int>(quarters);
  const bool odd = (quarter & 1) != 0;
  const double sine = odd ? c : s;
  const double cosine = odd ? s : c;
  return {(quarter & 2) != 0 ? -sine : sine, ((quarter + 1) & 2) != 0 ? -cosine : cosine};
}

}  // namespace scenec::backend
