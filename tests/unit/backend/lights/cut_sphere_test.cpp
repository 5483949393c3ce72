// Spheres of which an opaque plane hides nearly all: the lamp of many a course scene is a huge ball
// that looks through the ceiling. Below it only the cap is aimed at.
#include <gtest/gtest.h>

#include <cmath>

#include "backend/accel/scene_accel.hpp"
#include "backend/lights/emitter.hpp"
#include "base/elementary.hpp"
#include "tests/unit/backend/scene_kit.hpp"

namespace scenec::backend {
namespace {

constexpr double ceiling = 100;

Emitter lamp() {
  Emitter e;
  e.shape = EmitterShape::sphere;
  e.origin = {50, 699.33, 81.6};
  e.radius = 600;
  e.radiance = {10, 10, 10};
  return e;
}
Emitter cut_lamp() {
  Emitter e = lamp();
  cut_by_plane(e, {0, -1, 0}, -ceiling);
  measure(e);
  return e;
}
Sample2 grid(int i, int n) {
  return {(i % n + 0.5) / n, (i / n + 0.5) / n};
}

TEST(cut_sphere, only_planes_that_leave_a_shallow_cap_cut) {
  EXPECT_EQ(cut_lamp().shape, EmitterShape::cut_sphere);
  for (const double offset : {0.0, 99.3, 699.33, 400.0, 1400.0}) {
    Emitter e = lamp();
    cut_by_plane(e, {0, 1, 0}, offset);
    EXPECT_EQ(e.shape, EmitterShape::sphere) << offset;
  }
}

TEST(cut_sphere, a_plane_of_either_sign_and_length_cuts_alike_and_the_smallest_cap_stays) {
  const Emitter one = cut_lamp();
  Emitter other = lamp();
  cut_by_plane(other, {0, 3, 0}, 3 * ceiling);
  measure(other);
  EXPECT_EQ(one.a, other.a);
  EXPECT_NEAR(one.b.x, 0.67, 1e-9);
  EXPECT_NEAR(one.area, other.area, 1e-9 * one.area);
  cut_by_plane(other, {0, 1, 0}, 150);  // a wall further back
  EXPECT_EQ(one.a, other.a);
  EXPECT_NEAR(other.b.x, 0.67, 1e-9);
}

TEST(cut_sphere, nothing_aimed_at_from_below_is_hidden_by_the_plane) {
  const Emitter cut = cut_lamp();
  SceneAccel world;
  world.add(0, Plane{{0, -1, 0}, -ceiling});
  world.add(1, Sphere{cut.origin, cut.radius});
  ThreadPool pool(1);
  world.build(pool);
  Hit floor;
  floor.geometric_normal = normalized(Vector3{0, 1, 0});
  int whole_blocked = 0;
  Emitter whole = lamp();
  measure(whole);
  for (const Point3 from : {Point3{50, 0, 81}, Point3{1, 40, 250}, Point3{75, 99, 60}}) {
    floor.point = from;
    for (int i = 0; i < 400; ++i) {
      const auto s = sample_emitter(cut, from, grid(i, 20));
      ASSERT_TRUE(s);
      EXPECT_NEAR(pdf_emitter(cut, from, s->point, s->normal), s->pdf, 1e-9 * s->pdf);
      if (dot(s->wi, s->normal) >= 0) continue;  // beyond the horizon of the cap
      EXPECT_FALSE(
          world.occluded(spawn_segment(surface_point(floor), {s->point, s->error, s->normal})));
      const auto by_cone = sample_emitter(whole, from, grid(i, 20));
      ASSERT_TRUE(by_cone);
      whole_blocked += world.occluded(
          spawn_segment(surface_point(floor), {by_cone->point, by_cone->error, by_cone->normal}));
    }
  }
  EXPECT_GT(whole_blocked, 900) << "the cone is as good: the test shows nothing";
}

// From far enough below the whole cap is seen: the cone of its rim.
TEST(cut_sphere, sampled_solid_angle_is_that_of_the_rim) {
  const Emitter e = cut_lamp();
  const Point3 from{50, 60, 81.6};
  const double rim = std::sqrt(0.67 * (1200 - 0.67));
  const double expected = 2 * pi * (1 - 40 / std::hypot(40, rim));
  double sampled = 0;
  constexpr int n = 200;
  for (int i = 0; i < n * n; ++i) sampled += 1 / sample_emitter(e, from, grid(i, n))->pdf / (n * n);
  EXPECT_NEAR(sampled, expected, 2e-4 * expected);
}

TEST(cut_sphere, above_the_plane_and_on_it_the_whole_sphere_is_aimed_at) {
  const Emitter cut = cut_lamp();
  Emitter whole = lamp();
  measure(whole);
  for (const Point3 from : {Point3{800, 200, 0}, Point3{200, ceiling, 20}, Point3{50, 700, 80}}) {
    for (int i = 0; i < 25; ++i) {
      const auto a = sample_emitter(cut, from, grid(i, 5));
      const auto b = sample_emitter(whole, from, grid(i, 5));
      ASSERT_TRUE(a && b);
      EXPECT_EQ(a->pdf, b->pdf);
      EXPECT_EQ(a->point, b->point);
    }
  }
}

// Half the mean squared difference of two pictures with seeds of their own, which is their
// variance.
double variance_of_room(double ceiling_opacity) {
  test::SceneKit kit;
  const ir::MaterialId wall = kit.matt(0.7);
  ir::MaterialCommon common;
  common.opacity.value = ceiling_opacity;
  kit.place(ir::Plane{{0, 1, 0}, {0}}, wall);
  kit.place(ir::Plane{{0, -1, 0}, {-ceiling}},
            kit.material(ir::Diffuse{{{0.7, 0.7, 0.7}, {}}}, common));
  kit.place(ir::Sphere{{50, 699.33, 81.6}, {600}}, kit.glowing(10));
  kit.pinhole({50, 60, 250}, {50, 20, 80}, 50);
  kit.settings.samples = 64;
  test::Ready ready(kit.finish());
  const Picture one = ready.render();
  ready.scene.render.seed = 1;
  const Picture other = ready.render();
  double sum = 0;
  for (std::size_t i = 0; i < one.rgb.size(); ++i) {
    const double d = static_cast<double>(one.rgb[i]) - static_cast<double>(other.rgb[i]);
    sum += d * d / 2;
  }
  return sum / static_cast<double>(one.rgb.size());
}

TEST(cut_sphere, a_room_lit_through_its_ceiling_has_a_fifth_of_the_variance) {
  // Where light could pass the ceiling, nothing of the ball may be left out.
  EXPECT_LT(variance_of_room(1), 0.2 * variance_of_room(0.999999));
}

}  // namespace
}  // namespace scenec::backend
