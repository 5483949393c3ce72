// The float test of a slab never cuts off what the ray meets (G19, G20, G25): held against long
// double, whose own error is a millionth of the margin.
#include "backend/accel/box_ray.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "tests/unit/backend/geometry/random_rays.hpp"

namespace scenec::backend {
namespace {

using testing_support::Draw;

struct Slab {
  float near;
  float far;
};

// As the targets with and without a fused multiply-add compute it.
Slab slab_of(const BoxRay& ray, std::size_t k, float low, float high, bool fused) {
  const auto row = [&](std::uint32_t offset) { return offset / 32 % 2 == 0 ? low : high; };
  const auto at = [&](float plane, float add) {
    return fused ? std::fma(plane, ray.reciprocal[k], add) : plane * ray.reciprocal[k] + add;
  };
  return {at(row(ray.near_row(static_cast<std::uint32_t>(k))), ray.near_add[k]),
          at(row(ray.far_row(static_cast<std::uint32_t>(k))), ray.far_add[k])};
}

bool accepts(const BoxRay& ray, const float (&low)[3], const float (&high)[3], float limit,
             bool fused) {
  float near = 0;
  float far = limit;
  for (std::size_t k = 0; k < 3; ++k) {
    const Slab s = slab_of(ray, k, low[k], high[k], fused);
    EXPECT_FALSE(std::isnan(s.near) || std::isnan(s.far));
    near = std::fmax(near, s.near);
    far = std::fmin(far, s.far);
  }
  return near <= far;
}

// Directions of all sorts: ordinary ones, and components from the list of hard cases.
Vector3 awkward_direction(Draw& draw) {
  constexpr std::array parts{0.0,   -0.0,    1e-310,   -1e-310, 1.0,     -1.0,
                             1e300, 0x1p-52, -0x1p-53, 1e-9,    -0x1p-24};
  const auto pick = [&] {
    const double u = draw.unit();
    return u < 0.5 ? draw.between(-1, 1)
                   : parts[static_cast<std::size_t>(draw.unit() * parts.size())];
  };
  while (true) {
    const Vector3 d{pick(), pick(), pick()};
    if (max_abs(d) > 0) return d;
  }
}

double origin_coordinate(Draw& draw) {
  const double u = draw.unit();
  if (u < 0.3) return static_cast<float>(draw.between(-1, 1));  // on a plane of floats
  if (u < 0.8) return draw.between(-3, 3);
  return draw.between(-1, 1) * draw.power_of_ten(0, 12);
}

// A box about the point of the ray at `t`, down to the point itself rounded outward.
bool box_about(const LocalRay& ray, double t, Draw& draw, float (&low)[3], float (&high)[3]) {
  for (std::size_t k = 0; k < 3; ++k) {
    const long double p = static_cast<long double>(ray.origin[k]) +
                          static_cast<long double>(t) * static_cast<long double>(ray.direction[k]);
    if (!(std::fabs(p) < 0.999L)) return false;
    low[k] = high[k] = static_cast<float>(p);
    if (static_cast<long double>(low[k]) > p) low[k] = std::nextafter(low[k], -2.0F);
    if (static_cast<long double>(high[k]) < p) high[k] = std::nextafter(high[k], 2.0F);
    if (draw.unit() < 0.3) low[k] = std::fmax(-1.0F, low[k] - static_cast<float>(draw.unit()));
    if (draw.unit() < 0.3) high[k] = std::fmin(1.0F, high[k] + static_cast<float>(draw.unit()));
  }
  return true;
}

TEST(BoxRay, NoBoxOnTheRayIsLeftOut) {
  Draw draw(1);
  int tested = 0;
  for (int i = 0; i < 400000; ++i) {
    Ray ray{{origin_coordinate(draw), origin_coordinate(draw), origin_coordinate(draw)},
            awkward_direction(draw)};
    if (draw.unit() < 0.5) {  // aimed at the tree, from wherever it is
      ray.direction =
          Point3{draw.between(-1, 1), draw.between(-1, 1), draw.between(-1, 1)} - ray.origin;
    }
    if (draw.unit() < 0.2) ray.t_min = draw.between(-2, 2);
    if (draw.unit() < 0.3) ray.direction = ray.direction * draw.power_of_ten(-8, 8);
    const LocalRay local = make_local(TreeSpace{}, ray);
    // Some t at which the ray is within the tree.
    double t = draw.between(0, 3);
    if (!(std::fabs(local.origin[0]) < 1)) {
      const std::size_t k = 0;
      if (local.direction[k] != 0) t = (draw.between(-1, 1) - local.origin[k]) / local.direction[k];
    }
    if (!(t >= local.t_min)) continue;
    float low[3];
    float high[3];
    if (!box_about(local, t, draw, low, high)) continue;
    BoxRay box;
    ASSERT_TRUE(make_box_ray(local, box)) << i;
    ++tested;
    for (const bool fused : {false, true})
      ASSERT_TRUE(accepts(box, low, high, box.limit(t), fused)) << i << " fused " << fused;
  }
  EXPECT_GT(tested, 60000);
}

TEST(BoxRay, ErrorBoundOfTheSlab) {
  Draw draw(2);
  double worst = 0;
  for (int i = 0; i < 300000; ++i) {
    const Ray ray{draw.point(4), draw.direction() * draw.power_of_ten(-7, 7)};
    const LocalRay local = make_local(TreeSpace{}, ray);
    BoxRay box;
    ASSERT_TRUE(make_box_ray(local, box));
    for (std::size_t k = 0; k < 3; ++k) {
      if (std::fabs(local.direction[k]) < 2 * static_cast<double>(BoxRay::smallest)) continue;
      const auto plane = static_cast<float>(draw.between(-1, 1));
      const long double exact =
          (static_cast<long double>(plane) - static_cast<long double>(local.origin[k])) /
          static_cast<long double>(local.direction[k]);
      for (const bool fused : {false, true}) {
        const Slab s = slab_of(box, k, plane, plane, fused);
        EXPECT_LE(static_cast<long double>(s.near), exact);
        EXPECT_GE(static_cast<long double>(s.far), exact);
        // How much of the margin the roundings used: 7.2 of 12 by the derivation, of which double
        // spares 2.
        const long double margin = static_cast<long double>(BoxRay::slack) *
                                   (1 + std::fabs(local.origin[k])) *
                                   std::fabs(static_cast<long double>(box.reciprocal[k]));
        const long double used = 1 - (exact - static_cast<long double>(s.near)) / margin;
        worst = std::fmax(worst, static_cast<double>(used));
      }
    }
  }
  EXPECT_LT(worst, 7.2 / 12);
  RecordProperty("worst_share_of_margin", std::to_string(worst));
}

TEST(BoxRay, RaysThatPassTheTreeAreNone) {
  BoxRay box;
  const auto none = [&](const Ray& ray) {
    return !make_box_ray(make_local(TreeSpace{}, ray), box);
  };
  EXPECT_TRUE(none({{0, 10, 0}, {0, 0, 1}}));
  EXPECT_TRUE(none({{0, 10, 0}, {0, 1, 0}}));
  EXPECT_TRUE(none({{0, 10, 0}, {0, -1, 0}, 0, 8}));
  EXPECT_TRUE(none({{0, 10, 0}, {0, -1, 0}, 12, 20}));
  EXPECT_FALSE(none({{0, 10, 0}, {0, -1, 0}}));
  EXPECT_FALSE(none({{1e300, 0, 0}, {-1, 0, 0}}));
  EXPECT_TRUE(none({{1e300, 0, 0}, {1, 0, 0}}));
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(none({{0.5, 0, 0}, {1, 0, 0}, -infinity, infinity}));
}

TEST(BoxRay, LocalTimesKeepTheirBits) {
  const TreeSpace space{{0, 0, 0}, 0x1p-7, 0x1p7};
  for (const double size : {0x1p-300, 0x1p-3, 1.0, 0x1p300}) {
    const LocalRay local = make_local(space, {{0, 0, 0}, {0, 3 * size, size}});
    EXPECT_EQ(local.times.to_world(local.times.to_local(0.1)), 0.1);
    // Only what is far from 1 is scaled.
    const bool kept = 3 * size >= LocalRay::least && 3 * size <= LocalRay::most;
    EXPECT_EQ(local.direction[1], kept ? 3 * size : 1.5);
  }
}

}  // namespace
}  // namespace scenec::backend
