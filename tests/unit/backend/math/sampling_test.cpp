// Every warp: in its domain at the corners of the square, invertible, and as dense as it says.
#include "backend/math/sampling.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "backend/math/rng.hpp"

namespace scenec::backend {
namespace {

constexpr double below_one = 1 - 0x1p-53;

Sample2 draw(std::uint64_t i) {
  return {random_unit(21, i, 0, 0), random_unit(21, i, 0, 1)};
}

TEST(Sampling, CornersStayInTheDomain) {
  for (const double u : {0.0, 0x1p-53, 0.5, below_one})
    for (const double v : {0.0, 0x1p-53, 0.5, below_one}) {
      const Sample2 s{u, v};
      const Sample2 d = sample_concentric_disk(s);
      EXPECT_LE(d.u * d.u + d.v * d.v, 1 + 4 * unit_roundoff);
      for (const UnitVector3& w :
           {sample_cosine_hemisphere(s), sample_uniform_hemisphere(s), sample_uniform_sphere(s),
            sample_uniform_cone(s, 1.0), sample_uniform_cone(s, 1e-20)})
        EXPECT_NEAR(length(w), 1, 8 * unit_roundoff);
      EXPECT_GE(sample_cosine_hemisphere(s).z(), 0);
      const Sample2 t = sample_uniform_triangle(s);
      EXPECT_TRUE(t.u >= 0 && t.v >= 0 && t.u + t.v <= 1);
    }
}

TEST(Sampling, InversesComeBack) {
  const double tolerance = 1e-12;  // of the test: far above the warps' ulps, far below a cell
  for (std::uint64_t i = 0; i < 50000; ++i) {
    const Sample2 s = draw(i);
    const auto expect_same = [&](Sample2 back, double allowed) {
      EXPECT_NEAR(back.u, s.u, allowed);
      const double turn = std::fabs(back.v - s.v);
      EXPECT_LE(std::fmin(turn, 1 - turn), allowed) << i;
    };
    expect_same(invert_concentric_disk(sample_concentric_disk(s)), tolerance);
    expect_same(invert_cosine_hemisphere(sample_cosine_hemisphere(s)), tolerance);
    if (s.u > 1e-3 && s.u < 1 - 1e-3) {
      expect_same(invert_uniform_hemisphere(sample_uniform_hemisphere(s)), tolerance);
      expect_same(invert_uniform_sphere(sample_uniform_sphere(s)), tolerance);
    }
    expect_same(invert_uniform_cone(sample_uniform_cone(s, 1e-6), 1e-6), 1e-9);
  }
}

TEST(Sampling, MomentsMatchTheDensities) {
  constexpr std::uint64_t count = 400000;
  double cosine = 0;
  double hemisphere = 0;
  double sphere = 0;
  double cone = 0;
  double disk = 0;
  double triangle = 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    const Sample2 s = draw(i);
    cosine += sample_cosine_hemisphere(s).z();
    hemisphere += sample_uniform_hemisphere(s).z();
    const UnitVector3 w = sample_uniform_sphere(s);
    sphere += w.z() * w.z();
    cone += 1 - sample_uniform_cone(s, 0.75).z();
    const Sample2 d = sample_concentric_disk(s);
    disk += d.u * d.u;
    triangle += sample_uniform_triangle(s).u;
  }
  // Means over `count` draws: 5 standard errors are below 0.003 for each.
  EXPECT_NEAR(cosine / count, 2.0 / 3, 0.003);
  EXPECT_NEAR(hemisphere / count, 0.5, 0.003);
  EXPECT_NEAR(sphere / count, 1.0 / 3, 0.003);
  EXPECT_NEAR(cone / count, 0.25, 0.003);
  EXPECT_NEAR(disk / count, 0.25, 0.003);
  EXPECT_NEAR(triangle / count, 1.0 / 3, 0.003);
}

TEST(Sampling, SmallConesKeepTheirDigits) {
  // pdf = 1 / (pi sin^2 (1 + sin^2 / 4 ...)) for small angles.
  for (const double sine : {1e-3, 1e-6, 1e-12, 1e-100}) {
    const double s2 = sine * sine;
    EXPECT_NEAR(pdf_uniform_cone(s2) * pi * s2, 1 - s2 / 4, 8 * unit_roundoff + s2 * s2);
    const UnitVector3 edge = sample_uniform_cone({below_one, 0}, s2);
    EXPECT_NEAR(edge.x() / sine, 1, 8 * unit_roundoff);
  }
  EXPECT_NEAR(pdf_uniform_cone(1.0), pdf_uniform_hemisphere(), 1e-16);
}

}  // namespace
}  // namespace scenec::backend
