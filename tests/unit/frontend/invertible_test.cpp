#include "frontend/check/invertible.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace scenec::frontend {
namespace {

ir::Transform scaling(double x, double y, double z) {
  return {{x, 0, 0, 0, 0, y, 0, 0, 0, 0, z, 0, 0, 0, 0, 1}};
}

TEST(Invertible, condition_does_not_depend_on_the_size) {
  EXPECT_DOUBLE_EQ(condition_number(scaling(1, 1, 1)), 3);
  EXPECT_DOUBLE_EQ(condition_number(scaling(1e90, 1e90, 1e90)), 3);
  EXPECT_DOUBLE_EQ(condition_number(scaling(1e-90, 1e-90, 1e-90)), 3);
  EXPECT_LT(condition_number(scaling(1, 1e-11, 1)), max_condition);
  EXPECT_GT(condition_number(scaling(1, 1e-13, 1)), max_condition);
}

TEST(Invertible, singular_transforms_are_infinitely_bad) {
  EXPECT_TRUE(std::isinf(condition_number(scaling(1, 0, 1))));
  EXPECT_TRUE(std::isinf(condition_number({{1, 2, 3, 0, 2, 4, 6, 0, 0, 0, 1, 0, 0, 0, 0, 1}})));
  // The determinant underflows: what relies on it would divide by zero.
  EXPECT_TRUE(std::isinf(condition_number(scaling(1e-120, 1e-120, 1e-120))));
}

TEST(Invertible, uniform_scale_of_rotations_mirrorings_and_shears) {
  const double c = std::cos(1.0), s = std::sin(1.0);
  const ir::Transform turned{{2 * c, 0, 2 * s, 5, 0, 2, 0, 6, -2 * s, 0, 2 * c, 7, 0, 0, 0, 1}};
  ASSERT_TRUE(uniform_scale(turned));
  EXPECT_NEAR(*uniform_scale(turned), 2, 1e-15);
  EXPECT_TRUE(uniform_scale(scaling(-3, 3, 3)));
  EXPECT_FALSE(uniform_scale(scaling(1, 1.001, 1)));
  EXPECT_FALSE(uniform_scale({{1, 0.1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}));
}

}  // namespace
}  // namespace scenec::frontend
