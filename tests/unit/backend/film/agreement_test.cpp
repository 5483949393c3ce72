#include "backend/film/agreement.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "backend/film/mirrored_tests.hpp"
#include "backend/film/replicates.hpp"

namespace scenec::backend {
namespace {

// A picture whose pixels are means of four replicates of noise round `truth`; `tail`: the chance of
// a sample that is a hundred times as bright, whose part of the mean the others lack.
NoisyPicture noisy(std::mt19937& random, double truth, double samples, double tail = 0) {
  NoisyPicture p;
  p.width = 32;
  p.height = 24;
  p.samples = samples;
  const double each = samples / replicate_count;
  std::normal_distribution<double> noise(truth, truth / std::sqrt(each));
  std::poisson_distribution<int> rare(each * tail);
  for (std::size_t i = 0; i < 3 * p.width * p.height; ++i) {
    ReplicateMeans means{};
    double sum = 0;
    for (auto& mean : means) {
      mean[0] = noise(random) + (tail > 0 ? 100 * truth * rare(random) / each : 0);
      sum += mean[0];
    }
    p.rgb.push_back(static_cast<float>(sum / replicate_count));
    p.variance.push_back(static_cast<float>(variance_of_mean(means, 0)));
  }
  return p;
}

double least_p(const NoisyPicture& a, const NoisyPicture& b) {
  double least = 0;
  for (const std::size_t side : {4u, 8u, 16u, 64u})
    least = std::min(least, compare_blocks(a, b, side).log_p);
  return least;
}

TEST(Agreement, OfHonestPicturesIsNotDoubted) {
  std::mt19937 random(5);  // seed: 5
  int doubted = 0;
  for (int i = 0; i < 60; ++i) {
    const double tail = i % 3 == 0 ? 0 : i % 3 == 1 ? 1e-3 : 1e-5;
    const NoisyPicture a = noisy(random, 1, 64, tail);
    const NoisyPicture b = noisy(random, 1, i % 2 == 0 ? 64 : 16, tail);
    doubted += least_p(a, b) < std::log(1e-3) ? 1 : 0;
  }
  EXPECT_EQ(doubted, 0);
}

TEST(Agreement, FindsAPlaceAndItsSize) {
  std::mt19937 random(6);  // seed: 6
  NoisyPicture a = noisy(random, 1, 64);
  const NoisyPicture b = noisy(random, 1, 16);
  for (std::size_t y = 8; y < 12; ++y)
    for (std::size_t x = 16; x < 20; ++x) a.rgb[3 * (y * a.width + x) + 1] += 6.0f / 8;
  const Agreement found = compare_blocks(a, b, 4);
  EXPECT_LT(found.log_p, std::log(1e-6));
  ASSERT_FALSE(found.worst.empty());
  EXPECT_EQ(found.worst[0].channel, 1u);
  EXPECT_EQ(found.worst[0].place.x0, 16);
  EXPECT_EQ(found.worst[0].place.y0, 8);
}

TEST(Agreement, IsProofWhereThereIsNoNoise) {
  NoisyPicture a;
  a.width = a.height = 8;
  a.rgb.assign(192, 0.5f);
  a.variance.assign(192, 0);
  NoisyPicture b = a;
  EXPECT_EQ(compare_blocks(a, b, 4).log_p, 0);
  for (float& value : b.rgb) value = std::nextafter(value, 1.0f);
  EXPECT_EQ(compare_blocks(a, b, 4).log_p, 0) << "rounding";
  for (float& value : b.rgb) value = 0.505f;
  EXPECT_TRUE(std::isinf(compare_blocks(a, b, 4).log_p));
  b = a;
  b.rgb[7] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(std::isinf(compare_blocks(a, b, 4).log_p));
}

TEST(Agreement, OneBrightPixelProvesNothing) {
  std::mt19937 random(7);  // seed: 7
  NoisyPicture a = noisy(random, 1, 64);
  const NoisyPicture b = noisy(random, 1, 64);
  // One of 64 samples was 3,000 times as bright as the others.
  a.rgb[300] += 50;
  a.variance[300] = 2500;
  EXPECT_GT(least_p(a, b), std::log(1e-3));
}

TEST(Agreement, FindsACommonFactor) {
  std::mt19937 random(8);  // seed: 8
  NoisyPicture a = noisy(random, 1, 4096);
  const NoisyPicture b = noisy(random, 1, 512);
  const NoisyPicture c = noisy(random, 1, 512);
  EXPECT_GT(compare_brightness(a, b, c).log_p, std::log(1e-3));
  for (float& value : a.rgb) value *= 1.01f;
  EXPECT_LT(compare_brightness(a, b, c).log_p, std::log(1e-6));
}

TEST(Agreement, FindsTooMuchNoise) {
  std::mt19937 random(9);  // seed: 9
  const NoisyPicture a = noisy(random, 1, 64);
  const NoisyPicture b = noisy(random, 1, 64);
  const NoisyPicture c = noisy(random, 1, 256);
  const std::vector<double> weights = brightness_weights(b);
  MirroredSums honest;
  add_mirrored(honest, a, b, weights);
  EXPECT_GT(log_p_fair(honest.noisier), std::log(1e-3));
  EXPECT_GT(log_p_fair(honest.rougher), std::log(1e-3));
  EXPECT_GT(log_p_brightness(honest), std::log(1e-3));
  MirroredSums forged;
  add_mirrored(forged, a, c, weights);
  EXPECT_LT(log_p_fair(forged.noisier), std::log(1e-6));
  EXPECT_LT(log_p_fair(forged.rougher), std::log(1e-6));
}

}  // namespace
}  // namespace scenec::backend
