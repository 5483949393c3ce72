// Elementary functions of the front end, behind one header: the host's today, to be exchanged for
// the deterministic versions of the backend when compiled scenes must agree across C libraries.
// Quarter turns are exact, so that `rotate_y(90deg)` moves the axes onto each other.
#pragma once

#include <cmath>
#include <numbers>
#include <optional>

namespace scenec::frontend::math {

inline constexpr double pi = std::numbers::pi;

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
  if (!quarters) return std::sin(angle);
  const int phase = ((*quarters % 4) + 4) % 4;
  return phase == 1 ? 1.0 : phase == 3 ? -1.0 : 0.0;
}
[[nodiscard]] inline double cosine(double angle) {
  const auto quarters = quarter_turns(angle);
  if (!quarters) return std::cos(angle);
  const int phase = ((*quarters % 4) + 4) % 4;
  return phase == 0 ? 1.0 : phase == 2 ? -1.0 : 0.0;
}
[[nodiscard]] inline double tangent(double angle) {
  return std::tan(angle);
}
[[nodiscard]] inline double arc_sine(double x) {
  return std::asin(x);
}
[[nodiscard]] inline double arc_cosine(double x) {
  return std::acos(x);
}
[[nodiscard]] inline double arc_tangent(double x) {
  return std::atan(x);
}
[[nodiscard]] inline double arc_tangent(double y, double x) {
  return std::atan2(y, x);
}
[[nodiscard]] inline double power(double base, double exponent) {
  return std::pow(base, exponent);
}
[[nodiscard]] inline double exponential(double x) {
  return std::exp(x);
}
[[nodiscard]] inline double logarithm(double x) {
  return std::log(x);
}

}  // namespace scenec::frontend::math
