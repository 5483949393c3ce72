// Coordinates on a sphere; its hits are the matter of tests/numerics (G01 - G09, G25).
#include "backend/geometry/sphere.hpp"

#include <gtest/gtest.h>

namespace scenec::backend {
namespace {

TEST(Sphere, SurfaceCoordinates) {
  const Sphere sphere{{1, 2, 3}, 2};
  const auto at = [&](Vector3 d) {
    const Ray ray{sphere.center, d};
    ShapeHit hit;
    EXPECT_TRUE(intersect(sphere, ray, hit));
    return surface(sphere, ray, hit);
  };
  EXPECT_EQ(at({1, 0, 0}).u, 0);
  EXPECT_EQ(at({0, 0, -1}).u, 0.25);  // counter-clockwise seen from the tip of y
  EXPECT_EQ(at({-1, 0, 0}).u, 0.5);
  EXPECT_EQ(at({0, 0, 1}).u, 0.75);
  EXPECT_EQ(at({0, 1, 0}).v, 1);
  EXPECT_EQ(at({0, -1, 0}).v, 0);
  const Surface s = at({1, 1, 1});
  EXPECT_GT(dot(cross(s.dp_du, s.dp_dv), as_vector(s.geometric_normal)), 0);
  for (const Vector3& pole : {Vector3{0, 1, 0}, Vector3{0, -1, 0}})
    EXPECT_TRUE(is_finite(at(pole).dp_dv));
}

}  // namespace
}  // namespace scenec::backend
