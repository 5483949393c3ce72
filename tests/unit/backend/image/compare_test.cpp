#include "backend/image/compare.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "backend/image/tone.hpp"

namespace scenec::backend {
namespace {

TEST(Compare, MeasuresFloatImages) {
  const FloatImage reference{2, 1, 3, {1, 1, 1, 1, 1, 1}};
  FloatImage image = reference;
  EXPECT_EQ(difference_of(image, reference).differing, 0u);
  EXPECT_EQ(difference_of(image, reference).rel_mse, 0);
  image.samples[4] = 1.5f;
  const ImageDifference difference = difference_of(image, reference);
  EXPECT_EQ(difference.differing, 1u);
  EXPECT_EQ(difference.largest, 0.5);
  EXPECT_DOUBLE_EQ(difference.rmse, std::sqrt(0.25 / 6));
  EXPECT_DOUBLE_EQ(difference.rel_mse, 0.25 / 1.01 / 6);
}

TEST(Compare, TellsNotFiniteFromEqual) {
  const FloatImage reference{1, 1, 1, {1}};
  const ImageDifference difference = difference_of({1, 1, 1, {NAN}}, reference);
  EXPECT_EQ(difference.differing, 1u);
  EXPECT_TRUE(std::isinf(difference.largest));
}

TEST(Compare, MeasuresBytes) {
  const std::uint8_t a[] = {0, 10, 255};
  const std::uint8_t b[] = {0, 12, 0};
  EXPECT_EQ(difference_of(a, b).differing, 2u);
  EXPECT_EQ(difference_of(a, b).largest, 255);
}

TEST(Image, BecomesLinearWithoutTouchingAlpha) {
  DecodedImage image{1, 1, 4, SampleEncoding::srgb, std::vector<std::uint8_t>{128, 0, 255, 128}};
  const FloatImage linear = linear_image_of(image);
  EXPECT_EQ(linear.samples[0], static_cast<float>(linear_of_srgb8(128)));
  EXPECT_EQ(linear.samples[2], 1.0f);
  EXPECT_EQ(linear.samples[3], static_cast<float>(128 / 255.0));
  image.encoding = SampleEncoding::linear;
  EXPECT_EQ(linear_image_of(image).samples[0], static_cast<float>(128 / 255.0));
  const DecodedImage wide{1, 1, 1, SampleEncoding::srgb, std::vector<std::uint16_t>{0x8080}};
  EXPECT_EQ(linear_image_of(wide).samples[0], static_cast<float>(linear_of_srgb8(128)));
}

}  // namespace
}  // namespace scenec::backend
