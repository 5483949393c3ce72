#include "backend/film/agreement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "backend/math/student.hpp"
#include "base/assert.hpp"

namespace scenec::backend {
namespace {

constexpr double proof = -std::numeric_limits<double>::infinity();
constexpr double freedom_of_pixel = 3;  // variances of four replicates
constexpr std::size_t worst_kept = 8;
// Squared deviations; more than that is as likely one rare bright sample.
constexpr double most_suspicion = 16;

// Variances of a picture's pixels, one sample that was not met included.
std::vector<double> careful_variance(const NoisyPicture& p) {
  const std::vector<float> contrast = p.contrast.empty() ? contrast_of(p) : p.contrast;
  std::vector<double> result(p.rgb.size());
  for (std::size_t i = 0; i < result.size(); ++i) {
    const double one = double{contrast[i]} / p.samples;
    result[i] = double{p.variance[i]} + one * one;
  }
  return result;
}

// Sums over the pixels of a block that a test needs.
struct Sums {
  double a = 0, b = 0;
  double rounding = 0;
  double apart = 0, apart_squares = 0;    // variances of either picture, and their squares
  double pooled = 0, pooled_squares = 0;  // what both say of one sample, for either
  std::size_t pixels = 0;
};

// The test of one sum of differences against its variance.
Disagreement judge(double difference, double rounding, double variance, double squares) {
  Disagreement result;
  if (!std::isfinite(difference) || !std::isfinite(variance)) {
    result.deviations = std::numeric_limits<double>::infinity();
    result.log_p = proof;
    return result;
  }
  const double beyond = std::abs(difference) - rounding;
  if (!(beyond > 0)) return result;
  if (!(variance > 0) || !(squares > 0)) {
    result.deviations = std::numeric_limits<double>::infinity();
    result.log_p = proof;
    return result;
  }
  result.deviations = beyond / std::sqrt(variance);
  result.log_p =
      log_student_tail(result.deviations, freedom_of_pixel * variance / squares * variance);
  return result;
}

// The worst place's log p for as many tests as were made.
double corrected(const Agreement& all) {
  if (all.worst.empty()) return 0;
  return std::min(0.0, all.worst.front().log_p + std::log(static_cast<double>(all.tests)));
}

class BlockTests {
 public:
  BlockTests(const NoisyPicture& a, const NoisyPicture& b)
      : a_(a), b_(b), va_(careful_variance(a)), vb_(careful_variance(b)) {}

  [[nodiscard]] double suspicion(const ir::Region& place) const {
    double sum = 0;
    for (std::int64_t y = place.y0; y < place.y1; ++y)
      for (std::int64_t x = place.x0; x < place.x1; ++x)
        sum += std::min(most_suspicion, squared_deviations(x, y));
    return sum / static_cast<double>((place.y1 - place.y0) * (place.x1 - place.x0));
  }

  [[nodiscard]] Disagreement test(const ir::Region& place, std::size_t channel) const {
    Sums s;
    for (std::int64_t y = place.y0; y < place.y1; ++y)
      for (std::int64_t x = place.x0; x < place.x1; ++x) add(s, at(x, y) + channel);
    const bool pooled = s.pooled > s.apart;
    Disagreement result = judge(s.a - s.b, s.rounding, pooled ? s.pooled : s.apart,
                                pooled ? s.pooled_squares : s.apart_squares);
    result.place = place;
    result.channel = channel;
    result.first = s.a / static_cast<double>(s.pixels);
    result.second = s.b / static_cast<double>(s.pixels);
    return result;
  }

 private:
  [[nodiscard]] std::size_t at(std::int64_t x, std::int64_t y) const {
    return 3 * (static_cast<std::size_t>(y) * a_.width + static_cast<std::size_t>(x));
  }

  [[nodiscard]] double squared_deviations(std::int64_t x, std::int64_t y) const {
    double sum = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t i = at(x, y) + c;
      const double off = double{a_.rgb[i]} - double{b_.rgb[i]};
      const double variance = va_[i] + vb_[i];
      if (variance > 0)
        sum += off * off / variance / 3;
      else if (off != 0)
        sum += most_suspicion;
    }
    return sum;
  }

  void add(Sums& s, std::size_t i) const {
    const double a = double{a_.rgb[i]};
    const double b = double{b_.rgb[i]};
    s.a += a;
    s.b += b;
    s.rounding += std::abs(a) * a_.rounding + std::abs(b) * b_.rounding;
    s.apart += va_[i] + vb_[i];
    s.apart_squares += va_[i] * va_[i] + vb_[i] * vb_[i];
    const double pa = va_[i] * a_.samples / b_.samples;
    const double pb = vb_[i] * b_.samples / a_.samples;
    s.pooled += pa + pb;
    s.pooled_squares += pa * pa + pb * pb;
    ++s.pixels;
  }

  const NoisyPicture& a_;
  const NoisyPicture& b_;
  std::vector<double> va_;
  std::vector<double> vb_;
};

// Starts of blocks of `side` that lie whole inside `size`, the last one at its end.
std::vector<std::int64_t> starts(std::size_t size, std::size_t side) {
  std::vector<std::int64_t> result;
  const std::size_t step = std::max<std::size_t>(1, side / 2);
  for (std::size_t at = 0; at + side < size; at += step)
    result.push_back(static_cast<std::int64_t>(at));
  result.push_back(static_cast<std::int64_t>(size - std::min(size, side)));
  return result;
}

// The share of the mean below which noise is not told apart: it keeps pixels without any from
// drowning the others; they speak for themselves in the blocks.
constexpr double least_noise = 0.002;

}  // namespace

void add_finding(Agreement& all, const Disagreement& one) {
  if (!(one.log_p < 0)) return;
  const auto place = std::upper_bound(
      all.worst.begin(), all.worst.end(), one,
      [](const Disagreement& x, const Disagreement& y) { return x.log_p < y.log_p; });
  if (all.worst.size() == worst_kept && place == all.worst.end()) return;
  all.worst.insert(place, one);
  if (all.worst.size() > worst_kept) all.worst.pop_back();
}

void join(Agreement& all, const Agreement& other, std::int64_t x, std::int64_t y) {
  all.tests += other.tests;
  for (Disagreement one : other.worst) {
    one.place.x0 += x;
    one.place.x1 += x;
    one.place.y0 += y;
    one.place.y1 += y;
    add_finding(all, one);
  }
  all.log_p = corrected(all);
}

Agreement compare_blocks(const NoisyPicture& a, const NoisyPicture& b, std::size_t side) {
  SCENEC_ASSERT(a.width == b.width && a.height == b.height && side > 0);
  Agreement all;
  const BlockTests blocks(a, b);
  for (const std::int64_t y : starts(a.height, side)) {
    for (const std::int64_t x : starts(a.width, side)) {
      const auto end = [&](std::int64_t at, std::size_t size) {
        return std::min(at + static_cast<std::int64_t>(side), static_cast<std::int64_t>(size));
      };
      for (std::size_t channel = 0; channel < 3; ++channel) {
        ++all.tests;
        add_finding(all, blocks.test({x, y, end(x, a.width), end(y, a.height)}, channel));
      }
    }
  }
  all.log_p = corrected(all);
  return all;
}

std::vector<double> suspicions_of(const NoisyPicture& a, const NoisyPicture& b,
                                  const std::vector<ir::Region>& places) {
  const BlockTests blocks(a, b);
  std::vector<double> result;
  for (const ir::Region& place : places) result.push_back(blocks.suspicion(place));
  return result;
}

Agreement compare_brightness(const NoisyPicture& picture, const NoisyPicture& b,
                             const NoisyPicture& c) {
  const std::vector<double> wb = brightness_weights(b);
  const std::vector<double> wc = brightness_weights(c);
  const std::vector<double> vp = careful_variance(picture);
  const std::vector<double> vb = careful_variance(b);
  const std::vector<double> vc = careful_variance(c);
  Agreement all;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    double difference = 0;
    double rounding = 0;
    double variance = 0;
    double squares = 0;
    double first = 0;
    double second = 0;
    for (std::size_t i = channel; i < picture.rgb.size(); i += 3) {
      const double f = double{picture.rgb[i]};
      // Weighted by b, the picture is held against c, and the other way round.
      difference += wb[i] * (f - double{c.rgb[i]}) + wc[i] * (f - double{b.rgb[i]});
      rounding += (wb[i] + wc[i]) * std::abs(f) * picture.rounding;
      const double weight = wb[i] + wc[i];
      for (const double part :
           {weight * weight * vp[i], wb[i] * wb[i] * vc[i], wc[i] * wc[i] * vb[i]}) {
        variance += part;
        squares += part * part;
      }
      first += f;
      second += (double{b.rgb[i]} + double{c.rgb[i]}) / 2;
    }
    Disagreement one = judge(difference, rounding, variance, squares);
    one.place = {0, 0, static_cast<std::int64_t>(picture.width),
                 static_cast<std::int64_t>(picture.height)};
    one.channel = channel;
    const auto pixels = static_cast<double>(picture.rgb.size()) / 3;
    one.first = first / pixels;
    one.second = second / pixels;
    ++all.tests;
    add_finding(all, one);
  }
  all.log_p = corrected(all);
  return all;
}

std::vector<double> brightness_weights(const NoisyPicture& p) {
  constexpr std::size_t radius = 2;
  std::vector<double> result(p.rgb.size());
  for (std::size_t y = 0; y < p.height; ++y) {
    for (std::size_t x = 0; x < p.width; ++x) {
      for (std::size_t c = 0; c < 3; ++c) {
        double mean = 0;
        double variance = 0;
        double pixels = 0;
        for (std::size_t v = y - std::min(y, radius); v < std::min(p.height, y + radius + 1); ++v) {
          for (std::size_t u = x - std::min(x, radius); u < std::min(p.width, x + radius + 1);
               ++u) {
            const std::size_t i = 3 * (v * p.width + u) + c;
            mean += double{p.rgb[i]};
            variance += double{p.variance[i]};
            ++pixels;
          }
        }
        mean /= pixels;
        const double floor = least_noise * mean;
        const double noise = variance / pixels + floor * floor;
        result[3 * (y * p.width + x) + c] = noise > 0 ? mean / noise : 0;
      }
    }
  }
  return result;
}

}  // namespace scenec::backend
