#include "backend/film/lineup.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/assert.hpp"

namespace scenec::backend {
namespace {

// What the ranks weigh, first the outermost; they sum to 1. Most on the outermost: a pixel that was
// changed by several times its noise lies beyond all peers. The others are for one that has a rare
// bright sample among its peers.
constexpr std::array<double, 3> rank_weights{0.8, 0.1, 0.1};
constexpr std::array<double, 3> luminance_parts{0.2126, 0.7152, 0.0722};
// Parts of the cells that are believed to be changed: one cell, four, sixteen, ... up to this.
constexpr double largest_part = 0.5;
constexpr double part_step = 4;

double finite(float v) {
  return std::isfinite(v) ? static_cast<double>(v)
                          : static_cast<double>(std::numeric_limits<float>::max());
}

// The values of one pixel, the suspect's first.
using Values = std::vector<double>;

// Of the suspect's value by its rank from above; equal values share their ranks.
double evidence_of_rank(const Values& values) {
  std::size_t above = 0;
  std::size_t same = 0;
  for (const double v : values) {
    above += v > values[0] ? 1U : 0U;
    same += v == values[0] ? 1U : 0U;
  }
  double weight = 0;
  for (std::size_t rank = above; rank < std::min(above + same, rank_weights.size()); ++rank)
    weight += rank_weights[rank];
  return static_cast<double>(values.size()) * weight / static_cast<double>(same);
}

double middle_of(Values values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Differences from the middle value; what rounding explains is 0. The same for any order of values.
Values differences(const Values& values, double rounding) {
  const double middle = middle_of(values);
  Values result(values.size());
  for (std::size_t k = 0; k < values.size(); ++k) {
    const double off = values[k] - middle;
    const double nothing = rounding * (std::abs(values[k]) + std::abs(middle));
    result[k] = std::abs(off) > nothing ? off : 0;
  }
  return result;
}

// Evidence of one pixel, by each way to rank.
constexpr std::size_t ways = 3;
std::array<double, ways> evidence_of_pixel(const std::array<Values, 3>& channels, double rounding) {
  const std::size_t count = channels[0].size();
  Values up(count);
  Values down(count);
  Values away(count);
  for (std::size_t c = 0; c < 3; ++c) {
    const Values off = differences(channels[c], rounding);
    double scale = 0;
    for (const double v : off) scale += std::abs(v) / static_cast<double>(count);
    for (std::size_t k = 0; k < count; ++k) {
      up[k] += luminance_parts[c] * off[k];
      if (scale > 0) away[k] += std::abs(off[k]) / scale;
    }
  }
  for (std::size_t k = 0; k < count; ++k) down[k] = -up[k];
  return {evidence_of_rank(up), evidence_of_rank(down), evidence_of_rank(away)};
}

// Of the pixels [x0, x1) x [y0, y1).
class Halves {
 public:
  Halves(const std::vector<double>& pixels, std::size_t width) : pixels_(pixels), width_(width) {}

  [[nodiscard]] double evidence(std::size_t x0, std::size_t y0, std::size_t x1,
                                std::size_t y1) const {
    const std::size_t w = x1 - x0;
    const std::size_t h = y1 - y0;
    if (w == 1 && h == 1) return pixels_[y0 * width_ + x0];
    const bool is_wide = w > h;
    const std::size_t x = is_wide ? x0 + w / 2 : x1;
    const std::size_t y = is_wide ? y1 : y0 + h / 2;
    const double first = evidence(x0, y0, x, y);
    const double second = evidence(is_wide ? x : x0, is_wide ? y0 : y, x1, y1);
    return (first + second) / 4 + first * second / 2;
  }

 private:
  const std::vector<double>& pixels_;
  std::size_t width_;
};

double log_sum(double a, double b) {
  const double larger = std::max(a, b);
  return larger + std::log1p(std::exp(std::min(a, b) - larger));
}

}  // namespace

double evidence_against(std::span<const float> suspect,
                        const std::vector<std::vector<float>>& peers, std::size_t width,
                        double rounding) {
  SCENEC_ASSERT(width > 0 && suspect.size() % (3 * width) == 0);
  const std::size_t pixels = suspect.size() / 3;
  std::array<std::vector<double>, ways> evidence;
  for (auto& one : evidence) one.resize(pixels);
  std::array<Values, 3> channels;
  for (auto& values : channels) values.resize(peers.size() + 1);
  for (std::size_t i = 0; i < pixels; ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      channels[c][0] = finite(suspect[3 * i + c]);
      for (std::size_t k = 0; k < peers.size(); ++k)
        channels[c][k + 1] = finite(peers[k][3 * i + c]);
    }
    const auto here = evidence_of_pixel(channels, rounding);
    for (std::size_t way = 0; way < ways; ++way) evidence[way][i] = here[way];
  }
  double sum = 0;
  for (const auto& one : evidence) sum += Halves(one, width).evidence(0, 0, width, pixels / width);
  return sum / ways;
}

double log_p_of_evidence(const std::vector<double>& evidence, std::size_t cells) {
  SCENEC_ASSERT(evidence.size() <= cells);
  if (evidence.empty()) return 0;
  const auto unseen = static_cast<double>(cells - evidence.size());
  double all = -std::numeric_limits<double>::infinity();
  double parts = 0;
  for (double part = 1 / static_cast<double>(cells); part <= largest_part; part *= part_step) {
    double log_evidence = unseen * std::log1p(-part);
    for (const double one : evidence) log_evidence += std::log1p(part * (one - 1));
    all = parts > 0 ? log_sum(all, log_evidence) : log_evidence;
    ++parts;
  }
  return parts > 0 ? std::min(0.0, std::log(parts) - all) : std::min(0.0, -std::log(evidence[0]));
}

}  // namespace scenec::backend
