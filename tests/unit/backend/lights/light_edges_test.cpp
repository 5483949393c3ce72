// Lights at the edges of their domain: touching, half below the horizon, seen from within, the
// corners of the square, an occluder just before and just behind them.
#include <gtest/gtest.h>

#include <cmath>

#include "backend/accel/scene_accel.hpp"
#include "backend/lights/light_table.hpp"
#include "base/elementary.hpp"
#include "tests/unit/backend/scene_kit.hpp"

namespace scenec::backend {
namespace {

Emitter ball(const Point3& center, double radius) {
  Emitter e;
  e.shape = EmitterShape::sphere;
  e.origin = center;
  e.radius = radius;
  e.radiance = {1, 1, 1};
  measure(e);
  return e;
}

// Of a surface facing +z at the origin, by a grid of n x n samples.
double irradiance(const Emitter& e, int n) {
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const auto s = sample_emitter(e, {0, 0, 0}, {(i + 0.5) / n, (j + 0.5) / n});
      if (s) sum += std::fmax(0, s->wi.z()) / s->pdf;
    }
  return sum / n / n;
}

TEST(LightEdges, SphereNearlyTouchingGivesTheClosedForm) {  // P03
  const double ratio = 1 + 0x1p-20;
  const double expected = pi / (ratio * ratio);
  EXPECT_NEAR(irradiance(ball({0, 0, ratio}, 1), 64), expected, 1e-9 * expected);
}

TEST(LightEdges, FromWithinASphereTheIrradianceIsPi) {  // P04
  // Uniform in area from the middle: half the directions, cosine pi.
  EXPECT_NEAR(irradiance(ball({0, 0, 0}, 2), 512), pi, 1e-4 * pi);
  // Off the middle density and distance vary, the answer does not.
  EXPECT_NEAR(irradiance(ball({0.6, 0.2, 0.3}, 2), 512), pi, 1e-3 * pi);
}

// P06: what the horizon leaves of a sphere, against long double quadrature over its cone.
TEST(LightEdges, SphereHalfBelowTheHorizonAgreesWithQuadrature) {
  for (const double height : {0.0, 0.4, -0.4}) {
    const double d = std::sqrt(4 + height * height);
    // Directions at angle a off the axis and turned by p: cosine = cos a sin t + sin a cos t cos p,
    // t the elevation of the axis.
    const long double top = std::asin(1.0L / d);
    const long double sin_t = height / d;
    const long double cos_t = 2 / d;
    constexpr int n = 20000;
    long double sum = 0;
    for (int i = 0; i < n; ++i) {
      const long double a = top * (i + 0.5L) / n;
      const long double s = std::sin(a);
      const long double c = std::cos(a);
      // The turns that see the upper side: cos p > -c sin_t / (s cos_t); integrated exactly.
      const long double edge = -c * sin_t / (s * cos_t);
      const long double turn = edge <= -1 ? 3.141592653589793238L : edge >= 1 ? 0 : std::acos(edge);
      sum += 2 * (c * sin_t * turn + s * cos_t * std::sin(turn)) * s * top / n;
    }
    const auto expected = static_cast<double>(sum);
    EXPECT_NEAR(irradiance(ball({2, 0, height}, 1), 2000), expected, 2e-6 * expected) << height;
  }
}

TEST(LightEdges, OnlyWhatStandsNearerThanTheLightShadowsIt) {  // P07
  for (const double size : {1e-3, 1.0, 1e3}) {
    Hit floor;
    floor.geometric_normal = normalized(Vector3{0, 1, 0});
    const Emitter e = ball({0, 3 * size, 0}, size);
    const double nearest = 2 * size;
    for (const double relative : {-1e-6, 1e-6}) {
      SceneAccel world;
      world.add(0, Sphere{e.origin, e.radius});
      world.add(1, Disk{{0, nearest * (1 + relative), 0}, normalized(Vector3{0, 1, 0}), size / 2});
      ThreadPool pool(1);
      world.build(pool);
      // Straight up, to the light's nearest point.
      EmitterSample s;
      s.point = {0, nearest, 0};
      s.normal = normalized(Vector3{0, -1, 0});
      EXPECT_EQ(world.occluded(spawn_segment(surface_point(floor), {s.point, e.error, s.normal})),
                relative < 0)
          << size;
    }
  }
}

TEST(LightEdges, ASunIsShadowedFromAnyDistance) {  // P10
  const auto floor_under = [](double height) {
    test::SceneKit kit;
    kit.place(ir::Plane{}, kit.matt(0.5));
    kit.place(ir::Quad{{-1e3, height, -1e3}, {2e3, 0, 0}, {0, 0, 2e3}}, kit.matt(0));
    kit.light(ir::DirectionalLight{{0, -1, 0}, 2.0, ir::white});
    kit.settings.size = {1, 1};
    kit.pinhole({0, 0.5, 0}, {0, 0, 0}, 0.01, {0, 0, -1});
    kit.settings.max_depth = 1;
    return test::mean(test::render(kit)).r;
  };
  EXPECT_NEAR(floor_under(-1), 0.5 / pi * 2, 1e-7);
  for (const double height : {1.0, 1e6, 1e12}) EXPECT_EQ(floor_under(height), 0) << height;
}

// P11: numbers at the ends of their interval.
TEST(LightEdges, EveryEmitterIsFiniteAtTheCornersOfTheSquare) {
  const double below_one = 1 - 0x1p-53;
  for (int shape = 0; shape <= static_cast<int>(EmitterShape::tube); ++shape) {
    Emitter e;
    e.shape = static_cast<EmitterShape>(shape);
    e.origin = {0.2, 2, -0.1};
    e.a = {0.5, 0.1, 0};
    e.b = {-0.1, 0.2, 0.4};
    e.c = {0.05, 0.6, -0.1};
    e.radius = 0.3;
    if (e.shape == EmitterShape::cut_sphere) {
      e.shape = EmitterShape::sphere;
      cut_by_plane(e, {0, 1, 0}, 1.8);
      ASSERT_EQ(e.shape, EmitterShape::cut_sphere);
    }
    measure(e);
    for (const double u : {0.0, 0x1p-53, below_one})
      for (const double v : {0.0, 0x1p-53, below_one}) {
        const auto s = sample_emitter(e, {1, 0.5, 1}, {u, v});
        ASSERT_TRUE(s) << shape;
        EXPECT_TRUE(std::isfinite(s->pdf) && s->pdf > 0) << shape;
        EXPECT_TRUE(is_finite(as_vector(s->point))) << shape;
        EXPECT_NEAR(length(s->wi), 1, 1e-14) << shape;
      }
  }
}

}  // namespace
}  // namespace scenec::backend
