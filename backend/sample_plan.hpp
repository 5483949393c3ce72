// Adaptive sampling: how many samples the pixels of each tile get, more where the error is.
//
// Domain:     any tiles; errors finite and at least 0.
// Method:     Sixteen samples everywhere; from there on stages, each with half as many samples as
//             all before. At a stage's start the tiles' counts at its end are set so that the mean
//             of v / (R^2 + e) becomes least: in proportion to the root of what one more sample of
//             a tile's pixels is worth, taken over its neighbours too and held between fixed parts
//             of the mean, but never fewer than a tile has. Counts are multiples of the replicates.
// Error:      The sum of a tile's counts is that of the plan within one step a tile. What a pixel
//             got decides how many samples follow, so its mean is off by a part of order 1/n of its
//             own noise, spread over a tile and its neighbours; figures in docs/accuracy.md.
// Degenerate: no errors known, or none at all: every tile gets the same.
// Proof:      tests/unit/backend/sample_plan_test.cpp.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace scenec::backend {

// How the samples of a picture are dealt out to its pixels.
enum class SampleSpread : std::uint8_t { even, adaptive };

// Counts are a function of the mean number of samples and of the errors at the starts of stages, so
// rounds may end anywhere.
class SamplePlan {
 public:
  // `pixels`: of each tile, row by row, `tiles_x` a row.
  SamplePlan(std::vector<std::int64_t> pixels, std::size_t tiles_x);

  // Samples of a tile's pixels when the picture has `samples` a pixel on average, up to
  // stage_end().
  [[nodiscard]] std::int64_t count(std::size_t tile, std::int64_t samples) const;
  [[nodiscard]] std::int64_t stage_end() const { return end_; }
  // Begins the next stage where the last one ended. `squared_errors`: the sum over each tile's
  // pixels; empty: not known.
  void next_stage(std::span<const double> squared_errors);

  [[nodiscard]] std::string save() const;
  // False, and nothing changed, when the bytes are of no plan of these tiles.
  [[nodiscard]] bool restore(std::string_view bytes);

 private:
  [[nodiscard]] std::vector<double> shares_of(std::span<const double> squared_errors) const;

  std::vector<std::int64_t> pixels_;
  std::size_t tiles_x_;
  std::int64_t begin_ = 0;
  std::int64_t end_;
  std::vector<std::int64_t> counts_at_begin_;
  std::vector<std::int64_t> counts_at_end_;
};

}  // namespace scenec::backend
