#include "backend/cameras/camera.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/elementary.hpp"
#include "backend/geometry/plane.hpp"

namespace scenec::backend {
namespace {

template <class C>
C placed(C camera) {
  camera.eye = {1, 2, 3};
  camera.direction = ir::Direction{0, 0, -2};
  return camera;
}

ir::Pinhole pinhole(double fov_degrees) {
  ir::Pinhole camera;
  camera.fov = Angle{fov_degrees * pi / 180};
  return placed(camera);
}

void expect_near(const Vector3& a, const Vector3& b, double tolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

TEST(camera, corner_ray_of_a_pinhole_has_the_closed_form) {  // C01
  for (const double fov : {0.001, 90.0, 179.9}) {
    const CameraSampler camera({pinhole(fov)}, {200, 100});
    const double t = std::tan(fov * pi / 360);
    const Vector3 d{2 * t, t, -1};
    expect_near(camera.ray(200, 0, {}).direction, d / length(d), 1e-12);
  }
}

TEST(camera, a_wall_in_which_the_camera_stands_hides_nothing) {
  ir::ThinLens lens;
  lens.fov = Angle{0.6};
  lens.aperture = Length{2};
  lens.focus.distance = Length{250};
  lens.eye = {50, 50, 300};
  lens.direction = ir::Direction{0, 0, -1};
  const CameraSampler camera({lens}, {72, 72});
  const Plane wall{Normal3{0, 0, -1}, -300};
  for (int i = 0; i < 72; ++i) {
    const Ray ray = camera.ray(i, 71 - i, {(i + 0.5) / 72, 0.3});
    ShapeHit hit;
    EXPECT_FALSE(intersect(wall, ray, hit)) << i;
    EXPECT_LT(ray.t_min, 1e-12);
  }
}

TEST(camera, pixels_are_square_and_the_middle_looks_along_the_axis) {  // C02, C03
  const CameraSampler camera({pinhole(60)}, {200, 100});
  expect_near(camera.ray(100, 50, {}).direction, {0, 0, -1}, 1e-15);
  const Vector3 across = camera.ray(101, 50, {}).direction;
  const Vector3 down = camera.ray(100, 51, {}).direction;
  EXPECT_NEAR(across.x, -down.y, 1e-15);
  const CameraSampler single({pinhole(60)}, {1, 1});
  expect_near(single.ray(0.5, 0.5, {}).direction, {0, 0, -1}, 1e-15);
}

TEST(camera, focal_length_and_angle_say_the_same) {
  ir::Pinhole by_focal;
  by_focal.focal = Length{0.012};
  const CameraSampler a({placed(by_focal)}, {64, 64});
  const CameraSampler b({pinhole(90)}, {64, 64});
  expect_near(a.ray(3, 60, {}).direction, b.ray(3, 60, {}).direction, 1e-14);
}

ir::ThinLens lens(double aperture, double focus) {
  ir::ThinLens camera;
  camera.fov = Angle{pi / 3};
  camera.aperture = Length{aperture};
  camera.focus.distance = Length{focus};
  return placed(camera);
}

TEST(camera, closed_aperture_is_a_pinhole) {  // C05
  const CameraSampler a({lens(0, 4)}, {64, 48});
  const CameraSampler b({pinhole(60)}, {64, 48});
  EXPECT_FALSE(a.has_lens());
  for (const double x : {0.0, 13.5, 64.0})
    EXPECT_EQ(a.ray(x, 7, {}).direction, b.ray(x, 7, {}).direction);
}

TEST(camera, rays_through_the_lens_meet_in_the_focal_plane) {
  for (const std::int64_t blades : {0, 6}) {
    ir::ThinLens thin = lens(0.25, 4);
    thin.blades = blades;
    const CameraSampler camera({thin}, {64, 48});
    const CameraSampler sharp({pinhole(60)}, {64, 48});
    const Ray middle = sharp.ray(10, 5, {});
    const Point3 expected = middle.at(4 / -middle.direction.z);
    double largest = 0;
    for (int i = 0; i < 400; ++i) {
      const Ray ray = camera.ray(10, 5, {(i % 20) / 20.0, (i / 20) / 20.0});
      const Point3 p = ray.at((-1 - ray.origin.z) / ray.direction.z);
      EXPECT_NEAR(distance(p, expected), 0, 1e-12);
      largest = std::fmax(largest, distance(ray.origin, middle.origin));
    }
    EXPECT_LE(largest, 0.25 + 1e-12);
    EXPECT_GT(largest, 0.2);
  }
}

TEST(camera, f_stop_is_focal_length_over_twice_the_radius) {
  ir::ThinLens thin = lens(0, 4);
  thin.aperture.reset();
  thin.fov.reset();
  thin.focal = Length{0.05};
  thin.f_stop = 2;
  const CameraSampler camera({thin}, {64, 48});
  EXPECT_NEAR(distance(camera.ray(32, 24, {0.999999999, 0.5}).origin, {1, 2, 3}), 0.0125, 1e-9);
}

TEST(camera, orthographic_rays_are_parallel_and_spaced_by_the_height) {
  ir::Orthographic flat;
  flat.height = Length{10};
  const CameraSampler camera({placed(flat)}, {40, 20});
  const Ray top = camera.ray(20, 0, {});
  const Ray left = camera.ray(0, 10, {});
  expect_near(top.direction, {0, 0, -1}, 0);
  EXPECT_NEAR(top.origin.y, 2 + 5, 1e-12);
  EXPECT_NEAR(left.origin.x, 1 - 10, 1e-12);
}

TEST(camera, panorama_shows_all_directions) {
  const CameraSampler camera({placed(ir::Panorama{})}, {360, 180});
  expect_near(camera.ray(180, 90, {}).direction, {0, 0, -1}, 1e-14);
  expect_near(camera.ray(270, 90, {}).direction, {1, 0, 0}, 1e-14);
  expect_near(camera.ray(0, 90, {}).direction, {0, 0, 1}, 1e-14);
  expect_near(camera.ray(33, 0, {}).direction, {0, 1, 0}, 1e-14);
}

}  // namespace
}  // namespace scenec::backend
