#include "backend/film/mirrored_tests.hpp"

#include <algorithm>
#include <cmath>

#include "base/assert.hpp"

namespace scenec::backend {
namespace {

// How much nine pixels differ among themselves.
double spread_of(const NoisyPicture& p, std::size_t x0, std::size_t y0) {
  double spread = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    double sum = 0;
    double squares = 0;
    for (std::size_t y = y0; y < y0 + 3; ++y) {
      for (std::size_t x = x0; x < x0 + 3; ++x) {
        const double v = double{p.rgb[3 * (y * p.width + x) + c]};
        sum += v;
        squares += v * v;
      }
    }
    spread += squares - sum / 9 * sum;
  }
  return spread;
}

void toss(MirroredSums::Coins& coins, double a, double b) {
  coins.up += a > b ? 1 : 0;
  coins.down += a < b ? 1 : 0;
}

}  // namespace

void add_mirrored(MirroredSums& sums, const NoisyPicture& a, const NoisyPicture& b,
                  const std::vector<double>& weights) {
  SCENEC_ASSERT(a.rgb.size() == b.rgb.size() && a.rgb.size() == weights.size());
  for (std::size_t i = 0; i + 2 < a.rgb.size(); i += 3) {
    double noise_a = 0;
    double noise_b = 0;
    for (std::size_t c = i; c < i + 3; ++c) {
      const double difference = weights[c] * (double{a.rgb[c]} - double{b.rgb[c]});
      sums.difference[c - i] += difference;
      sums.squares[c - i] += difference * difference;
      noise_a += double{a.variance[c]};
      noise_b += double{b.variance[c]};
    }
    toss(sums.noisier, noise_a, noise_b);
  }
  for (std::size_t y = 0; y + 3 <= a.height; y += 3)
    for (std::size_t x = 0; x + 3 <= a.width; x += 3)
      toss(sums.rougher, spread_of(a, x, y), spread_of(b, x, y));
}

double log_p_brightness(const MirroredSums& sums) {
  double lowest = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    if (!(sums.squares[c] > 0)) continue;
    const double t = sums.difference[c] / sums.squares[c] * sums.difference[c];
    lowest = std::min(lowest, std::log(2.0) - t / 2);
  }
  return std::min(0.0, lowest + std::log(3.0));
}

void add_middles(MirroredSums& sums, const NoisyPicture& a, const NoisyPicture& b,
                 const NoisyPicture& c) {
  const auto whole = [](const NoisyPicture& p, std::size_t i) {
    return double{p.rgb[i]} + double{p.rgb[i + 1]} + double{p.rgb[i + 2]};
  };
  for (std::size_t i = 0; i + 2 < a.rgb.size(); i += 3) {
    const double first = whole(a, i);
    const double low = std::min(whole(b, i), whole(c, i));
    const double high = std::max(whole(b, i), whole(c, i));
    if (first == low || first == high) continue;
    toss(sums.middle, first > low && first < high ? 1 : 0, first > low && first < high ? 0 : 1);
  }
}

double log_p_fair(const MirroredSums::Coins& coins, double up) {
  const double count = static_cast<double>(coins.up + coins.down);
  if (!(count > 0)) return 0;
  const double off = static_cast<double>(coins.up) / count - up;
  return std::min(0.0, std::log(2.0) - 2 * count * off * off);
}

}  // namespace scenec::backend
