// The paths over one sphere against a scan in long double and against differences of traced rays.
#include "backend/lights/sphere_paths.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "base/elementary.hpp"

namespace scenec::backend {
namespace {

constexpr std::uint32_t seed = 20261123;
using Real = long double;

Real bent_angle(Real from, Real to, Real ior, Real b) {
  return std::asin(b / from) + std::asin(b / to) + 2 * std::asin(b / ior) - 2 * std::asin(b);
}

// Roots of bent_angle = gamma on (-1, 1), by scanning and bisection; `margin`: the least distance
// of any extremum from gamma, so that the count is certain.
std::vector<Real> scanned(Real from, Real to, Real ior, Real gamma, Real& margin) {
  constexpr int steps = 4000;
  const auto value = [&](Real tau) { return bent_angle(from, to, ior, std::sin(tau)) - gamma; };
  const Real quarter = std::acos(Real{-1}) / 2;
  std::vector<Real> roots;
  margin = 1;
  Real before = value(-quarter);
  Real before2 = before;
  for (int i = 1; i <= steps; ++i) {
    const Real tau = quarter * (2 * Real(i) / steps - 1);
    const Real now = value(tau);
    if (i > 1 && (before - before2) * (now - before) <= 0)
      margin = std::min(margin, std::fabs(before));
    if ((before < 0) != (now < 0)) {
      Real low = tau - 2 * quarter / steps;
      Real high = tau;
      for (int k = 0; k < 80; ++k) {
        const Real middle = (low + high) / 2;
        ((value(middle) < 0) == (before < 0) ? low : high) = middle;
      }
      roots.push_back(std::sin(low));
    }
    before2 = before;
    before = now;
  }
  return roots;
}

double distance_of(std::mt19937& random) {
  // From all but touching to far away.
  std::uniform_real_distribution<double> exponent(-4, 2);
  return 1 + std::pow(10, exponent(random));
}

TEST(SpherePaths, EveryPathThroughIsFound) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> part(0, 1);
  int roots = 0;
  int most = 0;
  int unsure = 0;
  for (int i = 0; i < 1000; ++i) {
    SphereEnds ends;
    ends.from = distance_of(random);
    ends.to = i % 3 == 0 ? 1 + 0.1 * part(random) : distance_of(random);
    const double ior = 1.02 + (i % 5 == 0 ? 8 : 1.5) * part(random);
    const double gamma = pi * std::pow(part(random), i % 2 == 0 ? 1 : 3);
    ends.cosine = -std::cos(gamma);
    ends.sine = std::sin(gamma);
    Real margin = 0;
    std::vector<Real> expected = scanned(ends.from, ends.to, ior, gamma, margin);
    const Impacts found = impacts_through(ends, ior);
    if (margin < 1e-5L) {
      ++unsure;
      continue;
    }
    std::vector<double> got(found.values.begin(), found.values.begin() + found.count);
    std::sort(got.begin(), got.end());
    ASSERT_EQ(got.size(), expected.size())
        << "seed " << seed << " case " << i << " from " << ends.from << " to " << ends.to << " ior "
        << ior << " gamma " << gamma;
    for (std::size_t k = 0; k < got.size(); ++k)
      EXPECT_NEAR(got[k], static_cast<double>(expected[k]), 1e-9)
          << "case " << i << " from " << ends.from << " to " << ends.to;
    roots += found.count;
    most = std::max(most, found.count);
  }
  EXPECT_GE(most, 3) << "the scan should have met places within a caustic";
  EXPECT_GT(roots, 500);
  EXPECT_LT(unsure, 20);
}

TEST(SpherePaths, TheMirroredPathHasEqualAngles) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> part(0, 1);
  int hidden = 0;
  for (int i = 0; i < 20000; ++i) {
    SphereEnds ends{distance_of(random), distance_of(random), 1, 0};
    const double gamma = pi * part(random);
    ends.cosine = std::cos(gamma);
    ends.sine = std::sin(gamma);
    const double largest = pi - std::asin(1 / ends.from) - std::asin(1 / ends.to);
    if (std::fabs(gamma - largest) < 1e-9) continue;
    const auto b = mirrored_impact(ends);
    ASSERT_EQ(b.has_value(), gamma < largest) << "case " << i;
    if (!b) {
      ++hidden;
      continue;
    }
    const Real t = *b;
    const Real angle = 2 * std::asin(t) - std::asin(t / ends.from) - std::asin(t / ends.to);
    // What a rounding of the impact does to the angle.
    const Real slope = 2 / std::sqrt(1 - t * t);
    ASSERT_NEAR(static_cast<double>(angle), gamma, 1e-12 + 1e-14 * static_cast<double>(slope))
        << "case " << i << " from " << ends.from << " to " << ends.to;
  }
  EXPECT_GT(hidden, 1000);
}

// The place where a path that leaves the axis' end with impact b meets the plane across the path of
// impact b0, measured along that plane: differences of it are the width in the plane.
TEST(SpherePaths, SpreadsAreThoseOfNeighbouringPaths) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> part(0, 1);
  for (int i = 0; i < 2000; ++i) {
    const Real from = 1.05L + 4 * part(random);
    const Real to = 1.05L + 6 * part(random);
    const Real ior = 1.1L + part(random);
    const Real b = 0.02L + 0.9L * part(random);
    const bool mirrored = i % 2 == 0;
    const auto angle = [&](Real x) {
      return mirrored ? 2 * std::asin(x) - std::asin(x / from) - std::asin(x / to)
                      : bent_angle(from, to, ior, x);
    };
    // In the plane: angle at the start da = db / (from cos a); at the end the point at distance
    // `to` moves by to d(angle), of which the part across the path is that times cos asin(b / to).
    const Real step = 1e-6L;
    const Real slope = (angle(b + step) - angle(b - step)) / (2 * step);
    const Real in_plane = to * slope * std::sqrt(1 - b * b / (to * to)) *
                          (from * std::sqrt(1 - b * b / (from * from)));
    // Across it: turning the plane about the axis.
    const Real polar = mirrored ? angle(b) : std::acos(Real{-1}) - angle(b);
    const Real across = to * std::sin(polar) / (b / from);
    const double expected = static_cast<double>(std::fabs(in_plane * across));
    const auto f = static_cast<double>(from);
    const auto t = static_cast<double>(to);
    const double got = mirrored
                           ? mirrored_spread(f, t, static_cast<double>(b))
                           : spread_through(f, t, static_cast<double>(b), static_cast<double>(ior));
    EXPECT_NEAR(got, expected, 1e-6 * (1 + expected)) << "seed " << seed << " case " << i;
  }
}

TEST(SpherePaths, InLineWithTheCentreTheStraightPathIsFound) {
  const Impacts found = impacts_through({3, 4, -1, 0}, 1.5);
  ASSERT_GE(found.count, 1);
  double least = 1;
  for (int i = 0; i < found.count; ++i)
    least = std::min(least, std::fabs(found.values[static_cast<std::size_t>(i)]));
  EXPECT_LT(least, 1e-9);
  const auto mirrored = mirrored_impact({3, 4, 1, 0});
  ASSERT_TRUE(mirrored.has_value());
  EXPECT_LT(std::fabs(*mirrored), 1e-9);
  // A thick lens: 1/f = 2 (n - 1) / n for unit radius; without bending the spread is (d1 + d2)^2.
  EXPECT_NEAR(spread_through(3, 4, 0, 1.0000001), 49, 1e-4);
}

}  // namespace
}  // namespace scenec::backend
