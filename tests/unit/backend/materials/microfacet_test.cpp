#include "backend/materials/microfacet.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "backend/materials/fresnel.hpp"
#include "backend/materials/ggx_albedo.hpp"

namespace scenec::backend {
namespace {

Vector3 at(double cosine) {
  return {std::sqrt(1 - cosine * cosine), 0, cosine};
}

TEST(microfacet, projected_area_of_the_facets_is_one) {  // S06
  for (const double alpha : {1e-4, 1e-3, 0.01, 0.1, 0.5, 1.0}) {
    // In t = tan^2 / alpha^2 mapped to t = x / (1 - x) the integrand is smooth for every alpha.
    double sum = 0;
    constexpr int n = 2000;
    for (int i = 0; i < n; ++i) {
      const double x = (i + 0.5) / n;
      const double tan2 = alpha * alpha * x / (1 - x);
      const double cos2 = 1 / (1 + tan2);
      const Vector3 m{std::sqrt(tan2 * cos2), 0, std::sqrt(cos2)};
      // d omega cos = pi cos^4 d(tan^2)
      sum += ggx_density(m, alpha) * pi * cos2 * cos2 * alpha * alpha / ((1 - x) * (1 - x)) / n;
    }
    EXPECT_NEAR(sum, 1, 1e-6) << alpha;
  }
}

TEST(microfacet, shadowing_stays_in_range_at_grazing_angles) {  // S08
  for (const double a : {1e-12, 1e-8, 1e-4, 0.5, 1.0}) {
    for (const double b : {1e-12, 1e-8, 1e-4, 0.5, 1.0}) {
      for (const double alpha : {1e-3, 0.1, 1.0}) {
        const double ratio = ggx_visible_both(at(a), at(b), alpha) / ggx_visible(at(a), alpha);
        EXPECT_TRUE(ratio >= 0 && ratio <= 1) << a << " " << b << " " << alpha;
      }
    }
  }
}

TEST(microfacet, normals_are_sampled_with_their_density) {
  // E[g / pdf] over sampled normals against quadrature of g, g = m.z^2 on the visible side.
  for (const double alpha : {0.1, 0.5, 1.0}) {
    for (const double cosine : {0.1, 0.7, 1.0}) {
      const Vector3 wo = at(cosine);
      double sampled = 0;
      constexpr int n = 300;
      for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
          const Vector3 m = sample_ggx_normal(wo, alpha, {(i + 0.5) / n, (j + 0.5) / n});
          EXPECT_GE(m.z, 0);
          sampled += m.z * m.z / (n * n);
        }
      }
      double integral = 0;
      double total = 0;
      constexpr int k = 800;
      for (int i = 0; i < k; ++i) {
        // cos = 1 - w^2: fine steps where narrow lobes are.
        const double w = (i + 0.5) / k;
        const double c = 1 - w * w;
        const double s = std::sqrt(1 - c * c);
        const double measure = 2 * pi * 2 * w / k;
        for (int j = 0; j < 200; ++j) {
          const double phi = 2 * pi * (j + 0.5) / 200;
          const double pdf = pdf_ggx_normal(wo, {s * std::cos(phi), s * std::sin(phi), c}, alpha);
          integral += pdf * c * c * measure / 200;
          total += pdf * measure / 200;
        }
      }
      EXPECT_NEAR(total, 1, 2e-3);
      EXPECT_NEAR(sampled, integral, 3e-3) << alpha << " " << cosine;
    }
  }
}

TEST(ggx_albedo, equals_the_published_values) {  // S10
  const GgxAlbedo table;
  struct Row {
    double alpha;
    double values[3];  // cosine 1, .5, .1
  };
  for (const Row& row : {Row{1, {.3067, .4506, .7599}}, Row{.5, {.6878, .6981, .8599}},
                         Row{.25, {.9156, .8571, .8915}}, Row{.05, {.9973, .9928, .9114}}}) {
    const double cosines[3] = {1, .5, .1};
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(table.directional(cosines[i], row.alpha).full(), row.values[i], 0.012)
          << row.alpha << " " << cosines[i];
    }
  }
  EXPECT_NEAR(table.average(0).of({0.04, 0.04, 0.04}).r, 0.04 + 0.96 / 21, 1e-3);
}

}  // namespace
}  // namespace scenec::backend
