// White furnaces (S10): what a surface reflects in all under even light. Grids, no random numbers.
#include <gtest/gtest.h>

#include <cmath>

#include "backend/materials/bsdf.hpp"
#include "backend/materials/microfacet.hpp"

namespace scenec::backend {
namespace {

const GgxAlbedo& table() {
  static const GgxAlbedo albedo;
  return albedo;
}

Bsdf seen_at(Bsdf b, double cosine) {
  b.albedo = &table();
  b.wo = {std::sqrt(1 - cosine * cosine), 0, cosine};
  finish(b);
  return b;
}

// `scaled`: radiance that crossed the surface is scaled by the square of the index; undone here.
Rgb reflected_in_all(const Bsdf& b) {
  Rgb sum;
  constexpr int n = 256;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double lobe = std::fmod((i * n + j) * 0.6180339887498949, 1.0);
      const BsdfSample s = sample_bsdf(b, lobe, {(i + 0.5) / n, (j + 0.5) / n});
      sum += s.weight * (s.transmitted ? s.eta_scale : 1.0) / (n * n);
    }
  return sum;
}

TEST(Furnace, SingleScatteringIsThatOfTheReferenceTable) {
  // Height-correlated Smith, by cosine 1, 0.5, 0.1, 0.02.
  struct Row {
    double alpha;
    double albedo[4];
  };
  constexpr Row rows[] = {{1, {0.3067, 0.4506, 0.7599, 0.9212}},
                          {0.5, {0.6878, 0.6981, 0.8599, 0.9556}},
                          {0.25, {0.9156, 0.8571, 0.8915, 0.9677}},
                          {0.05, {0.9973, 0.9928, 0.9114, 0.9289}}};
  constexpr double cosines[4] = {1, 0.5, 0.1, 0.02};
  for (const Row& row : rows)
    for (int k = 0; k < 4; ++k) {
      const double cosine = cosines[k];
      const Vector3 wo{std::sqrt(1 - cosine * cosine), 0, cosine};
      double sum = 0;
      constexpr int n = 512;
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const Vector3 m = sample_ggx_normal(wo, row.alpha, {(i + 0.5) / n, (j + 0.5) / n});
          const Vector3 wi = m * (2 * dot(wo, m)) - wo;
          if (!(wi.z > 0)) continue;
          sum += ggx_visible_both(wo, wi, row.alpha) / ggx_visible(wo, row.alpha) / (n * n);
        }
      EXPECT_NEAR(sum, row.albedo[k], 0.005 * row.albedo[k]) << row.alpha << " " << cosine;
    }
}

TEST(Furnace, WhiteMetalLosesNothing) {
  for (const double alpha : {0.01, 0.05, 0.25, 0.5, 1.0})
    for (const double cosine : {1.0, 0.5, 0.1}) {
      Bsdf b;
      b.kind = BsdfKind::rough_metal;
      b.specular = {1, 1, 1};
      b.alpha = alpha;
      EXPECT_NEAR(reflected_in_all(seen_at(b, cosine)).g, 1, 0.01) << alpha << " " << cosine;
    }
}

TEST(Furnace, WithoutCompensationMetalReflectsWhatOneBounceDoes) {
  static const GgxAlbedo single = [] {
    GgxAlbedo albedo;
    albedo.lost_light = LostLight::left_out;
    return albedo;
  }();
  for (const double cosine : {1.0, 0.5}) {
    Bsdf b;
    b.kind = BsdfKind::rough_metal;
    b.specular = {1, 1, 1};
    b.alpha = 1;
    b.albedo = &single;
    b.wo = {std::sqrt(1 - cosine * cosine), 0, cosine};
    finish(b);
    EXPECT_NEAR(reflected_in_all(b).g, table().directional(cosine, 1).full(), 0.01) << cosine;
  }
}

TEST(Furnace, LambertReflectsItsAlbedo) {
  Bsdf b;
  b.kind = BsdfKind::diffuse;
  b.diffuse = {1, 0.5, 0};
  const Rgb all = reflected_in_all(seen_at(b, 0.3));
  EXPECT_NEAR(all.r, 1, 0.002);
  EXPECT_NEAR(all.g, 0.5, 0.001);
  EXPECT_EQ(all.b, 0);
}

TEST(Furnace, WhiteUnderACoatKeepsNearlyAll) {
  for (const double alpha : {0.05, 0.25, 1.0})
    for (const double cosine : {1.0, 0.5, 0.1}) {
      Bsdf b;
      b.kind = BsdfKind::coat;
      b.diffuse = {1, 1, 1};
      b.specular = {0.04, 0.04, 0.04};
      b.alpha = alpha;
      const double all = reflected_in_all(seen_at(b, cosine)).g;
      EXPECT_LE(all, 1.01) << alpha << " " << cosine;
      EXPECT_GE(all, 0.97) << alpha << " " << cosine;
    }
}

TEST(Furnace, RoughGlassReflectsOrLetsThroughWhatOneScatteringCan) {
  for (const double ior : {1.5, 1 / 1.5})
    for (const double alpha : {0.01, 0.1, 0.3, 1.0})
      for (const double cosine : {1.0, 0.5, 0.1}) {
        Bsdf b;
        b.kind = BsdfKind::rough_glass;
        b.specular = {1, 1, 1};
        b.alpha = alpha;
        b.ior = ior;
        const double all = reflected_in_all(seen_at(b, cosine)).g;
        EXPECT_LE(all, 1.003) << ior << " " << alpha << " " << cosine;
        // Facets in each other's shadow lose the rest: nothing for smooth glass.
        EXPECT_GE(all, alpha <= 0.01  ? 0.97
                       : alpha <= 0.3 ? 0.75
                                      : 0.4)
            << ior << " " << alpha << " " << cosine;
      }
}

}  // namespace
}  // namespace scenec::backend
