// Reflectance of smooth interfaces, unpolarised.
//
// Domain:     cos_i in [0, 1]; eta > 0, the index behind the interface over the index before it.
// Method:     Fresnel's equations from cosines (Snell), not from angles; conductors after
//             Born and Wolf in the form of Lazanyi and Szirmay-Kalos, exact in n and k.
// Error:      1e-12 absolute (S01); reflectance + transmittance is 1 by construction.
// Degenerate: beyond the critical angle the reflectance is 1 and cos_t is 0; eta = 1 reflects
//             nothing and bends nothing.
// Proof:      tests/unit/backend/materials/fresnel_test.cpp.
#pragma once

#include <cmath>

#include "backend/math/color.hpp"
#include "backend/math/vec.hpp"

namespace scenec::backend {

struct DielectricFresnel {
  double reflectance = 1;
  double cos_t = 0;  // 0: total reflection
};

[[nodiscard]] inline DielectricFresnel fresnel_dielectric(double cos_i, double eta) {
  if (eta == 1) return {0, cos_i};
  // 1 - sin^2 / eta^2 without its cancellation near grazing angles and eta = 1.
  const double scaled = (eta - 1) * (eta + 1) + cos_i * cos_i;
  if (!(scaled > 0)) return {1, 0};
  const double cos_t = std::sqrt(scaled) / eta;
  const double parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
  const double perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
  return {(parallel * parallel + perpendicular * perpendicular) / 2, cos_t};
}

[[nodiscard]] inline double fresnel_conductor(double cos_i, double eta, double k) {
  const double cos2 = cos_i * cos_i;
  const double sin2 = 1 - cos2;
  const double eta2 = eta * eta;
  const double k2 = k * k;
  const double t0 = eta2 - k2 - sin2;
  const double a2_plus_b2 = std::sqrt(t0 * t0 + 4 * eta2 * k2);
  const double t1 = a2_plus_b2 + cos2;
  const double a = std::sqrt(larger(0, 0.5 * (a2_plus_b2 + t0)));
  const double t2 = 2 * a * cos_i;
  const double perpendicular = (t1 - t2) / (t1 + t2);
  const double t3 = cos2 * a2_plus_b2 + sin2 * sin2;
  const double t4 = t2 * sin2;
  const double parallel = perpendicular * (t3 - t4) / (t3 + t4);
  return (parallel + perpendicular) / 2;
}

// (1 - cos)^5, the share of white in Schlick's approximation (1994).
[[nodiscard]] inline double schlick_share(double cos_i) {
  const double m = 1 - cos_i;
  const double m2 = m * m;
  return m2 * m2 * m;
}
[[nodiscard]] inline Rgb fresnel_schlick(double cos_i, const Rgb& f0) {
  const double s = schlick_share(cos_i);
  return f0 * (1 - s) + Rgb::gray(s);
}

// `w` mirrored at `n`: both point away from the surface.
[[nodiscard]] inline Vector3 reflected(const Vector3& w, const Vector3& n) {
  return n * (2 * dot(w, n)) - w;
}

// The direction behind the interface; precondition: cos_i = dot(w, n) >= 0 and cos_t > 0 as from
// fresnel_dielectric.
[[nodiscard]] inline Vector3 refracted(const Vector3& w, const Vector3& n, double cos_i, double eta,
                                       double cos_t) {
  if (eta == 1) return -w;
  return n * (cos_i / eta - cos_t) - w / eta;
}

}  // namespace scenec::backend
