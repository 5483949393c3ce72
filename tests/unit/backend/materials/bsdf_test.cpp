// Every smooth lobe: what sampling says equals what evaluation says. Grids instead of random
// numbers, so nothing here is left to chance.
#include "backend/materials/bsdf.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "base/elementary.hpp"

namespace scenec::backend {
namespace {

const GgxAlbedo& table() {
  static const GgxAlbedo albedo;
  return albedo;
}

struct Case {
  std::string name;
  Bsdf bsdf;
};

Bsdf prepared(Bsdf b, double cosine) {
  b.albedo = &table();
  b.frame = Frame{};
  b.geometric = UnitVector3{};
  b.wo = {std::sqrt(1 - cosine * cosine), 0, cosine};
  finish(b);
  return b;
}

std::vector<Case> cases(double cosine) {
  std::vector<Case> out;
  Bsdf b;
  b.kind = BsdfKind::diffuse;
  b.diffuse = {0.8, 0.5, 0.2};
  out.push_back({"diffuse", prepared(b, cosine)});
  b.kind = BsdfKind::phong;
  b.specular = {0.2, 0.3, 0.1};
  b.exponent = 12;
  out.push_back({"phong", prepared(b, cosine)});
  for (const double alpha : {0.09, 0.5, 1.0}) {
    Bsdf f;
    f.alpha = alpha;
    f.specular = {0.9, 0.7, 0.3};
    f.kind = BsdfKind::rough_metal;
    out.push_back({"metal " + std::to_string(alpha), prepared(f, cosine)});
    f.kind = BsdfKind::coat;
    f.specular = {0.04, 0.05, 0.06};
    f.diffuse = {0.8, 0.5, 0.2};
    out.push_back({"coat " + std::to_string(alpha), prepared(f, cosine)});
    f.kind = BsdfKind::rough_glass;
    f.specular = {1, 1, 1};
    for (const double ior : {1.5, 1 / 1.5}) {
      f.ior = ior;
      out.push_back(
          {"glass " + std::to_string(alpha) + " " + std::to_string(ior), prepared(f, cosine)});
    }
  }
  return out;
}

TEST(bsdf, sampled_weight_and_integral_of_the_value_agree) {  // P01, P02
  for (const double cosine : {0.95, 0.4}) {
    for (const Case& c : cases(cosine)) {
      double by_sampling = 0;
      double sampled_probability = 0;
      constexpr int n = 160;
      for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
          // The lobe by a rank-1 lattice: each is asked in proportion.
          const double lobe = std::fmod((i * n + j) * 0.6180339887498949, 1.0);
          const BsdfSample s = sample_bsdf(c.bsdf, lobe, {(i + 0.5) / n, (j + 0.5) / n});
          by_sampling += s.weight.g / (n * n);
          if (is_black(s.weight)) continue;
          sampled_probability += 1.0 / (n * n);
          EXPECT_FALSE(s.specular);
          EXPECT_NEAR(evaluate(c.bsdf, s.wi).pdf, s.pdf, 1e-6 * s.pdf) << c.name;
        }
      }
      double integral = 0;
      double total_pdf = 0;
      constexpr int k = 700;
      for (int i = 0; i < k; ++i) {
        const double z = 2 * (i + 0.5) / k - 1;
        const double r = std::sqrt(1 - z * z);
        for (int j = 0; j < k; ++j) {
          const double phi = 2 * pi * (j + 0.5) / k;
          const BsdfValue v = evaluate(c.bsdf, {r * std::cos(phi), r * std::sin(phi), z});
          integral += v.f_cos.g * 4 * pi / (k * k);
          total_pdf += v.pdf * 4 * pi / (k * k);
        }
      }
      EXPECT_NEAR(by_sampling, integral, 0.012) << c.name << " cosine " << cosine;
      EXPECT_LE(total_pdf, 1.01) << c.name;
      // What is missing from 1 are samples below a surface.
      EXPECT_NEAR(total_pdf, sampled_probability, 0.02) << c.name << " cosine " << cosine;
    }
  }
}

TEST(bsdf, nothing_gains_energy) {
  for (const double cosine : {1.0, 0.7, 0.3, 0.05}) {
    for (const Case& c : cases(cosine)) {
      if (c.bsdf.kind == BsdfKind::rough_glass) continue;  // scaled by the square of the index
      Rgb sum;
      constexpr int n = 64;
      for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
          const double lobe = std::fmod((i * n + j) * 0.6180339887498949, 1.0);
          sum += sample_bsdf(c.bsdf, lobe, {(i + 0.5) / n, (j + 0.5) / n}).weight / (n * n);
        }
      }
      EXPECT_LE(max_component(sum), 1.01) << c.name << " cosine " << cosine;
    }
  }
}

TEST(bsdf, light_never_passes_the_geometric_surface) {  // S12
  for (Case& c : cases(0.4)) {
    // A shading normal 60 degrees off.
    c.bsdf.geometric = normalized(Vector3{std::sqrt(0.75), 0, 0.5});
    for (int i = 0; i < 40; ++i) {
      for (int j = 0; j < 40; ++j) {
        const BsdfSample s =
            sample_bsdf(c.bsdf, std::fmod(i * 0.618, 1.0), {(i + 0.5) / 40, (j + 0.5) / 40});
        if (is_black(s.weight)) continue;
        const bool below = dot(s.wi, c.bsdf.geometric) < 0;
        EXPECT_EQ(below, s.transmitted) << c.name;
      }
    }
  }
}

}  // namespace
}  // namespace scenec::backend
