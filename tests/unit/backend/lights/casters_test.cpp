// Routes by way of spheres in space, and who is asked for them.
#include "backend/lights/casters.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "backend/materials/fresnel.hpp"

namespace scenec::backend {
namespace {

constexpr std::uint32_t seed = 20261123;

Caster ball(BsdfKind kind) {
  Caster c;
  c.center = {1, 2, 3};
  c.radius = 0.5;
  c.bsdf.kind = kind;
  c.bsdf.specular = {0.9, 0.8, 0.7};
  c.ior = kind == BsdfKind::glass ? 1.5 : 1;
  return c;
}

Point3 point_round(const Caster& c, std::mt19937& random) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> distance(1.01, 6);
  const UnitVector3 w = normalized(Vector3{normal(random), normal(random), normal(random)});
  return c.center + w.vector() * (c.radius * distance(random));
}

TEST(Casters, RoutesObeyTheLawsOfMirrorsAndGlass) {
  std::mt19937 random(seed);
  int found[2] = {0, 0};
  for (int i = 0; i < 4000; ++i) {
    const CasterWay way = i % 2 == 0 ? CasterWay::mirrored : CasterWay::through;
    const Caster c = ball(way == CasterWay::mirrored ? BsdfKind::mirror : BsdfKind::glass);
    const Point3 from = point_round(c, random);
    const Point3 to = point_round(c, random);
    const auto start = place_of(c, from);
    const auto end = place_of(c, to);
    ASSERT_TRUE(start && end);
    const CasterRoutes routes = routes_by(c, way, from, *start, to, *end);
    for (int k = 0; k < routes.count; ++k) {
      const CasterRoute& r = routes.routes[static_cast<std::size_t>(k)];
      ++found[i % 2];
      // The outside of the sphere is met, from outside.
      EXPECT_NEAR(distance(r.entry, c.center), c.radius, 1e-14);
      const double cos_in = -dot(r.wi, r.entry_normal);
      ASSERT_GT(cos_in, 0) << "seed " << seed << " case " << i;
      Vector3 leaving;
      if (way == CasterWay::mirrored) {
        leaving = reflected(-r.wi.vector(), r.entry_normal);
      } else {
        const DielectricFresnel in = fresnel_dielectric(cos_in, c.ior);
        const Vector3 inside = refracted(-r.wi.vector(), r.entry_normal, cos_in, c.ior, in.cos_t);
        EXPECT_LT(length(cross(normalized(r.exit - r.entry), inside)), 1e-9) << "case " << i;
        const DielectricFresnel out = fresnel_dielectric(in.cos_t, 1 / c.ior);
        leaving = refracted(-inside, -r.exit_normal.vector(), in.cos_t, 1 / c.ior, out.cos_t);
      }
      EXPECT_LT(length(cross(r.arrive, leaving)), 1e-8) << "case " << i;
      EXPECT_GT(dot(r.arrive, leaving), 0) << "case " << i;
      EXPECT_NEAR(std::fabs(r.impact), std::sqrt(1 - cos_in * cos_in), 1e-7) << "case " << i;
    }
  }
  EXPECT_GT(found[0], 500);
  EXPECT_GT(found[1], 300);
}

TEST(Casters, WhatIsCarriedIsWhatTheSurfacesLeave) {
  const Caster glass = ball(BsdfKind::glass);
  const double b = 0.6;
  const DielectricFresnel f = fresnel_dielectric(0.8, 1.5);
  const CasterShare through = share_of(glass, CasterWay::through, b, {1, 0, 0});
  EXPECT_NEAR(through.probability, (1 - f.reflectance) * (1 - f.reflectance), 1e-15);
  EXPECT_NEAR(through.carried.g, through.probability * 0.8 * 0.8, 1e-15);
  // The chord is 2 r cos t.
  EXPECT_NEAR(through.carried.r, through.probability * 0.9 * 0.9 * std::exp(-f.cos_t), 1e-14);
  const CasterShare off = share_of(glass, CasterWay::mirrored, b, {});
  EXPECT_EQ(off.carried.r, f.reflectance);
  EXPECT_EQ(off.probability, f.reflectance);
  const CasterShare mirror = share_of(ball(BsdfKind::mirror), CasterWay::mirrored, b, {});
  EXPECT_EQ(mirror.carried.g, 0.8);
  EXPECT_EQ(mirror.probability, 1);
}

Emitter lamp(double radiance) {
  Emitter e;
  e.shape = EmitterShape::parallelogram;
  e.a = {1, 0, 0};
  e.b = {0, 1, 0};
  e.radiance = {radiance, radiance, radiance};
  measure(e);
  return e;
}

TEST(Casters, LampsAreChosenByPowerAndVaryingOnesNever) {
  std::vector<Emitter> lamps{lamp(1), lamp(5), lamp(3), lamp(0)};
  lamps[1].textured = true;
  CasterTable table;
  table.finish({{7, ball(BsdfKind::mirror)}}, 9, lamps);
  ASSERT_FALSE(table.empty());
  EXPECT_EQ(table.of_item(7), 0u);
  EXPECT_EQ(table.of_item(8), CasterTable::none);
  EXPECT_EQ(table.of_item(100), CasterTable::none);
  EXPECT_EQ(table.probability(0), 0.25);
  EXPECT_EQ(table.probability(1), 0);
  EXPECT_EQ(table.choose_lamp(0).emitter, 0u);
  EXPECT_EQ(table.choose_lamp(0.25).emitter, 2u);
  EXPECT_EQ(table.choose_lamp(0x1.fffffffffffffp-1).emitter, 2u);
}

TEST(Casters, NothingIsAskedWithoutLampsAndOnlySoManySpheres) {
  CasterTable dark;
  dark.finish({{0, ball(BsdfKind::mirror)}}, 1, {lamp(0)});
  EXPECT_TRUE(dark.empty());
  std::vector<std::pair<std::uint32_t, Caster>> many;
  for (std::uint32_t i = 0; i < 100; ++i) {
    many.emplace_back(i, ball(BsdfKind::mirror));
    many.back().second.radius = 1 + i;
  }
  CasterTable table;
  table.finish(std::move(many), 100, {lamp(1)});
  EXPECT_EQ(table.all().size(), CasterTable::most);
  EXPECT_EQ(table.of_item(99), 0u) << "the largest first";
  EXPECT_EQ(table.of_item(3), CasterTable::none);
}

TEST(Casters, PlacesWithinASphereSeeNothingByWayOfIt) {
  const Caster c = ball(BsdfKind::mirror);
  EXPECT_FALSE(place_of(c, {1, 2, 3}));
  EXPECT_FALSE(place_of(c, {1.5, 2, 3}));
  EXPECT_FALSE(place_of(c, {1e200, 0, 0})) << "too far to matter";
  EXPECT_TRUE(place_of(c, {1.6, 2, 3}));
}

}  // namespace
}  // namespace scenec::backend
