#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "backend/accel/scene_accel.hpp"
#include "backend/lights/light_table.hpp"
#include "backend/math/rng.hpp"
#include "base/elementary.hpp"

namespace scenec::backend {
namespace {

Emitter emitter(EmitterShape shape) {
  Emitter e;
  e.shape = shape;
  e.origin = {0.2, 2, -0.1};
  e.a = {0.5, 0.1, 0};
  e.b = {-0.1, 0.2, 0.4};
  e.c = {0.05, 0.6, -0.1};
  e.radius = 0.3;
  e.radiance = {1, 1, 1};
  measure(e);
  return e;
}

class Emitters : public testing::TestWithParam<EmitterShape> {};

TEST_P(Emitters, density_at_a_sample_is_that_of_the_sample) {
  const Emitter e = emitter(GetParam());
  const Point3 from{1, 0.5, 1};
  EXPECT_GT(e.area, 0);
  for (int i = 0; i < 400; ++i) {
    const auto s = sample_emitter(e, from, {(i % 20 + 0.5) / 20, (i / 20 + 0.5) / 20});
    ASSERT_TRUE(s);
    EXPECT_NEAR(pdf_emitter(e, from, s->point, s->normal), s->pdf, 1e-6 * s->pdf);
    EXPECT_NEAR(dot(normalized(s->point - from), s->wi), 1, 1e-12);
  }
}

// The solid angle of a triangle, van Oosterom and Strackee 1983.
double triangle_solid_angle(const Vector3& a, const Vector3& b, const Vector3& c) {
  const double la = length(a);
  const double lb = length(b);
  const double lc = length(c);
  return 2 * std::atan2(std::fabs(dot(a, cross(b, c))),
                        la * lb * lc + dot(a, b) * lc + dot(a, c) * lb + dot(b, c) * la);
}

TEST(emitter, sampled_solid_angles_equal_the_closed_forms) {
  const Point3 from{3, -2, 2};
  for (const EmitterShape shape :
       {EmitterShape::triangle, EmitterShape::parallelogram, EmitterShape::sphere}) {
    const Emitter e = emitter(shape);
    double sampled = 0;
    constexpr int n = 400;
    for (int i = 0; i < n * n; ++i) {
      const auto s = sample_emitter(e, from, {(i % n + 0.5) / n, (i / n + 0.5) / n});
      if (s) sampled += 1 / s->pdf / (n * n);
    }
    const Vector3 a = e.origin - from;
    double expected = triangle_solid_angle(a, a + e.a, a + e.b);
    if (shape == EmitterShape::parallelogram)
      expected += triangle_solid_angle(a + e.a + e.b, a + e.a, a + e.b);
    if (shape == EmitterShape::sphere)
      expected = 2 * pi * (1 - std::sqrt(1 - e.radius * e.radius / length_squared(a)));
    EXPECT_NEAR(sampled, expected, 1e-4 * expected);
  }
}

INSTANTIATE_TEST_SUITE_P(all, Emitters,
                         testing::Values(EmitterShape::triangle, EmitterShape::parallelogram,
                                         EmitterShape::ellipse, EmitterShape::sphere,
                                         EmitterShape::ellipsoid, EmitterShape::tube));

TEST(emitter, ellipsoid_that_is_a_sphere_has_its_density) {
  Emitter e = emitter(EmitterShape::ellipsoid);
  e.a = {0.3, 0, 0};
  e.b = {0, 0.3, 0};
  e.c = {0, 0, 0.3};
  measure(e);
  EXPECT_NEAR(e.area, 4 * pi * 0.09, 1e-12);
  const Point3 from{5, 5, 5};
  const auto s = sample_emitter(e, from, {0.3, 0.8});
  const double d2 = length_squared(s->point - from);
  EXPECT_NEAR(s->pdf, d2 / (e.area * std::fabs(dot(s->wi, s->normal))), 1e-9 * s->pdf);
}

TEST(emitter, far_spheres_light_by_the_closed_form) {  // P03
  for (const double ratio : {1.5, 10.0, 1e3, 5.8e3, 1e6, 1e9}) {
    Emitter e;
    e.shape = EmitterShape::sphere;
    e.radius = 1;
    e.origin = {0, 0, ratio};
    measure(e);
    double irradiance = 0;
    constexpr int n = 32;
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        const auto s = sample_emitter(e, {0, 0, 0}, {(i + 0.5) / n, (j + 0.5) / n});
        ASSERT_TRUE(s);
        irradiance += s->wi.z() / s->pdf / (n * n);
      }
    }
    const double expected = pi / (ratio * ratio);
    EXPECT_NEAR(irradiance, expected, 1e-9 * expected) << ratio;
  }
}

TEST(emitter, no_light_stands_in_its_own_way_however_far) {  // P07
  for (const double distance : {2.0, 1e2, 1e4, 1e6, 1e8}) {
    Emitter e;
    e.shape = EmitterShape::sphere;
    e.radius = 0.2;
    e.origin = {0, 3, 0};
    measure(e);
    SceneAccel world;
    world.add(0, Sphere{e.origin, e.radius});
    ThreadPool pool(1);
    world.build(pool);
    Hit floor;
    floor.geometric_normal = normalized(Vector3{0, 1, 0});
    int blocked = 0;
    constexpr int n = 100;
    for (int i = 0; i < n * n; ++i) {
      floor.point = {distance * (1 + i / 3e4), 0, distance * 0.3};
      const auto s = sample_emitter(e, floor.point, {(i % n + 0.5) / n, (i / n + 0.5) / n});
      ASSERT_TRUE(s);
      blocked +=
          world.occluded(spawn_segment(surface_point(floor), {s->point, s->error, s->normal})) ? 1
                                                                                               : 0;
    }
    EXPECT_EQ(blocked, 0) << distance;
  }
}

TEST(emitter, from_within_or_on_a_sphere_everything_is_finite) {  // P04, P05
  Emitter e;
  e.shape = EmitterShape::sphere;
  e.radius = 2;
  measure(e);
  for (int k = -4; k <= 4; ++k) {
    const Point3 from{0, 0, 2 * (1 + k * 0x1p-52)};
    const auto s = sample_emitter(e, from, {0.4, 0.6});
    if (s) {
      EXPECT_TRUE(std::isfinite(s->pdf) && s->pdf > 0);
    }
  }
  // A point in the middle sees light from everywhere: mean of cos / pdf over the sphere.
  double solid_angle = 0;
  constexpr int n = 64;
  for (int i = 0; i < n * n; ++i) {
    solid_angle +=
        1 / sample_emitter(e, {0, 0, 0}, {(i % n + 0.5) / n, (i / n + 0.5) / n})->pdf / (n * n);
  }
  EXPECT_NEAR(solid_angle, 4 * pi, 1e-9);
}

TEST(light_table, draws_in_proportion_to_power_and_never_the_dark) {  // P13, P08
  LightTable table;
  for (const double value : {1.0, 0.0, 3.0}) {
    DeltaLight l;
    l.value = Rgb::gray(value);
    table.deltas.push_back(l);
  }
  Emitter nothing = emitter(EmitterShape::triangle);
  nothing.b = nothing.a;
  measure(nothing);
  table.emitters.push_back(nothing);
  table.finish(1);
  double sums[4] = {};
  constexpr int n = 4000;
  for (int i = 0; i < n; ++i) {
    const LightTable::Choice c = table.choose((i + 0.5) / n, {});
    ASSERT_GT(c.probability, 0);
    sums[c.light] += 1.0 / n;
  }
  EXPECT_NEAR(sums[0], 0.25, 1e-3);
  EXPECT_EQ(sums[1], 0);
  EXPECT_NEAR(sums[2], 0.75, 1e-3);
  EXPECT_EQ(sums[3], 0);
  EXPECT_EQ(LightTable().choose(0.5, {}).probability, 0);
}

TEST(light_table, point_light_at_the_point_itself_gives_nothing) {  // P09
  LightTable table;
  table.deltas.emplace_back();
  table.deltas[0].value = {1, 1, 1};
  table.finish(1);
  LightSample sample;
  EXPECT_FALSE(table.sample(0, {0, 0, 0}, {}, sample));
  EXPECT_TRUE(table.sample(0, {1e-8, 0, 0}, {}, sample));
  EXPECT_TRUE(std::isfinite(sample.radiance.r));
}

TEST(light_table, spot_fades_within_its_soft_edge) {
  ir::SpotLight spot;
  spot.direction = {0, -3, 0};
  spot.angle = Angle{pi / 2};
  spot.falloff = Angle{pi / 8};
  spot.intensity = 2;
  const auto light = delta_light_of(spot);
  ASSERT_TRUE(light);
  EXPECT_EQ(spot_share(*light, {0, -1, 0}), 1);
  EXPECT_EQ(spot_share(*light, {std::sin(pi / 8 - 0.01), -std::cos(pi / 8 - 0.01), 0}), 1);
  const double between = spot_share(*light, {std::sin(0.6), -std::cos(0.6), 0});
  EXPECT_TRUE(between > 0 && between < 1);
  EXPECT_EQ(spot_share(*light, {1, 0, 0}), 0);
}

std::shared_ptr<const DecodedImage> sky_image() {
  DecodedImage image;
  image.width = 32;
  image.height = 16;
  image.channels = 3;
  image.encoding = SampleEncoding::linear;
  std::vector<float> samples;
  for (std::uint64_t i = 0; i < 32 * 16; ++i) {
    const bool sun = i == 5 * 32 + 9;
    for (int c = 0; c < 3; ++c)
      samples.push_back(sun ? 500.0F : static_cast<float>(random_unit(4, i, 0, 0)));
  }
  image.samples = std::move(samples);
  return std::make_shared<DecodedImage>(std::move(image));
}

TEST(environment, density_integrates_to_one_and_belongs_to_the_samples) {
  ir::EnvironmentLight light;
  light.rotation = Angle{0.7};
  const Environment sky(light, sky_image());
  double total = 0;
  Rgb by_grid;
  constexpr int n = 1200;
  for (int i = 0; i < n; ++i) {
    const double z = 2 * (i + 0.5) / n - 1;
    for (int j = 0; j < n; ++j) {
      const double phi = 2 * pi * (j + 0.5) / n;
      const Vector3 d{std::sqrt(1 - z * z) * std::cos(phi), z,
                      std::sqrt(1 - z * z) * std::sin(phi)};
      total += sky.pdf(d) * 4 * pi / (n * n);
      by_grid += sky.radiance(d) * (4 * pi / (n * n));
    }
  }
  EXPECT_NEAR(total, 1, 5e-3);
  Rgb by_samples;
  constexpr int k = 500;
  for (int i = 0; i < k * k; ++i) {
    const Environment::Choice c = sky.sample({(i % k + 0.5) / k, (i / k + 0.5) / k});
    ASSERT_GT(c.pdf, 0);
    EXPECT_NEAR(sky.pdf(c.wi), c.pdf, 1e-6 * c.pdf);
    by_samples += sky.radiance(c.wi) * (1 / c.pdf / (k * k));
  }
  EXPECT_NEAR(by_samples.r, by_grid.r, 0.01 * by_grid.r);
}

TEST(environment, middle_is_minus_z_right_is_plus_x_top_is_plus_y) {
  DecodedImage image;
  image.width = 4;
  image.height = 2;
  image.channels = 1;
  image.encoding = SampleEncoding::linear;
  // Top row, then bottom; columns from behind-left over the middle to behind-right.
  image.samples = std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8};
  const Environment sky(ir::EnvironmentLight{}, std::make_shared<DecodedImage>(image));
  const auto seen = [&](double azimuth, double up) {
    return sky.radiance(normalized(Vector3{std::sin(azimuth), up, -std::cos(azimuth)}).vector()).r;
  };
  EXPECT_NEAR(seen(pi / 4, 1), 3, 1e-9);
  EXPECT_NEAR(seen(-pi / 4, 1), 2, 1e-9);
  EXPECT_NEAR(seen(3 * pi / 4, -1), 8, 1e-9);
}

}  // namespace
}  // namespace scenec::backend
