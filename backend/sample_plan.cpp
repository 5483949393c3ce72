#include "backend/sample_plan.hpp"

#include <algorithm>
#include <cmath>

#include "backend/film/replicates.hpp"
#include "base/packed_bytes.hpp"

namespace scenec::backend {
namespace {

// Whole rounds of the replicates, so that they stay alike.
constexpr auto step = static_cast<std::int64_t>(replicate_count);
constexpr std::int64_t pilot = 16;
// Light that a tile has not found yet must be found some day, and one bright sample must not take
// all samples to come: parts of the mean a tile's share is held between.
constexpr double least_share = 0.2;
constexpr double largest_share = 8;

std::int64_t whole_steps(double samples) {
  return static_cast<std::int64_t>(std::floor(samples / step)) * step;
}

}  // namespace

SamplePlan::SamplePlan(std::vector<std::int64_t> pixels, std::size_t tiles_x)
    : pixels_(std::move(pixels)),
      tiles_x_(tiles_x),
      end_(pilot),
      counts_at_begin_(pixels_.size(), 0),
      counts_at_end_(pixels_.size(), pilot) {}

std::int64_t SamplePlan::count(std::size_t tile, std::int64_t samples) const {
  if (samples >= end_) return counts_at_end_[tile];
  if (begin_ == 0) return samples;
  const double part = static_cast<double>(samples - begin_) / static_cast<double>(end_ - begin_);
  const auto more = static_cast<double>(counts_at_end_[tile] - counts_at_begin_[tile]);
  return counts_at_begin_[tile] + whole_steps(part * more);
}

// In proportion to what a tile's pixels should have: the root of the error of one sample.
std::vector<double> SamplePlan::shares_of(std::span<const double> squared_errors) const {
  const std::size_t tiles = pixels_.size();
  std::vector<double> shares(tiles, 1);
  if (squared_errors.empty()) return shares;
  const std::size_t tiles_y = tiles / tiles_x_;
  double sum = 0;
  for (std::size_t y = 0; y < tiles_y; ++y) {
    for (std::size_t x = 0; x < tiles_x_; ++x) {
      double worth = 0;
      double weights = 0;
      for (std::size_t ny = y - std::min<std::size_t>(y, 1); ny < std::min(y + 2, tiles_y); ++ny) {
        for (std::size_t nx = x - std::min<std::size_t>(x, 1); nx < std::min(x + 2, tiles_x_);
             ++nx) {
          const std::size_t i = ny * tiles_x_ + nx;
          const double weight = (ny == y ? 2 : 1) * (nx == x ? 2 : 1);
          weights += weight * static_cast<double>(pixels_[i]);
          worth += weight * squared_errors[i] * static_cast<double>(counts_at_end_[i]);
        }
      }
      const std::size_t i = y * tiles_x_ + x;
      shares[i] = weights > 0 ? std::sqrt(worth / weights) : 0;
      sum += shares[i];
    }
  }
  const double mean = sum / static_cast<double>(tiles);
  for (double& share : shares)
    share = mean > 0 ? std::clamp(share / mean, least_share, largest_share) : 1;
  return shares;
}

void SamplePlan::next_stage(std::span<const double> squared_errors) {
  const std::vector<double> shares = shares_of(squared_errors);
  counts_at_begin_ = counts_at_end_;
  begin_ = end_;
  end_ += std::max(2 * step, begin_ / 2 / step * step);
  double pixels = 0;
  for (const std::int64_t n : pixels_) pixels += static_cast<double>(n);
  const double wanted = pixels * static_cast<double>(end_);
  const auto samples_at = [&](double level) {
    double sum = 0;
    for (std::size_t i = 0; i < shares.size(); ++i)
      sum += static_cast<double>(pixels_[i]) *
             std::max(level * shares[i], static_cast<double>(counts_at_begin_[i]));
    return sum;
  };
  // The level at which the shares take up all samples (from above, so that whole numbers stay
  // whole): tiles that have more already keep them.
  double low = 0;
  double high = static_cast<double>(end_) / least_share;
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = (low + high) / 2;
    (samples_at(middle) < wanted ? low : high) = middle;
  }
  // What rounding down leaves goes to the next tile.
  double left = 0;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const auto size = static_cast<double>(pixels_[i]);
    const double exact = std::max(high * shares[i], static_cast<double>(counts_at_begin_[i]));
    const std::int64_t fitting =
        std::min(whole_steps(exact + left / size), whole_steps(exact) + step);
    const std::int64_t count = std::max(counts_at_begin_[i], fitting);
    left += size * (exact - static_cast<double>(count));
    counts_at_end_[i] = count;
  }
}

std::string SamplePlan::save() const {
  std::string out;
  append_packed(out, begin_);
  append_packed(out, end_);
  out += packed_bytes_of(counts_at_begin_);
  out += packed_bytes_of(counts_at_end_);
  return out;
}

bool SamplePlan::restore(std::string_view bytes) {
  PackedReader reader(bytes);
  const auto begin = reader.value<std::int64_t>();
  const auto end = reader.value<std::int64_t>();
  auto at_begin = reader.list<std::vector<std::int64_t>>(pixels_.size());
  auto at_end = reader.list<std::vector<std::int64_t>>(pixels_.size());
  if (!reader.at_end() || begin < 0 || end <= begin) return false;
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    if (at_begin[i] < 0 || at_end[i] < at_begin[i]) return false;
  }
  begin_ = begin;
  end_ = end;
  counts_at_begin_ = std::move(at_begin);
  counts_at_end_ = std::move(at_end);
  return true;
}

}  // namespace scenec::backend
