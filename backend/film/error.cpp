#include "backend/film/error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace scenec::backend {
namespace {

constexpr std::size_t r = replicate_count;
static_assert(r == 4, "the pairs below are those of four");
constexpr std::array<std::array<std::size_t, 4>, 3> pairings{
    {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2}}};
// Two-sided normal quantile of 95 %.
constexpr double quantile = 1.959963984540054;
// Neighbours so far away may stand in for a pixel when their middles differ by at most this part of
// their mean plus so many standard deviations of the noise; there must be so many of them.
constexpr std::size_t neighbour_radius = 2;
constexpr double alike_share = 0.25;
constexpr double most_deviations = 3;
constexpr int fewest_neighbours = 4;
// What the neighbours' scatter says of how far their mean is from the pixel's own true value.
constexpr double scatter_share = 0.75;
// What a relative error is measured against where the picture is dark (language: `error`).
constexpr double dark_share = 0.01;

struct Noise {
  std::array<double, 3> mean{};
  std::array<double, 3> variance{};  // of the mean
  std::array<double, 3> middle{};  // mean of the two middle replicates: blind to one bright sample
  std::array<double, 3> spread{};  // a variance of `middle`, likewise
  ReplicateMeans replicates{};
};

Noise noise_of(const ReplicateMeans& replicates, const Rgb& mean) {
  Noise noise;
  noise.mean = {mean.r, mean.g, mean.b};
  noise.replicates = replicates;
  for (std::size_t c = 0; c < 3; ++c) {
    noise.variance[c] = variance_of_mean(replicates, c);
    std::array<double, r> sorted{};
    for (std::size_t k = 0; k < r; ++k) sorted[k] = replicates[k][c];
    std::sort(sorted.begin(), sorted.end());
    noise.middle[c] = (sorted[1] + sorted[2]) / 2;
    const double narrower = std::min(sorted[2] - sorted[0], sorted[3] - sorted[1]);
    noise.spread[c] = narrower * narrower / 4;
  }
  return noise;
}

// 1 / (R^2 + e) for the three channels, and how far off a pixel's share may be for not knowing R:
// standard deviation over the channel's variance.
struct Weight {
  std::array<double, 3> value{};
  std::array<double, 3> doubt{};
};

// Sums over pixels: of the squared error expected, and of its variance.
struct Squares {
  double expected = 0;
  double variance = 0;
  void operator+=(const Squares& other) {
    expected += other.expected;
    variance += other.variance;
  }
};

// The three channels of a pixel are noisy together: their covariances count.
Squares squares_of(const Noise& noise, const Weight& weight) {
  Squares squares;
  double doubt = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    squares.expected += weight.value[c] * noise.variance[c];
    doubt += weight.doubt[c] * noise.variance[c];
  }
  double products = 0;
  for (const auto& [a, b, d, e] : pairings) {
    double sum = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto& x = noise.replicates;
      sum += weight.value[c] * (x[a][c] - x[b][c]) * (x[d][c] - x[e][c]);
    }
    products += sum * sum;
  }
  // E[(x_a - x_b)^2 (x_d - x_e)^2] = 4 S^2 with S the variance of a replicate, r s that of the
  // mean.
  const double squared_variance = products / (static_cast<double>(pairings.size()) * 4 * r * r);
  squares.variance = 2 * squared_variance * r / (r - 1) + doubt * doubt;
  return squares;
}

class Estimator {
 public:
  Estimator(const Film& film, ThreadPool& pool)
      : film_(film),
        pool_(pool),
        width_(film.region_width()),
        height_(film.region_height()),
        noise_(width_ * height_) {}

  ErrorEstimate estimate() {
    if (noise_.empty() || !gather()) return {};
    find_dark_level();
    std::vector<Squares> relative(height_);
    std::vector<Squares> absolute(height_);
    pool_.for_each(height_, [&](std::size_t y, unsigned) {
      for (std::size_t x = 0; x < width_; ++x) {
        const Noise& noise = noise_[y * width_ + x];
        relative[y] += squares_of(noise, weight_at(x, y));
        absolute[y] += squares_of(noise, {{1, 1, 1}, {}});
      }
    });
    ErrorEstimate result;
    result.known = true;
    result.relative = band_of(relative);
    result.absolute = band_of(absolute);
    return result;
  }

 private:
  // False when a pixel's noise is not known.
  bool gather() {
    std::vector<char> known(height_, 1);
    pool_.for_each(height_, [&](std::size_t y, unsigned) {
      for (std::size_t i = y * width_; i < (y + 1) * width_; ++i) {
        const auto means = film_.replicate_means(i);
        if (!means) {
          known[y] = 0;
          return;
        }
        noise_[i] = noise_of(*means, film_.mean(i));
      }
    });
    return std::find(known.begin(), known.end(), 0) == known.end();
  }

  void find_dark_level() {
    double sum = 0;
    for (const Noise& n : noise_) sum += luminance({n.mean[0], n.mean[1], n.mean[2]});
    const double mean = sum / static_cast<double>(noise_.size());
    dark_ = dark_share * mean * mean;
  }

  [[nodiscard]] bool are_alike(const Noise& a, const Noise& b) const {
    for (std::size_t c = 0; c < 3; ++c) {
      const double difference = a.middle[c] - b.middle[c];
      const double share = alike_share * (a.middle[c] + b.middle[c]) / 2;
      const double noise = a.spread[c] + b.spread[c];
      const double most = share * share + most_deviations * most_deviations * noise;
      if (!(difference * difference <= most + dark_share * dark_)) return false;
    }
    return true;
  }

  // Means of the pixels round one that are like it.
  struct Neighbours {
    int count = 0;
    std::array<double, 3> sum{};
    std::array<double, 3> squares{};
    std::array<double, 3> variance{};
  };
  [[nodiscard]] Neighbours neighbours_of(std::size_t x, std::size_t y) const {
    constexpr std::size_t reach = neighbour_radius;
    const Noise& own = noise_[y * width_ + x];
    Neighbours found;
    for (std::size_t ny = y - std::min(y, reach); ny < std::min(y + reach + 1, height_); ++ny) {
      for (std::size_t nx = x - std::min(x, reach); nx < std::min(x + reach + 1, width_); ++nx) {
        const Noise& other = noise_[ny * width_ + nx];
        if (&other == &own || !are_alike(own, other)) continue;
        ++found.count;
        for (std::size_t c = 0; c < 3; ++c) {
          found.sum[c] += other.mean[c];
          found.squares[c] += other.mean[c] * other.mean[c];
          found.variance[c] += other.variance[c];
        }
      }
    }
    return found;
  }

  [[nodiscard]] Weight weight_at(std::size_t x, std::size_t y) const {
    const Neighbours near = neighbours_of(x, y);
    const Noise& own = noise_[y * width_ + x];
    const double n = near.count;
    Weight weight;
    for (std::size_t c = 0; c < 3; ++c) {
      const bool alone = near.count < fewest_neighbours;
      const double mean = alone ? own.middle[c] : near.sum[c] / n;
      const double noise = alone ? 0 : near.variance[c] / (n * n);
      const double square = mean * mean;
      const double sum = square + dark_;
      if (!(sum > 0)) continue;  // a picture without light
      // f = 1 / (m^2 + e); f'' / 2 = (3 m^2 - e) / (m^2 + e)^3; f' = -2 m / (m^2 + e)^2.
      const double curvature = (3 * square - dark_) / (sum * sum) * noise;
      weight.value[c] = std::clamp(1 - curvature, 0.5, 1.5) / sum;
      if (alone) continue;
      const double scatter = std::max(0.0, near.squares[c] / n - square) * n / (n - 1);
      weight.doubt[c] = 2 * std::abs(mean) / (sum * sum) * std::sqrt(scatter_share * scatter);
    }
    return weight;
  }

  [[nodiscard]] ErrorBand band_of(const std::vector<Squares>& rows) const {
    Squares sum;
    for (const Squares& row : rows) sum += row;
    const double values = 3 * static_cast<double>(noise_.size());
    const double half = quantile * std::sqrt(std::max(0.0, sum.variance));
    return {std::sqrt(sum.expected / values),
            std::sqrt(std::max(0.0, sum.expected - half) / values),
            std::sqrt((sum.expected + half) / values)};
  }

  const Film& film_;
  ThreadPool& pool_;
  std::size_t width_;
  std::size_t height_;
  std::vector<Noise> noise_;
  double dark_ = 0;
};

}  // namespace

ErrorEstimate error_of(const Film& film, ThreadPool& pool) {
  return Estimator(film, pool).estimate();
}

}  // namespace scenec::backend
