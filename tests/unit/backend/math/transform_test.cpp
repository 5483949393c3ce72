// Inverses, normals and bounds under affine maps, and the bound on the round trip (G23, G24).
#include "backend/math/transform.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "backend/math/rng.hpp"
#include "base/elementary.hpp"

namespace scenec::backend {
namespace {

double draw(std::uint64_t i, std::uint32_t d) {
  return 2 * random_unit(3, i, 0, d) - 1;
}

// A random matrix with rows scaled by 10^[-4, 4].
Transform random_transform(std::uint64_t i) {
  AffineRows rows{};
  std::uint32_t d = 0;
  for (auto& row : rows) {
    const double scale = pow(10.0, 4 * draw(i, d++));
    for (double& v : row) v = scale * draw(i, d++);
  }
  return Transform::from_rows(rows).value();
}

TEST(Transform, RoundTripIsWithinItsBound) {
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const Transform t = random_transform(i);
    const Point3 p{10 * draw(i, 20), 10 * draw(i, 21), 10 * draw(i, 22)};
    const Point3 back = t.apply_inverse(t.apply(p));
    // The difference, seen from target space.
    const Vector3 difference = t.apply_abs(back - p);
    const Vector3 bound = t.round_trip_error(p);
    EXPECT_LE(std::fabs(t.apply(back - p).x), bound.x) << i << " " << difference.x;
    EXPECT_LE(std::fabs(t.apply(back - p).y), bound.y) << i;
    EXPECT_LE(std::fabs(t.apply(back - p).z), bound.z) << i;
  }
}

TEST(Transform, InverseOfPowersOfTwoIsExact) {
  const Transform t =
      Transform::from_rows({{{0, 2, 0, 8}, {-0.5, 0, 0, 1}, {0, 0, 1024, -4}}}).value();
  const Point3 p{1.25, -3, 7};
  EXPECT_EQ(t.apply_inverse(t.apply(p)), p);
  EXPECT_EQ(t.determinant(), 1024);
  EXPECT_FALSE(t.flips());
  EXPECT_EQ(t.condition(), 1024 * 2);
}

TEST(Transform, SingularAndNonFiniteAreRefused) {
  EXPECT_FALSE(Transform::from_rows({{{1, 2, 3, 0}, {2, 4, 6, 0}, {0, 0, 1, 0}}}).has_value());
  EXPECT_FALSE(Transform::from_rows({{{1, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 1, 0}}}).has_value());
  EXPECT_FALSE(
      Transform::from_rows({{{std::nan(""), 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}}).has_value());
  EXPECT_TRUE(Transform::from_rows({{{1e-200, 0, 0, 0}, {0, 1e-200, 0, 0}, {0, 0, 1e-200, 0}}})
                  .has_value());
  EXPECT_FALSE(
      Transform::from_matrix({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 1, 1}).has_value());
}

TEST(Transform, NormalsStayOrthogonal) {
  for (std::uint64_t i = 0; i < 5000; ++i) {
    const Transform t = random_transform(i);
    const Vector3 a{draw(i, 30), draw(i, 31), draw(i, 32)};
    const Vector3 b{draw(i, 33), draw(i, 34), draw(i, 35)};
    const UnitVector3 n = normalized(t.apply(as_normal(cross(a, b))));
    const Vector3 edge = t.apply(a);
    EXPECT_LE(std::fabs(dot(n, edge)), 64 * unit_roundoff * t.condition() * length(edge)) << i;
  }
}

TEST(Transform, NestedRotationsComeBack) {
  const SinCos sc = sin_cos(2 * pi / 32);
  const Transform step =
      Transform::from_rows({{{sc.cos, 0, sc.sin, 0}, {0, 1, 0, 0}, {-sc.sin, 0, sc.cos, 0}}})
          .value();
  Transform all;
  for (int i = 0; i < 32; ++i) all = step * all;
  const Point3 p = all.apply(Point3{1, 2, 3});
  EXPECT_NEAR(p.x, 1, 64 * unit_roundoff * 4);
  EXPECT_NEAR(p.y, 2, 64 * unit_roundoff * 4);
  EXPECT_NEAR(p.z, 3, 64 * unit_roundoff * 4);
}

TEST(Transform, BoundsEncloseWhatTheyShould) {
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const Transform t = random_transform(i);
    const Bounds3 box = t.apply(Bounds3{{-1, -2, 0}, {1, 2, 3}});
    const Point3 p{draw(i, 40), 2 * draw(i, 41), 1.5 + 1.5 * draw(i, 42)};
    EXPECT_TRUE(box.contains(t.apply(p)));
  }
  EXPECT_TRUE(Transform::translation({1, 0, 0}).apply(Bounds3{}).empty());
}

}  // namespace
}  // namespace scenec::backend
