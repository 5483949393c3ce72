#include "backend/image/flip.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

namespace scenec::backend {
namespace {

FloatImage picture(std::uint32_t side,
                   const std::function<float(std::uint32_t, std::uint32_t)>& f) {
  FloatImage image{side, side, 3, {}};
  for (std::uint32_t y = 0; y < side; ++y) {
    for (std::uint32_t x = 0; x < side; ++x) image.samples.insert(image.samples.end(), 3, f(x, y));
  }
  return image;
}
FloatImage even(std::uint32_t side, float value) {
  return picture(side, [=](auto, auto) { return value; });
}
FloatImage edge_at(std::uint32_t side, std::uint32_t column) {
  return picture(side, [=](std::uint32_t x, auto) { return x < column ? 0.1F : 0.7F; });
}
double mean(const std::vector<float>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

TEST(flip, of_a_picture_and_itself_is_0) {
  const FloatImage image = edge_at(40, 20);
  for (const float value : flip_of(image, image)) EXPECT_EQ(value, 0);
}

TEST(flip, of_black_and_white_is_nearly_1) {
  for (const float value : flip_of(even(24, 0), even(24, 1))) {
    EXPECT_GT(value, 0.9F);
    EXPECT_LE(value, 1.0F);
  }
}

TEST(flip, stays_within_0_and_1_and_is_the_same_both_ways) {
  const FloatImage a = edge_at(40, 18);
  const FloatImage b = edge_at(40, 24);
  const std::vector<float> there = flip_of(a, b);
  const std::vector<float> back = flip_of(b, a);
  ASSERT_EQ(there.size(), 1600U);
  for (std::size_t i = 0; i < there.size(); ++i) {
    EXPECT_GE(there[i], 0);
    EXPECT_LE(there[i], 1);
    EXPECT_NEAR(there[i], back[i], 1e-5);
  }
}

TEST(flip, grows_with_the_difference) {
  const FloatImage grey = even(24, 0.5F);
  double before = 0;
  for (const float other : {0.505F, 0.52F, 0.6F, 0.8F}) {
    const double now = mean(flip_of(grey, even(24, other)));
    EXPECT_GT(now, before) << other;
    before = now;
  }
  const FloatImage edge = edge_at(60, 30);
  EXPECT_LT(mean(flip_of(edge, edge_at(60, 31))), mean(flip_of(edge, edge_at(60, 36))));
}

TEST(flip, marks_the_place_of_the_difference) {
  const FloatImage grey = even(61, 0.4F);
  FloatImage spot = grey;
  for (int channel = 0; channel < 3; ++channel)
    spot.samples[(30 * 61 + 30) * 3 + static_cast<std::size_t>(channel)] = 1;
  const std::vector<float> values = flip_of(spot, grey);
  EXPECT_EQ(std::max_element(values.begin(), values.end()) - values.begin(), 30 * 61 + 30);
  EXPECT_LT(values[0], 1e-4F);
}

TEST(flip, takes_one_pixel_and_what_is_no_number) {
  EXPECT_EQ(flip_of(even(1, 0.3F), even(1, 0.3F)), std::vector<float>{0});
  const float none = std::numeric_limits<float>::quiet_NaN();
  for (const float value : flip_of(even(5, none), even(5, 0))) EXPECT_EQ(value, 0);
}

}  // namespace
}  // namespace scenec::backend
