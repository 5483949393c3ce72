// How much two pictures differ; used by tests and by the commands that compare renders.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "backend/image/image.hpp"

namespace scenec::backend {

struct ImageDifference {
  double largest = 0;  // of the absolute differences
  double rmse = 0;
  // mean((I-R)^2 / (R^2 + e)), e = 0.01 * (mean luminance of the reference)^2; the square root of
  // this is the language's `error`.
  double rel_mse = 0;
  std::size_t differing = 0;  // samples that are not equal
};

// Precondition: equal size and channels. Samples where either is not finite count as differing and
// make the figures infinite. Luminance is Rec. 709 for three or more channels, else the first
// channel's; a fourth channel (alpha) enters the figures like any other.
[[nodiscard]] ImageDifference difference_of(const FloatImage& image, const FloatImage& reference);

struct ByteDifference {
  std::size_t differing = 0;
  int largest = 0;
};
// Precondition: equal length.
[[nodiscard]] ByteDifference difference_of(std::span<const std::uint8_t> a,
                                           std::span<const std::uint8_t> b);

}  // namespace scenec::backend
