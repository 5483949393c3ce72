#include "backend/samplers/sampler.hpp"

#include <gtest/gtest.h>

#include <set>
#include <vector>

namespace scenec::backend {
namespace {

TEST(sampler, sobol_pairs_are_nets_for_every_pixel_and_dimension) {
  for (const std::uint32_t dimension : {0U, 4U, 6U, 14U, 104U}) {
    for (const std::uint64_t pixel : {0ULL, 1ULL, 12345ULL}) {
      // Every cell of every shape 2^a x 2^(6-a) holds one of 64 samples.
      for (int a = 0; a <= 6; ++a) {
        std::set<std::pair<int, int>> cells;
        for (std::uint64_t s = 0; s < 64; ++s) {
          const Sample2 u = Sampler(ir::SamplerKind::sobol, 7, pixel, s).get_2d(dimension);
          cells.insert({static_cast<int>(u.u * (1 << a)), static_cast<int>(u.v * (1 << (6 - a)))});
        }
        EXPECT_EQ(cells.size(), 64U) << "shape " << a;
      }
    }
  }
}

TEST(sampler, sobol_single_dimensions_are_stratified_in_every_block) {
  for (std::uint64_t block = 0; block < 4; ++block) {
    std::set<int> strata;
    for (std::uint64_t s = 16 * block; s < 16 * (block + 1); ++s) {
      strata.insert(static_cast<int>(Sampler(ir::SamplerKind::sobol, 0, 5, s).get_1d(9) * 16));
    }
    EXPECT_EQ(strata.size(), 16U);
  }
}

TEST(sampler, numbers_are_in_the_unit_interval_and_uniform) {
  for (const ir::SamplerKind kind : {ir::SamplerKind::sobol, ir::SamplerKind::independent}) {
    double sum = 0;
    double product = 0;
    constexpr int n = 20000;
    for (std::uint64_t pixel = 0; pixel < n; ++pixel) {
      const Sampler s(kind, 3, pixel, pixel % 7);
      const double a = s.get_1d(11);
      const Sample2 b = s.get_2d(12);
      ASSERT_TRUE(a >= 0 && a < 1 && b.u >= 0 && b.u < 1 && b.v >= 0 && b.v < 1);
      sum += a;
      product += (a - 0.5) * (b.u - 0.5);
    }
    // 5 standard deviations.
    EXPECT_NEAR(sum / n, 0.5, 5 * 0.2887 / 141.4);
    EXPECT_NEAR(product / n, 0, 5.0 / 12 / 141.4);
  }
}

TEST(sampler, seed_pixel_and_sample_all_matter) {
  for (const ir::SamplerKind kind : {ir::SamplerKind::sobol, ir::SamplerKind::independent}) {
    std::set<double> values;
    for (std::uint64_t i = 0; i < 2; ++i) {
      for (std::uint64_t j = 0; j < 2; ++j) {
        for (std::uint64_t k = 0; k < 2; ++k) values.insert(Sampler(kind, i, j, k).get_1d(4));
      }
    }
    EXPECT_EQ(values.size(), 8U);
  }
}

}  // namespace
}  // namespace scenec::backend
