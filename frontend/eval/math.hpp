// What the language's functions add to base/elementary.hpp: exact quarter turns, so that
// `rotate_y(90deg)` moves the axes onto each other, and lengths that do not overflow. No libm, so a
// scene compiles to the same bits (and the same hash) on every machine.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/elementary.hpp"

namespace scenec::frontend::math {

// k when the angle is k quarter turns to within the rounding of its conversion from degrees
// (two roundings, so at most 2 ulp of the angle).
[[nodiscard]] inline std::optional<int> quarter_turns(double angle) {
  const double turns = angle / (pi / 2);
  const double nearest = std::nearbyint(turns);
  if (!(std::fabs(nearest) < 1e6)) return std::nullopt;
  constexpr double two_ulp = 0x1p-51;
  if (std::fabs(turns - nearest) > two_ulp * std::fabs(nearest)) return std::nullopt;
  return static_cast<int>(nearest);
}

[[nodiscard]] inline double sine(double angle) {
  const auto quarters = quarter_turns(angle);
  if (!quarters) return sin(angle);
  const int phase = ((*quarters % 4) + 4) % 4;
  return phase == 1 ? 1.0 : phase == 3 ? -1.0 : 0.0;
}
[[nodiscard]] inline double cosine(double angle) {
  const auto quarters = quarter_turns(angle);
  if (!quarters) return cos(angle);
  const int phase = ((*quarters % 4) + 4) % 4;
  return phase == 0 ? 1.0 : phase == 2 ? -1.0 : 0.0;
}
// The length of a vector without overflow or underflow of the squares: scaled by a power of two, so
// that only the squares, the sums and the root round. Infinite when the length is.
[[nodiscard]] inline double length(const std::array<double, 3>& v) {
  const double largest = std::max({std::fabs(v[0]), std::fabs(v[1]), std::fabs(v[2])});
  if (!(largest > 0) || !std::isfinite(largest)) return largest;
  int exponent = 0;
  static_cast<void>(std::frexp(largest, &exponent));
  const double x = std::ldexp(v[0], -exponent);
  const double y = std::ldexp(v[1], -exponent);
  const double z = std::ldexp(v[2], -exponent);
  return std::ldexp(std::sqrt(x * x + y * y + z * z), exponent);
}

}  // namespace scenec::frontend::math
