#include "backend/sample_plan.hpp"

#include <gtest/gtest.h>

#include <random>

namespace scenec::backend {
namespace {

constexpr std::size_t columns = 7;
constexpr std::size_t rows = 5;

std::vector<std::int64_t> tile_pixels() {
  std::vector<std::int64_t> pixels(columns * rows, 64);
  for (std::size_t y = 0; y < rows; ++y) pixels[y * columns + columns - 1] = 24;  // a cut column
  return pixels;
}

std::vector<double> random_errors(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::lognormal_distribution<double> error(0, 2);
  std::vector<double> errors(columns * rows);
  for (double& e : errors) e = error(random);
  return errors;
}

double mean_count(const SamplePlan& plan, std::int64_t samples) {
  const auto pixels = tile_pixels();
  double sum = 0;
  double all = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    sum += static_cast<double>(pixels[i] * plan.count(i, samples));
    all += static_cast<double>(pixels[i]);
  }
  return sum / all;
}

TEST(sample_plan, spends_what_it_was_given_and_takes_nothing_back) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    SamplePlan plan(tile_pixels(), columns);
    std::vector<std::int64_t> before(columns * rows, 0);
    std::int64_t samples = 0;
    for (int stage = 0; stage < 8; ++stage) {
      for (; samples <= plan.stage_end(); ++samples) {
        for (std::size_t i = 0; i < before.size(); ++i) {
          const std::int64_t now = plan.count(i, samples);
          ASSERT_GE(now, before[i]) << "seed " << seed;
          before[i] = now;
        }
      }
      samples = plan.stage_end();
      // Rounding may leave one step of the last tile.
      EXPECT_NEAR(mean_count(plan, samples), static_cast<double>(samples), 0.2) << "seed " << seed;
      plan.next_stage(random_errors(seed * 100 + static_cast<std::uint64_t>(stage)));
      for (std::size_t i = 0; i < before.size(); ++i) EXPECT_EQ(plan.count(i, samples), before[i]);
    }
  }
}

TEST(sample_plan, gives_more_where_the_error_is_and_some_everywhere) {
  SamplePlan plan(tile_pixels(), columns);
  std::vector<double> errors(columns * rows, 0);
  errors[2 * columns + 2] = 1;
  for (int stage = 0; stage < 12; ++stage) plan.next_stage(errors);
  const std::int64_t end = plan.stage_end();
  EXPECT_GT(plan.count(2 * columns + 2, end), 3 * end);
  for (std::size_t i = 0; i < columns * rows; ++i) EXPECT_GE(plan.count(i, end), end / 10);
}

TEST(sample_plan, is_even_where_no_error_is_known) {
  SamplePlan plan(tile_pixels(), columns);
  plan.next_stage({});
  plan.next_stage(std::vector<double>(columns * rows, 0));
  for (std::size_t i = 0; i < columns * rows; ++i)
    EXPECT_NEAR(static_cast<double>(plan.count(i, plan.stage_end())),
                static_cast<double>(plan.stage_end()), 4) << i;
}

TEST(sample_plan, goes_on_from_its_bytes_and_takes_no_others) {
  SamplePlan plan(tile_pixels(), columns);
  plan.next_stage(random_errors(1));
  SamplePlan other(tile_pixels(), columns);
  const std::string bytes = plan.save();
  ASSERT_TRUE(other.restore(bytes));
  EXPECT_EQ(other.save(), bytes);
  EXPECT_FALSE(other.restore(bytes.substr(1)));
  EXPECT_FALSE(other.restore(bytes + "x"));
  EXPECT_FALSE(other.restore(std::string(bytes.size(), '\xff')));
  EXPECT_EQ(other.save(), bytes);
}

}  // namespace
}  // namespace scenec::backend
