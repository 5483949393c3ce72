// Pearson's test of samples against the density they claim: cells of the unit square, each
// integrated on a fine grid.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "backend/math/rng.hpp"
#include "backend/math/sampling.hpp"

namespace scenec::backend::test {

// The upper tail of the chi-square distribution by the cube-root approximation of Wilson and
// Hilferty (1931), good to three digits of the tail for more than ten degrees of freedom.
[[nodiscard]] inline double chi_square_tail(double statistic, int freedom) {
  const double k = freedom;
  const double z = (std::cbrt(statistic / k) - (1 - 2 / (9 * k))) / std::sqrt(2 / (9 * k));
  return 0.5 * std::erfc(z / std::sqrt(2.0));
}

struct ChiSquareCase {
  // A point of the unit square from the numbers of one draw; false: the sample has no value.
  std::function<bool(Sample2 u, double lobe, Sample2& cell)> sample;
  // The density of such points, per area of the unit square.
  std::function<double(Sample2 cell)> density;
  int columns = 20;
  int rows = 20;
  int draws = 200000;
  int steps = 12;  // of a cell's integral, an axis
};

struct ChiSquareResult {
  double tail = 1;  // probability of a statistic this large
  int outside = 0;  // samples where the density is 0
  double total_density = 0;
};

[[nodiscard]] inline ChiSquareResult chi_square(const ChiSquareCase& c, std::uint64_t seed) {
  const auto cells = static_cast<std::size_t>(c.columns * c.rows);
  std::vector<double> expected(cells);
  std::vector<int> counted(cells);
  ChiSquareResult result;
  for (int y = 0; y < c.rows; ++y)
    for (int x = 0; x < c.columns; ++x) {
      double sum = 0;
      for (int j = 0; j < c.steps; ++j)
        for (int i = 0; i < c.steps; ++i)
          sum += c.density(
              {(x + (i + 0.5) / c.steps) / c.columns, (y + (j + 0.5) / c.steps) / c.rows});
      const double mass = sum / (c.steps * c.steps * c.columns * c.rows);
      expected[static_cast<std::size_t>(y * c.columns + x)] = mass * c.draws;
      result.total_density += mass;
    }
  int nothing = 0;
  for (int k = 0; k < c.draws; ++k) {
    const auto number = static_cast<std::uint64_t>(k);
    Sample2 at;
    if (!c.sample({random_unit(seed, number, 0, 0), random_unit(seed, number, 0, 1)},
                  random_unit(seed, number, 0, 2), at)) {
      ++nothing;
      continue;
    }
    const int x = std::min(static_cast<int>(at.u * c.columns), c.columns - 1);
    const int y = std::min(static_cast<int>(at.v * c.rows), c.rows - 1);
    const auto cell = static_cast<std::size_t>(y * c.columns + x);
    ++counted[cell];
    if (!(c.density(at) > 0)) ++result.outside;
  }
  // Cells with few expected samples are put together; so are the draws without a value.
  double statistic = 0;
  int freedom = -1;
  double pooled_expected = std::fmax(0, c.draws * (1 - result.total_density));
  double pooled_counted = nothing;
  const auto add = [&](double e, double n) {
    statistic += (n - e) * (n - e) / e;
    ++freedom;
  };
  for (std::size_t i = 0; i < cells; ++i) {
    if (expected[i] >= 20) {
      add(expected[i], counted[i]);
    } else {
      pooled_expected += expected[i];
      pooled_counted += counted[i];
    }
  }
  if (pooled_expected >= 20) add(pooled_expected, pooled_counted);
  result.tail = freedom > 0 ? chi_square_tail(statistic, freedom) : 1;
  return result;
}

// The probability of the better of two seeds: a failure counts when it is confirmed.
[[nodiscard]] inline ChiSquareResult confirmed_chi_square(const ChiSquareCase& c, double level) {
  const ChiSquareResult first = chi_square(c, 1);
  return first.tail > level ? first : chi_square(c, 2);
}

// One directions' sphere as a square: u the azimuth, v by height, so areas are kept.
[[nodiscard]] inline Vector3 direction_at(Sample2 cell) {
  const double z = 1 - 2 * cell.v;
  const double r = std::sqrt(std::fmax(0, 1 - z * z));
  return {r * std::cos(2 * pi * cell.u), r * std::sin(2 * pi * cell.u), z};
}
[[nodiscard]] inline Sample2 cell_of(const Vector3& w) {
  const double turn = std::atan2(w.y, w.x) / (2 * pi);
  return {turn < 0 ? turn + 1 : turn, std::fmin(std::fmax((1 - w.z) / 2, 0), 1 - 0x1p-53)};
}
inline constexpr double sphere_area = 4 * pi;

}  // namespace scenec::backend::test
