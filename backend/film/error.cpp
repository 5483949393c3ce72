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
// What tells the noise, and the two replicates that see none of it and guess R.
constexpr std::array<std::array<std::size_t, 4>, 6> pairs{
    {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 0, 2}, {2, 3, 0, 1}}};
constexpr std::size_t pairings = 3;  // of those, different ways to make two pairs of four
// Two-sided normal quantile of 95 %.
constexpr double quantile = 1.959963984540054;
// A pixel next to another is like it when their middles differ by at most this part of their mean
// plus so many standard deviations of the noise. Fewer than three such neighbours say nothing.
constexpr std::size_t neighbour_radius = 1;
constexpr double alike_share = 0.25;
constexpr double most_deviations = 3;
constexpr int fewest_neighbours = 3;
// Pixels that share their neighbours are wrong about R together: doubts of nine pixels that are one
// doubt add up to nine of it where independent ones add up to three. What no doubt tells (light
// that is rarer than any replicate shows) is allowed for by a part of the squared error, chosen on
// the tuning scenes of docs/accuracy.md.
constexpr double shared_doubt = 2 * neighbour_radius + 1;
constexpr double untold_share = 0.1;
// What a relative error is measured against where the picture is dark (language: `error`).
constexpr double dark_share = 0.01;

using Channels = std::array<double, 3>;

struct Noise {
  Channels mean{};
  Channels variance{};  // of one replicate
  Channels middle{};    // mean of the two middle replicates: blind to one bright sample
  Channels spread{};    // a variance of `middle`, likewise
  ReplicateMeans replicates{};
};

Noise noise_of(const ReplicateMeans& replicates) {
  Noise noise;
  noise.replicates = replicates;
  for (std::size_t c = 0; c < 3; ++c) {
    noise.variance[c] = r * variance_of_mean(replicates, c);
    std::array<double, r> sorted{};
    for (std::size_t k = 0; k < r; ++k) {
      sorted[k] = replicates[k][c];
      noise.mean[c] += replicates[k][c] / r;
    }
    std::sort(sorted.begin(), sorted.end());
    noise.middle[c] = (sorted[1] + sorted[2]) / 2;
    const double narrower = std::min(sorted[2] - sorted[0], sorted[3] - sorted[1]);
    noise.spread[c] = narrower * narrower / 4;
  }
  return noise;
}

// Sums over the pixels round one: over those that are like it, and of the noise over all.
struct Neighbours {
  int alike = 0;
  int all = 0;
  Channels sum{};
  Channels squares{};
  Channels variance{};
  Channels variance_of_all{};
};

// What two replicates and the neighbours say of a pixel's R: a guess, the variance of its noise,
// and that of what it may be off by in all.
struct Guess {
  double value = 0;
  double noise = 0;
  double doubt = 0;
};

// What the neighbours say of one channel, whichever replicates are asked beside them.
struct Around {
  bool say_something = false;
  double pooled_sum = 0;  // variances that are pooled with the pixel's own, and how many
  double pooled_parts = 1;
  double mean = 0;
  double differing = 0;  // scatter of the neighbours beyond their noise
  double noise_of_mean = 0;
};
Around around_of(const Neighbours& near, std::size_t c) {
  if (near.alike < fewest_neighbours)
    return {.pooled_sum = near.variance_of_all[c], .pooled_parts = 1.0 + 3 * near.all};
  Around around{
      .say_something = true, .pooled_sum = near.variance[c], .pooled_parts = 1.0 + 3 * near.alike};
  const double n = near.alike;
  around.mean = near.sum[c] / n;
  const double noise = near.variance[c] / n / r;
  const double scatter =
      std::max(0.0, near.squares[c] / n - around.mean * around.mean) * n / (n - 1);
  around.differing = std::max(0.0, scatter - noise);
  around.noise_of_mean = noise / n;
  return around;
}

Guess guess_of(double first, double second, const Around& near) {
  const double own = (first + second) / 2;
  const double own_variance = (first - second) * (first - second) / 2;  // of one replicate
  // Three degrees of freedom each, beside one.
  const double own_noise = (own_variance + 3 * near.pooled_sum) / near.pooled_parts / 2;
  if (!near.say_something) return {own, own_noise, own_noise};
  // Between the pixel and its neighbours by what each is worth (James and Stein): their scatter
  // beyond noise says how far R may be from their mean.
  const double both = near.differing + own_noise;
  const double share = both > 0 ? near.differing / both : 1;
  const double rest = (1 - share) * (1 - share) * near.noise_of_mean;
  return {share * own + (1 - share) * near.mean, share * share * own_noise + rest,
          share * own_noise + rest};
}

// Sums over pixels: of the squared error expected, and of its variance.
struct Squares {
  double expected = 0;
  double variance = 0;
  void operator+=(const Squares& other) {
    expected += other.expected;
    variance += other.variance;
  }
};

// Of the difference between the true squared error of a pixel's weighted channels, which are noisy
// together, and its estimate.
double variance_of_squares(const ReplicateMeans& x, const Channels& weight) {
  double products = 0;
  for (std::size_t p = 0; p < pairings; ++p) {
    const auto& [a, b, d, e] = pairs[p];
    double sum = 0;
    for (std::size_t c = 0; c < 3; ++c)
      sum += weight[c] * (x[a][c] - x[b][c]) * (x[d][c] - x[e][c]);
    products += sum * sum;
  }
  // E[(x_a - x_b)^2 (x_d - x_e)^2] = 4 S^2 with S the variance of a replicate, r s that of the
  // mean.
  const double squared_variance = products / (pairings * 4.0 * r * r);
  return 2 * squared_variance * r / (r - 1);
}

Squares relative_squares(const Noise& noise, const Neighbours& near, double dark) {
  const ReplicateMeans& x = noise.replicates;
  Squares squares;
  Channels weight{};
  double doubt = 0;
  const std::array<Around, 3> around{around_of(near, 0), around_of(near, 1), around_of(near, 2)};
  for (const auto& [a, b, d, e] : pairs) {
    for (std::size_t c = 0; c < 3; ++c) {
      const Guess guess = guess_of(x[d][c], x[e][c], around[c]);
      const double square = guess.value * guess.value;
      const double sum = square + dark;
      if (!(sum > 0)) continue;  // a picture without light
      // f = 1 / (m^2 + e); f'' / 2 f^2 = (3 m^2 - e) / (m^2 + e): what noise adds to f on average.
      const double curved = (3 * square - dark) / sum * guess.noise;
      const double f = 1 / std::max(sum + curved, dark / 2);
      const double difference = x[a][c] - x[b][c];
      const double variance = difference * difference / (2 * r) / pairs.size();
      squares.expected += variance * f;
      weight[c] += f / pairs.size();
      doubt += variance * 2 * std::abs(guess.value) * f * f * std::sqrt(guess.doubt);
    }
  }
  doubt *= shared_doubt;
  squares.variance = variance_of_squares(x, weight) + doubt * doubt;
  return squares;
}

Squares absolute_squares(const Noise& noise) {
  Squares squares;
  for (const double variance : noise.variance) squares.expected += variance / r;
  squares.variance = variance_of_squares(noise.replicates, {1, 1, 1});
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
        relative[y] += relative_squares(noise, neighbours_of(x, y), dark_);
        absolute[y] += absolute_squares(noise);
      }
    });
    ErrorEstimate result;
    result.known = true;
    result.relative = band_of(relative, untold_share);
    result.absolute = band_of(absolute, 0);
    return result;
  }

  std::vector<double> squared_errors() {
    if (noise_.empty() || !gather()) return {};
    find_dark_level();
    std::vector<double> errors(noise_.size());
    pool_.for_each(height_, [&](std::size_t y, unsigned) {
      for (std::size_t x = 0; x < width_; ++x) {
        const std::size_t i = y * width_ + x;
        errors[i] = relative_squares(noise_[i], neighbours_of(x, y), dark_).expected;
      }
    });
    return errors;
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
        noise_[i] = noise_of(*means);
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

  [[nodiscard]] Neighbours neighbours_of(std::size_t x, std::size_t y) const {
    constexpr std::size_t reach = neighbour_radius;
    const Noise& own = noise_[y * width_ + x];
    Neighbours found;
    for (std::size_t ny = y - std::min(y, reach); ny < std::min(y + reach + 1, height_); ++ny) {
      for (std::size_t nx = x - std::min(x, reach); nx < std::min(x + reach + 1, width_); ++nx) {
        const Noise& other = noise_[ny * width_ + nx];
        if (&other == &own) continue;
        ++found.all;
        const bool alike = are_alike(own, other);
        found.alike += alike ? 1 : 0;
        for (std::size_t c = 0; c < 3; ++c) {
          found.variance_of_all[c] += other.variance[c];
          if (!alike) continue;
          found.sum[c] += other.mean[c];
          found.squares[c] += other.mean[c] * other.mean[c];
          found.variance[c] += other.variance[c];
        }
      }
    }
    return found;
  }

  [[nodiscard]] ErrorBand band_of(const std::vector<Squares>& rows, double untold) const {
    Squares sum;
    for (const Squares& row : rows) sum += row;
    const double values = 3 * static_cast<double>(noise_.size());
    const double half =
        std::hypot(quantile * std::sqrt(std::max(0.0, sum.variance)), untold * sum.expected);
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

std::vector<double> squared_errors_of(const Film& film, ThreadPool& pool) {
  return Estimator(film, pool).squared_errors();
}

}  // namespace scenec::backend
