#include "backend/image/tone.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace scenec::backend {
namespace {

double reference_decoded(long double encoded) {
  return static_cast<double>(encoded <= 0.04045L ? encoded / 12.92L
                                                 : powl((encoded + 0.055L) / 1.055L, 2.4L));
}

TEST(Tone, DecodesEveryByteAsPowlDoes) {
  for (int i = 0; i < 256; ++i) {
    const double expected = reference_decoded(static_cast<long double>(i) / 255);
    EXPECT_EQ(linear_of_srgb8(static_cast<std::uint8_t>(i)), expected) << i;
    EXPECT_EQ(linear_of_srgb(i / 255.0), reference_decoded(i / 255.0)) << i;
  }
}

TEST(Tone, ChangesTheByteExactlyAtTheThresholds) {
  for (int i = 0; i < 255; ++i) {
    const double threshold = reference_decoded((2 * static_cast<long double>(i) + 1) / 510);
    EXPECT_EQ(srgb8_of(threshold), i + 1);
    EXPECT_EQ(srgb8_of(std::nextafter(threshold, 0)), i);
  }
}

TEST(Tone, AgreesWithTheEncodingFormula) {
  for (int i = 0; i <= 100'000; ++i) {
    const long double linear = static_cast<long double>(i) / 100'000;
    const long double encoded =
        linear <= 0.0031308L ? 12.92L * linear : 1.055L * powl(linear, 1 / 2.4L) - 0.055L;
    const int expected = static_cast<int>(std::floor(encoded * 255 + 0.5L));
    EXPECT_EQ(srgb8_of(static_cast<double>(linear)), expected) << i;
  }
}

TEST(Tone, GivesBackEveryByte) {
  for (int i = 0; i < 256; ++i)
    EXPECT_EQ(srgb8_of(linear_of_srgb8(static_cast<std::uint8_t>(i))), i);
}

TEST(Tone, PutsWhatIsOutOfRangeAtTheEnds) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(srgb8_of(nan), 0);
  EXPECT_EQ(srgb8_of(-nan), 0);
  EXPECT_EQ(srgb8_of(-infinity), 0);
  EXPECT_EQ(srgb8_of(-0.0), 0);
  EXPECT_EQ(srgb8_of(infinity), 255);
  EXPECT_EQ(srgb8_of(2), 255);
  EXPECT_EQ(course8_of(std::numeric_limits<float>::quiet_NaN()), 0);
  EXPECT_EQ(course8_of(-1.0f), 0);
  EXPECT_EQ(course8_of(1e30f), 255);
  EXPECT_EQ(linear_of_srgb(nan), 0);
  EXPECT_EQ(linear_of_srgb(1.5), 1);
}

TEST(Tone, TruncatesCourseBytesInSinglePrecision) {
  for (int i = 0; i <= 100'000; ++i) {
    const float value = static_cast<float>(i) / 100'000.0f;
    EXPECT_EQ(course8_of(value), static_cast<int>(value * 255.0f));
  }
  EXPECT_EQ(course8_of(0.999f), 254);
}

}  // namespace
}  // namespace scenec::backend
