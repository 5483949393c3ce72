#include "backend/film/agreement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "backend/math/student.hpp"
#include "base/assert.hpp"

namespace scenec::backend {
namespace {

constexpr double proof = -std::numeric_limits<double>::infinity();
constexpr double freedom_of_pixel = 3;  // variances of four replicates
constexpr std::size_t worst_kept = 8;

double value(float v) {
  return static_cast<double>(v);
}

std::vector<float> contrast_of(const NoisyPicture& p) {
  std::vector<float> result(p.rgb.size());
  for (std::size_t y = 0; y < p.height; ++y) {
    for (std::size_t x = 0; x < p.width; ++x) {
      for (std::size_t c = 0; c < 3; ++c) {
        const float own = p.rgb[3 * (y * p.width + x) + c];
        float largest = 0;
        for (std::size_t v = y - std::min<std::size_t>(y, 1); v < std::min(p.height, y + 2); ++v)
          for (std::size_t u = x - std::min<std::size_t>(x, 1); u < std::min(p.width, x + 2); ++u)
            largest = std::max(largest, std::abs(p.rgb[3 * (v * p.width + u) + c] - own));
        result[3 * (y * p.width + x) + c] = largest;
      }
    }
  }
  return result;
}

// Variances of a picture's pixels, one sample that was not met included.
std::vector<double> careful_variance(const NoisyPicture& p) {
  const std::vector<float> contrast = p.contrast.empty() ? contrast_of(p) : p.contrast;
  std::vector<double> result(p.rgb.size());
  for (std::size_t i = 0; i < result.size(); ++i) {
    const double one = value(contrast[i]) / p.samples;
    result[i] = value(p.variance[i]) + one * one;
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

void keep(Agreement& all, const Disagreement& one) {
  if (!(one.log_p < 0)) return;
  const auto place = std::upper_bound(
      all.worst.begin(), all.worst.end(), one,
      [](const Disagreement& x, const Disagreement& y) { return x.log_p < y.log_p; });
  if (all.worst.size() == worst_kept && place == all.worst.end()) return;
  all.worst.insert(place, one);
  if (all.worst.size() > worst_kept) all.worst.pop_back();
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

  [[nodiscard]] Disagreement test(const ir::Region& place, std::size_t channel) const {
    Sums s;
    for (std::int64_t y = place.y0; y < place.y1; ++y)
      for (std::int64_t x = place.x0; x < place.x1; ++x)
        add(s,
            3 * (static_cast<std::size_t>(y) * a_.width + static_cast<std::size_t>(x)) + channel);
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
  void add(Sums& s, std::size_t i) const {
    const double a = value(a_.rgb[i]);
    const double b = value(b_.rgb[i]);
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

// How much nine pixels differ among themselves.
double spread_of(const NoisyPicture& p, std::size_t x0, std::size_t y0) {
  double spread = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    double sum = 0;
    double squares = 0;
    for (std::size_t y = y0; y < y0 + 3; ++y) {
      for (std::size_t x = x0; x < x0 + 3; ++x) {
        const double v = value(p.rgb[3 * (y * p.width + x) + c]);
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

double median_around(const NoisyPicture& p, std::size_t x, std::size_t y, std::size_t c) {
  std::array<float, 9> around{};
  std::size_t count = 0;
  for (std::size_t v = y - std::min<std::size_t>(y, 1); v < std::min(p.height, y + 2); ++v)
    for (std::size_t u = x - std::min<std::size_t>(x, 1); u < std::min(p.width, x + 2); ++u)
      around[count++] = p.rgb[3 * (v * p.width + u) + c];
  const auto middle = around.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(around.begin(), middle, around.begin() + static_cast<std::ptrdiff_t>(count));
  return value(*middle);
}

}  // namespace

void look_at_contrast(NoisyPicture& picture) {
  picture.contrast = contrast_of(picture);
}

NoisyPicture noisy_picture_of(const Picture& picture) {
  NoisyPicture result;
  result.width = static_cast<std::size_t>(picture.width);
  result.height = static_cast<std::size_t>(picture.height);
  result.samples = static_cast<double>(std::max<std::int64_t>(1, picture.samples));
  result.rgb = picture.rgb;
  SCENEC_ASSERT(picture.rgb.size() == 3 * result.width * result.height);
  result.variance.resize(picture.rgb.size());
  constexpr std::array<std::string_view, 3> names{"variance.R", "variance.G", "variance.B"};
  for (const auto& [name, values] : picture.layers) {
    const auto c =
        static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
    if (c == names.size()) continue;
    for (std::size_t i = 0; i < values.size(); ++i) result.variance[3 * i + c] = values[i];
  }
  return result;
}

NoisyPicture part_of(const NoisyPicture& picture, const ir::Region& part) {
  NoisyPicture result{static_cast<std::size_t>(part.x1 - part.x0),
                      static_cast<std::size_t>(part.y1 - part.y0),
                      picture.samples,
                      {},
                      {},
                      picture.rounding,
                      {}};
  const std::size_t row = 3 * result.width;
  for (std::int64_t y = part.y0; y < part.y1; ++y) {
    const auto at = static_cast<std::ptrdiff_t>(
        3 * (static_cast<std::size_t>(y) * picture.width + static_cast<std::size_t>(part.x0)));
    const auto end = at + static_cast<std::ptrdiff_t>(row);
    const auto take = [&](std::vector<float>& to, const std::vector<float>& whole) {
      if (!whole.empty()) to.insert(to.end(), whole.begin() + at, whole.begin() + end);
    };
    take(result.rgb, picture.rgb);
    take(result.variance, picture.variance);
    take(result.contrast, picture.contrast);
  }
  return result;
}

void join(Agreement& all, const Agreement& other, std::int64_t x, std::int64_t y) {
  all.tests += other.tests;
  for (Disagreement one : other.worst) {
    one.place.x0 += x;
    one.place.x1 += x;
    one.place.y0 += y;
    one.place.y1 += y;
    keep(all, one);
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
        keep(all, blocks.test({x, y, end(x, a.width), end(y, a.height)}, channel));
      }
    }
  }
  all.log_p = corrected(all);
  return all;
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
      const double f = value(picture.rgb[i]);
      // Weighted by b, the picture is held against c, and the other way round.
      difference += wb[i] * (f - value(c.rgb[i])) + wc[i] * (f - value(b.rgb[i]));
      rounding += (wb[i] + wc[i]) * std::abs(f) * picture.rounding;
      const double weight = wb[i] + wc[i];
      for (const double part :
           {weight * weight * vp[i], wb[i] * wb[i] * vc[i], wc[i] * wc[i] * vb[i]}) {
        variance += part;
        squares += part * part;
      }
      first += f;
      second += (value(b.rgb[i]) + value(c.rgb[i])) / 2;
    }
    Disagreement one = judge(difference, rounding, variance, squares);
    one.place = {0, 0, static_cast<std::int64_t>(picture.width),
                 static_cast<std::int64_t>(picture.height)};
    one.channel = channel;
    const auto pixels = static_cast<double>(picture.rgb.size()) / 3;
    one.first = first / pixels;
    one.second = second / pixels;
    ++all.tests;
    keep(all, one);
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
            mean += value(p.rgb[i]);
            variance += value(p.variance[i]);
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

void add_mirrored(MirroredSums& sums, const NoisyPicture& a, const NoisyPicture& b,
                  const std::vector<double>& weights) {
  SCENEC_ASSERT(a.rgb.size() == b.rgb.size() && a.rgb.size() == weights.size());
  for (std::size_t i = 0; i + 2 < a.rgb.size(); i += 3) {
    double noise_a = 0;
    double noise_b = 0;
    for (std::size_t c = i; c < i + 3; ++c) {
      const double difference = weights[c] * (value(a.rgb[c]) - value(b.rgb[c]));
      sums.difference[c - i] += difference;
      sums.squares[c - i] += difference * difference;
      noise_a += value(a.variance[c]);
      noise_b += value(b.variance[c]);
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
    return value(p.rgb[i]) + value(p.rgb[i + 1]) + value(p.rgb[i + 2]);
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

void guess_variance(NoisyPicture& picture, const NoisyPicture& own) {
  SCENEC_ASSERT(picture.rgb.size() == own.rgb.size());
  picture.variance.resize(picture.rgb.size());
  for (std::size_t i = 0; i < picture.rgb.size(); ++i) {
    const std::size_t pixel = i / 3;
    const double off = value(picture.rgb[i]) -
                       median_around(picture, pixel % picture.width, pixel / picture.width, i % 3);
    picture.variance[i] = static_cast<float>(
        std::max(value(own.variance[i]) * own.samples / picture.samples, off * off));
  }
}

}  // namespace scenec::backend
