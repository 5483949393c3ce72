// Numbers depend on every coordinate, are spread evenly and never reach 1.
#include "backend/math/rng.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <set>

namespace scenec::backend {
namespace {

TEST(Rng, NeverOne) {
  EXPECT_EQ(unit_double(0), 0.0);
  EXPECT_EQ(unit_double(std::numeric_limits<std::uint64_t>::max()), 1 - 0x1p-53);
}

TEST(Rng, EveryCoordinateMatters) {
  std::set<std::uint64_t> seen;
  for (std::uint64_t a = 0; a < 8; ++a)
    for (std::uint64_t b = 0; b < 8; ++b)
      for (std::uint64_t c = 0; c < 8; ++c)
        for (std::uint32_t d = 0; d < 8; ++d) seen.insert(SampleRandom(a, b, c).bits(d));
  EXPECT_EQ(seen.size(), 4096U);
}

TEST(Rng, OneBitFlipsHalf) {
  double flips = 0;
  constexpr int count = 20000;
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t bit = std::uint64_t{1} << (i % 40);
    flips += std::popcount(SampleRandom(5, i, 9).bits(2) ^ SampleRandom(5, i ^ bit, 9).bits(2));
  }
  EXPECT_NEAR(flips / count, 32, 5 * 4 / std::sqrt(double{count}));
}

TEST(Rng, NeighbouringPairsFillTheSquare) {
  // Chi-square of pairs (pixel, pixel + 1) and (dimension, dimension + 1) on 16 x 16 cells:
  // 255 degrees of freedom, 400 is beyond the 1e-8 quantile. Seed 11.
  constexpr std::size_t cells = 256;
  constexpr std::size_t count = 256000;
  std::array<double, cells> by_pixel{};
  std::array<double, cells> by_dimension{};
  const auto cell = [](double x, double y) {
    return static_cast<std::size_t>(x * 16) * 16 + static_cast<std::size_t>(y * 16);
  };
  for (std::uint64_t i = 0; i < count; ++i) {
    by_pixel[cell(random_unit(11, 2 * i, 0, 0), random_unit(11, 2 * i + 1, 0, 0))] += 1;
    by_dimension[cell(random_unit(11, i, 1, 0), random_unit(11, i, 1, 1))] += 1;
  }
  for (const auto& histogram : {by_pixel, by_dimension}) {
    double chi_square = 0;
    for (const double n : histogram) chi_square += (n - 1000) * (n - 1000) / 1000;
    EXPECT_LT(chi_square, 400);
    EXPECT_GT(chi_square, 140);
  }
}

TEST(Rng, ValuesAreFixedForEver) {
  // Pictures depend on these bits.
  EXPECT_EQ(SampleRandom(0, 0, 0).bits(0), 0xc6344ff1a6a08831ULL);
  EXPECT_EQ(SampleRandom(1, 2, 3).bits(4), 0x0521075dcbf1f175ULL);
  static_assert(SampleRandom(1, 2, 3).unit(4) < 1);
}

}  // namespace
}  // namespace scenec::backend
