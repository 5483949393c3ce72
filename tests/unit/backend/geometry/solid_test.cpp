// Boxes and cylinders: faces, edges, parallel rays, rims that do not leak.
#include <gtest/gtest.h>

#include <cmath>

#include "backend/geometry/box.hpp"
#include "backend/geometry/cylinder.hpp"
#include "tests/unit/backend/geometry/random_rays.hpp"

namespace scenec::backend {
namespace {

using testing_support::Draw;

TEST(Box, FacesAreHitExactly) {
  const Box box{{-1, 0.1, 2}, {3, 0.7, 5}};
  Draw draw(1);
  for (int i = 0; i < 20000; ++i) {
    const Ray ray{draw.point(20), draw.direction()};
    ShapeHit hit;
    if (!intersect(box, ray, hit)) continue;
    const Surface s = surface(box, ray, hit);
    const int axis = static_cast<int>(hit.part / 2);
    EXPECT_EQ(component(s.point, axis),
              hit.part % 2 == 1 ? component(box.max, axis) : component(box.min, axis));
    EXPECT_LE(distance(s.point, ray.at(hit.t)), 1e-13);
    EXPECT_EQ(dot(as_vector(s.geometric_normal), ray.direction) < 0,
              !bounds(box).contains(ray.origin));
    EXPECT_GT(dot(cross(s.dp_du, s.dp_dv), as_vector(s.geometric_normal)), 0);
    EXPECT_TRUE(s.u >= 0 && s.u <= 1 && s.v >= 0 && s.v <= 1);
  }
}

TEST(Box, InsideParallelAndFlat) {
  const Box box{{0, 0, 0}, {1, 1, 1}};
  ShapeHit hit;
  ASSERT_TRUE(intersect(box, Ray{{0.5, 0.5, 0.5}, {1, 0, -0.0}}, hit));
  EXPECT_EQ(hit.t, 0.5);
  EXPECT_EQ(hit.part, 1U);
  EXPECT_TRUE(intersect(box, Ray{{0.5, 1, -1}, {0, 0, 1}}, hit));  // along a face
  EXPECT_TRUE(intersect(box, Ray{{1, 1, -1}, {0, 0, 1}}, hit));    // along an edge
  EXPECT_FALSE(intersect(box, Ray{{1, next_up(1), -1}, {0, 0, 1}}, hit));
  const Box flat{{0, 0, 0}, {1, 1, 0}};
  ASSERT_TRUE(intersect(flat, Ray{{0.5, 0.5, -2}, {0, 0, 1}}, hit));
  EXPECT_EQ(hit.t, 2);
  EXPECT_TRUE(intersect(flat, Ray{{-1, 0.5, 0}, {1, 0, 0}}, hit));
}

TEST(Cylinder, AgreesWithClosedForm) {
  const Cylinder cylinder({0, -1, 0}, {0, 2, 0}, 0.5, true);
  Draw draw(2);
  int hits = 0;
  for (int i = 0; i < 50000; ++i) {
    const Point3 origin = draw.point(6);
    const Ray ray{origin, draw.point(1) - origin};
    ShapeHit hit;
    if (!intersect(cylinder, ray, hit)) continue;
    ++hits;
    const Surface s = surface(cylinder, ray, hit);
    EXPECT_LE(distance(s.point, ray.at(hit.t)), 1e-12);
    const double rho = std::sqrt(s.point.x * s.point.x + s.point.z * s.point.z);
    if (hit.part == 0) {
      EXPECT_NEAR(rho, 0.5, 1e-15);
    }
    if (hit.part == 1) {
      EXPECT_NEAR(s.point.y, -1, 1e-15);
    }
    if (hit.part == 2) {
      EXPECT_NEAR(s.point.y, 2, 1e-15);
    }
    EXPECT_LE(rho, 0.5 + 1e-15);
    EXPECT_GT(dot(cross(s.dp_du, s.dp_dv), as_vector(s.geometric_normal)), 0);
  }
  EXPECT_GT(hits, 10000);
}

TEST(Cylinder, RimsDoNotLeak) {
  const Cylinder cylinder({1, 2, 3}, {2, 4, 7}, 0.75, true);
  Draw draw(3);
  for (int i = 0; i < 50000; ++i) {
    const double angle = draw.between(0, 2 * pi);
    const Vector3 rim =
        0.75 * (cos(angle) * cylinder.frame.x.vector() + sin(angle) * cylinder.frame.y.vector());
    const Point3 center =
        i % 2 == 0 ? cylinder.base : cylinder.base + cylinder.height * cylinder.frame.z.vector();
    // From inside towards the rim: something must stop the ray.
    const Point3 inside =
        cylinder.base + draw.between(0.2, 0.8) * cylinder.height * cylinder.frame.z.vector();
    ShapeHit hit;
    ASSERT_TRUE(intersect(cylinder, Ray{inside, (center + rim) - inside}, hit)) << i;
  }
}

TEST(Cylinder, AxisRaysAndOpenEnds) {
  const Cylinder open({0, 0, 0}, {0, 0, 2}, 1, false);
  const Cylinder capped({0, 0, 0}, {0, 0, 2}, 1, true);
  ShapeHit hit;
  EXPECT_FALSE(intersect(open, Ray{{0, 0, -1}, {0, 0, 1}}, hit));
  ASSERT_TRUE(intersect(capped, Ray{{0, 0, -1}, {0, 0, 1}}, hit));
  EXPECT_EQ(hit.t, 1);
  EXPECT_EQ(hit.part, 1U);
  ASSERT_TRUE(intersect(capped, Ray{{0.5, 0, 1}, {0, 0, 1}}, hit));
  EXPECT_EQ(hit.part, 2U);
  ASSERT_TRUE(intersect(open, Ray{{-3, 0, 1}, {1, 0, 0}}, hit));
  EXPECT_EQ(hit.t, 2);
  ASSERT_TRUE(intersect(open, Ray{{-3, 0, -2.5}, {1, 0, 1}}, hit));  // in through the open end
  EXPECT_NEAR(hit.t, 4, 1e-14);
}

}  // namespace
}  // namespace scenec::backend
