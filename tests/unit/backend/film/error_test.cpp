#include "backend/film/error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

namespace scenec::backend {
namespace {

ir::RenderSettings square(std::int64_t side) {
  ir::RenderSettings settings;
  settings.size = {side, side};
  return settings;
}

// Every pixel is 1 with independent normal noise of this deviation a sample.
std::unique_ptr<Film> noisy_film(std::int64_t side, int samples, double deviation,
                                 std::uint64_t seed) {
  auto film = std::make_unique<Film>(square(side));
  std::mt19937_64 random(seed);
  std::normal_distribution<double> noise(1, deviation);
  film->begin_round();
  for (std::size_t y = 0; y < static_cast<std::size_t>(side); ++y) {
    for (std::size_t x = 0; x < static_cast<std::size_t>(side); ++x) {
      Film::Pixel pixel = film->open(x, y);
      for (int i = 0; i < samples; ++i) {
        FilmSample sample;
        sample.radiance = {noise(random), noise(random), noise(random)};
        pixel.add(i, sample);
      }
      pixel.close();
    }
  }
  film->finish_round(samples);
  return film;
}

TEST(error_of, is_0_without_noise) {
  ThreadPool pool(2);
  const ErrorEstimate error = error_of(*noisy_film(16, 16, 0, 1), pool);
  ASSERT_TRUE(error.known);
  EXPECT_EQ(error.relative.value, 0);
  EXPECT_EQ(error.relative.high, 0);
  EXPECT_EQ(error.absolute.value, 0);
}

TEST(error_of, is_that_of_normal_noise) {
  ThreadPool pool(2);
  const int samples = 16;
  const double deviation = 0.3;
  // R = 1 everywhere, so relMSE is the variance of a mean over 1 + 0.01.
  const double rmse = deviation / std::sqrt(samples);
  const double expected = rmse / std::sqrt(1.01);
  int inside = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const ErrorEstimate error = error_of(*noisy_film(48, samples, deviation, seed), pool);
    ASSERT_TRUE(error.known);
    EXPECT_NEAR(error.relative.value / expected, 1, 0.06) << "seed " << seed;
    EXPECT_NEAR(error.absolute.value / rmse, 1, 0.06) << "seed " << seed;
    if (error.relative.low <= expected && expected <= error.relative.high) ++inside;
  }
  // 95 % of 20; fewer than 15 is a chance of 1 in 3,000 and the seeds are fixed.
  EXPECT_GE(inside, 15);
}

TEST(error_of, needs_a_sample_or_two_in_each_replicate) {
  ThreadPool pool(2);
  EXPECT_FALSE(error_of(*noisy_film(8, 1, 0.3, 1), pool).known);
  EXPECT_FALSE(error_of(*noisy_film(8, 3, 0.3, 1), pool).known);
  EXPECT_TRUE(error_of(*noisy_film(8, 8, 0.3, 1), pool).known);
}

TEST(error_of, does_not_depend_on_threads) {
  ThreadPool one(1), many(7);
  const auto film = noisy_film(32, 16, 0.5, 3);
  EXPECT_EQ(error_of(*film, one).relative.value, error_of(*film, many).relative.value);
  EXPECT_EQ(error_of(*film, one).relative.high, error_of(*film, many).relative.high);
}

}  // namespace
}  // namespace scenec::backend
