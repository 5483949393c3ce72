#include "backend/materials/fresnel.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>

namespace scenec::backend {
namespace {

long double reference(long double cos_i, long double eta) {
  const long double sin_t = std::sqrt(1 - cos_i * cos_i) / eta;
  if (sin_t >= 1) return 1;
  const long double cos_t = std::sqrt(1 - sin_t * sin_t);
  const long double p = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
  const long double s = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
  return (p * p + s * s) / 2;
}

TEST(fresnel, dielectric_equals_the_formula_in_long_double) {  // S01
  for (const double eta : {1 / 2.4, 1 / 1.5, 1 - 1e-6, 1.0, 1 + 1e-6, 1.5, 2.4, 1e3}) {
    for (int i = 0; i <= 1000; ++i) {
      const double c = i / 1000.0;
      if (eta == 1 && i == 0) continue;  // grazing at nothing: 0 by definition here
      EXPECT_NEAR(fresnel_dielectric(c, eta).reflectance, static_cast<double>(reference(c, eta)),
                  1e-12)
          << c << " " << eta;
    }
  }
}

TEST(fresnel, critical_angle_has_no_gap_and_total_reflection_loses_nothing) {  // S02
  const double eta = 1 / 1.5;
  const double critical = std::sqrt(1 - eta * eta);
  for (int k = -4; k <= 4; ++k) {
    const DielectricFresnel f = fresnel_dielectric(critical * (1 + k * 0x1p-52), eta);
    EXPECT_GE(f.reflectance, 1 - 1e-6);
    EXPECT_LE(f.reflectance, 1);
  }
  EXPECT_EQ(fresnel_dielectric(0.1, eta).reflectance, 1);
}

TEST(fresnel, refraction_goes_back_where_it_came_from) {  // S03
  const Vector3 n{0, 0, 1};
  for (const double eta : {0.5, 1 / 1.33, 1.0, 1.5, 2.4}) {
    for (double s = 0; s < 0.45; s += 0.05) {
      const Vector3 w{s, 0.1, std::sqrt(1 - s * s - 0.01)};
      const DielectricFresnel f = fresnel_dielectric(w.z, eta);
      const Vector3 t = refracted(w, n, w.z, eta, f.cos_t);
      EXPECT_NEAR(length_squared(t), 1, 1e-14);
      const Vector3 back = refracted(t, -n, -t.z, 1 / eta, fresnel_dielectric(-t.z, 1 / eta).cos_t);
      EXPECT_NEAR(length_squared(back - w), 0, 1e-28);
    }
  }
}

TEST(fresnel, conductor_without_absorption_is_a_dielectric) {
  for (const double eta : {1.2, 1.5, 3.0}) {
    for (double c = 0.01; c <= 1; c += 0.01) {
      EXPECT_NEAR(fresnel_conductor(c, eta, 0), fresnel_dielectric(c, eta).reflectance, 1e-12);
    }
  }
  EXPECT_NEAR(fresnel_conductor(1, 0.2, 3.9), (0.8 * 0.8 + 3.9 * 3.9) / (1.2 * 1.2 + 3.9 * 3.9),
              1e-14);
  EXPECT_NEAR(fresnel_conductor(0, 0.2, 3.9), 1, 1e-14);
}

}  // namespace
}  // namespace scenec::backend
