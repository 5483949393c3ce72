// Our own sin, cos, tan, asin, acos, atan2, exp, log and pow: plain double multiplications and
// additions, no libm and no fused operations, so every machine and compiler returns the same bits
// (libm picks its code by CPU). Square root, division, floor and the like are exact in IEEE 754 and
// come from <cmath>.
//
// Domain:     all doubles; sin, cos and tan for |x| <= angle_limit, beyond which they return NaN.
// Method:     arguments reduced and leading terms summed in double-double (Dekker 1971), short
//             Taylor tails; pi/2 as three doubles (Cody and Waite 1980); log through atanh; pow as
//             exp(y log x) with the logarithm in double-double.
// Error:      below 0.8 ulp each, tan below 1 ulp.
// Degenerate: as in C Annex F: pow(x, 0) = 1 also for NaN, pow(0, y < 0) = inf, log(0) = -inf,
//             log(x < 0) = NaN, acos and asin outside [-1, 1] NaN, signed zeros kept.
// Proof:      tests/unit/base/elementary_test.cpp, against long double.
#pragma once

namespace scenec {

inline constexpr double pi = 3.14159265358979323846;
// What sin, cos and tan take; also the angles for which their reduction has enough bits.
inline constexpr double angle_limit = 0x1p48;

struct SinCos {
  double sin = 0;
  double cos = 1;
};

[[nodiscard]] double sin(double x);
[[nodiscard]] double cos(double x);
[[nodiscard]] SinCos sin_cos(double x);
[[nodiscard]] double tan(double x);
[[nodiscard]] double asin(double x);
[[nodiscard]] double acos(double x);
[[nodiscard]] double atan2(double y, double x);
[[nodiscard]] double exp(double x);
[[nodiscard]] double log(double x);
[[nodiscard]] double pow(double x, double y);

}  // namespace scenec
