#include "backend/math/turn.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "backend/math/rng.hpp"
#include "backend/math/vec.hpp"

namespace scenec::backend {
namespace {

constexpr long double two_pi = 6.28318530717958647692528676655900577L;

TEST(Turn, SineAndCosineAreWithinTwoUlpOfOne) {
  for (std::uint64_t i = 0; i < 200000; ++i) {
    const double turns = (random_unit(5, i, 0, 0) - 0.5) * (i % 2 == 0 ? 2.0 : 1e5);
    const SinCos r = sin_cos_of_turns(turns);
    const long double whole = std::floor(static_cast<long double>(turns));
    const long double angle = (static_cast<long double>(turns) - whole) * two_pi;
    ASSERT_NEAR(r.sin, static_cast<double>(std::sin(angle)), 4 * unit_roundoff) << turns;
    ASSERT_NEAR(r.cos, static_cast<double>(std::cos(angle)), 4 * unit_roundoff) << turns;
    ASSERT_NEAR(r.sin * r.sin + r.cos * r.cos, 1, 4 * unit_roundoff) << turns;
  }
}

TEST(Turn, QuartersAreExact) {
  for (int quarter = -8; quarter <= 8; ++quarter) {
    const SinCos r = sin_cos_of_turns(quarter * 0.25);
    const int k = ((quarter % 4) + 4) % 4;
    EXPECT_EQ(std::fabs(r.cos), k % 2 == 0 ? 1 : 0) << quarter;
    EXPECT_EQ(r.cos, k == 0 ? 1 : k == 2 ? -1 : r.cos) << quarter;
    EXPECT_EQ(r.sin, k == 1 ? 1 : k == 3 ? -1 : r.sin) << quarter;
  }
}

}  // namespace
}  // namespace scenec::backend
