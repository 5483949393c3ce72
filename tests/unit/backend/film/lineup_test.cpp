#include "backend/film/lineup.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace scenec::backend {
namespace {

constexpr double rounding = 0x1p-23;

// Noise with the tails of bright samples that are rare: exp of a normal value, to the power of two.
std::vector<float> wild(std::mt19937& random, std::size_t pixels) {
  std::lognormal_distribution<float> noise(0, 2);
  std::vector<float> values(3 * pixels);
  for (float& v : values) v = noise(random);
  return values;
}

std::vector<std::vector<float>> peers_of(std::mt19937& random, std::size_t pixels,
                                         std::size_t count) {
  std::vector<std::vector<float>> peers;
  for (std::size_t k = 0; k < count; ++k) peers.push_back(wild(random, pixels));
  return peers;
}

TEST(Lineup, EvidenceAgainstTheHonestIsOneOnAverage) {
  std::mt19937 random(11);  // seed: 11
  // One pixel: its evidence is 9 times a weight, or 0, and 9 in the mean of three ways at most.
  constexpr int trials = 40000;
  double sum = 0;
  for (int i = 0; i < trials; ++i)
    sum += evidence_against(wild(random, 1), peers_of(random, 1, 8), 1, rounding) / trials;
  // Its variance is below 9, so this is at least six standard deviations.
  EXPECT_NEAR(sum, 1, 0.09);
}

TEST(Lineup, TheHonestAreSeldomSuspected) {
  std::mt19937 random(12);  // seed: 12
  int above_twenty = 0;
  for (int i = 0; i < 1000; ++i)
    above_twenty +=
        evidence_against(wild(random, 16), peers_of(random, 16, 16), 4, rounding) > 20 ? 1 : 0;
  EXPECT_LE(above_twenty, 50);
}

TEST(Lineup, AThinLineIsCertain) {
  std::mt19937 random(13);  // seed: 13
  std::normal_distribution<float> noise(1, 0.1f);
  const auto picture = [&] {
    std::vector<float> values(3 * 64);
    for (float& v : values) v = noise(random);
    return values;
  };
  std::vector<std::vector<float>> peers;
  for (int k = 0; k < 32; ++k) peers.push_back(picture());
  const std::vector<float> honest = picture();
  EXPECT_LT(evidence_against(honest, peers, 8, rounding), 100);
  for (const float change : {0.6f, -0.6f}) {
    std::vector<float> line = honest;
    for (std::size_t x = 0; x < 8; ++x)
      for (std::size_t c = 0; c < 3; ++c) line[3 * (8 * 3 + x) + c] += change;
    EXPECT_GT(evidence_against(line, peers, 8, rounding), 1e5);
  }
}

TEST(Lineup, WithoutNoiseOnlyMoreThanRoundingSaysSomething) {
  const std::vector<std::vector<float>> peers(8, std::vector<float>(48, 0.5f));
  std::vector<float> suspect(48, std::nextafter(0.5f, 1.0f));
  EXPECT_DOUBLE_EQ(evidence_against(suspect, peers, 4, rounding), 1);
  for (float& v : suspect) v = 0.501f;
  EXPECT_GT(evidence_against(suspect, peers, 4, rounding), 1e6);
  for (float& v : suspect) v = std::numeric_limits<float>::quiet_NaN();
  EXPECT_GT(evidence_against(suspect, peers, 4, rounding), 1e6);
}

TEST(Lineup, CellsThatWereNotLookedAtSpeakForThePicture) {
  EXPECT_EQ(log_p_of_evidence({}, 100), 0);
  EXPECT_EQ(log_p_of_evidence({0.5, 1}, 100), 0);
  const double one_of_one = log_p_of_evidence({1e6}, 1);
  const double one_of_many = log_p_of_evidence({1e6}, 100);
  EXPECT_NEAR(one_of_one, std::log(1e-6), 1e-9);
  EXPECT_GT(one_of_many, one_of_one);
  // As one test of a hundred would: not much more than by the factor of their number.
  EXPECT_LT(one_of_many, std::log(1e-6 * 100 * 12));
  EXPECT_LT(log_p_of_evidence({1e6, 1e6, 1e6}, 100), one_of_many);
  EXPECT_TRUE(std::isfinite(log_p_of_evidence({1e300, 1e300, 1e300}, 400)));
}

}  // namespace
}  // namespace scenec::backend
