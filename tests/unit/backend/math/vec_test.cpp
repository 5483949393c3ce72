// Lengths and directions at the ends of the range, and that the four types stay apart.
#include "backend/math/vec.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <concepts>
#include <limits>

namespace scenec::backend {
namespace {

template <class A, class B>
concept CanAdd = requires(A a, B b) { a + b; };

static_assert(CanAdd<Point3, Vector3> && CanAdd<Vector3, UnitVector3>);
static_assert(!CanAdd<Point3, Point3> && !CanAdd<Normal3, Vector3>);
static_assert(std::convertible_to<UnitVector3, Vector3> &&
              !std::convertible_to<Vector3, UnitVector3>);
static_assert(!std::convertible_to<Normal3, Vector3> && !std::convertible_to<Point3, Vector3>);

TEST(Vec, LengthNeitherOverflowsNorUnderflows) {
  EXPECT_EQ(length({3, 4, 0}), 5);
  EXPECT_EQ(length({3e300, 4e300, 0}), 5e300);
  EXPECT_EQ(length({0, 0x3p-1060, 0x4p-1060}), 0x5p-1060);
  EXPECT_EQ(length({0, 0, 0}), 0);
  EXPECT_TRUE(std::isinf(length({std::numeric_limits<double>::infinity(), 0, 0})));
}

TEST(Vec, DirectionOfAnything) {
  for (const double scale : {1e-320, 1e-300, 1e-20, 1.0, 1e20, 1e300}) {
    const UnitVector3 u = normalized(Vector3{1 * scale, 2 * scale, -2 * scale});
    EXPECT_NEAR(length(u), 1, 1e-3 * (scale < 1e-310 ? 1.0 : 1e-12));
  }
  const UnitVector3 fallback = UnitVector3::assume_unit({1, 0, 0});
  EXPECT_EQ(normalized(Vector3{0, 0, 0}, fallback), fallback);
  EXPECT_EQ(normalized(Vector3{std::nan(""), 0, 0}, fallback), fallback);
}

TEST(Vec, FiniteTest) {
  EXPECT_TRUE(is_finite(Vector3{1e308, -1e308, 0}));
  EXPECT_FALSE(is_finite(Vector3{0, std::numeric_limits<double>::infinity(), 0}));
  EXPECT_FALSE(is_finite(Vector3{0, 0, std::nan("")}));
}

}  // namespace
}  // namespace scenec::backend
