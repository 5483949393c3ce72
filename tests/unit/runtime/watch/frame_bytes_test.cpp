#include "runtime/watch/frame_bytes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace scenec::runtime {
namespace {

// IEEE 754 binary16 by its definition.
double value_of(std::uint16_t half) {
  const int exponent = half >> 10 & 31;
  const int fraction = half & 1023;
  const double size =
      exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(1024 + fraction, exponent - 25);
  return (half & 0x8000) != 0 ? -size : size;
}

TEST(frame_bytes, every_half_float_is_its_own_nearest) {
  for (std::uint32_t bits = 0; bits < 0x7c00; ++bits) {
    const auto half = static_cast<std::uint16_t>(bits);
    ASSERT_EQ(half_of(static_cast<float>(value_of(half))), half);
  }
}

TEST(frame_bytes, between_two_half_floats_the_nearer_one_is_taken_and_of_equals_the_even_one) {
  for (std::uint32_t bits = 0; bits + 1 < 0x7c00; ++bits) {
    const double low = value_of(static_cast<std::uint16_t>(bits));
    const double high = value_of(static_cast<std::uint16_t>(bits + 1));
    const auto middle = static_cast<float>((low + high) / 2);
    ASSERT_EQ(half_of(middle), bits + (bits & 1)) << bits;
    ASSERT_EQ(half_of(std::nextafter(middle, 0.0F)), bits);
    ASSERT_EQ(half_of(std::nextafter(middle, 1e6F)), bits + 1);
  }
}

TEST(frame_bytes, what_is_too_large_or_no_number_stays_finite) {
  EXPECT_EQ(half_of(1e9F), 0x7bff);
  EXPECT_EQ(half_of(std::numeric_limits<float>::infinity()), 0x7bff);
  EXPECT_EQ(half_of(std::numeric_limits<float>::quiet_NaN()), 0x7bff);
  EXPECT_EQ(half_of(-1e9F), 0xfbff);
}

TEST(frame_bytes, the_head_names_what_the_pixels_are) {
  backend::Picture picture;
  picture.width = 2;
  picture.height = 1;
  picture.samples = 7;
  picture.rgb = {1, 0, 0.5F, 2, 4, 8};
  const std::string bytes =
      frame_bytes(picture, {.generation = 3, .size = {8, 4}, .region = {2, 1, 6, 3}, .step = 2});
  ASSERT_EQ(bytes.size(), 48U + 12U);
  EXPECT_EQ(bytes.substr(0, 4), "SCF1");
  const std::array<int, 11> words{3, 8, 4, 2, 2, 1, 6, 3, 2, 1, 7};
  for (std::size_t i = 0; i < words.size(); ++i) EXPECT_EQ(bytes[4 + 4 * i], words[i]) << i;
  EXPECT_EQ(bytes.substr(48, 4), std::string("\x00\x3c\x00\x00", 4));
}

}  // namespace
}  // namespace scenec::runtime
