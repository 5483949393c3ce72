#include "backend/image/compare.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/assert.hpp"

namespace scenec::backend {
namespace {

double mean_luminance(const FloatImage& image) {
  const std::size_t channels = image.channels;
  double sum = 0;
  for (std::size_t i = 0; i + channels <= image.samples.size(); i += channels) {
    const float* pixel = &image.samples[i];
    sum += channels < 3
               ? static_cast<double>(pixel[0])
               : 0.2126 * static_cast<double>(pixel[0]) + 0.7152 * static_cast<double>(pixel[1]) +
                     0.0722 * static_cast<double>(pixel[2]);
  }
  return sum * static_cast<double>(channels) / static_cast<double>(image.samples.size());
}

}  // namespace

ImageDifference difference_of(const FloatImage& image, const FloatImage& reference) {
  SCENEC_ASSERT(image.width == reference.width && image.height == reference.height);
  SCENEC_ASSERT(image.channels == reference.channels);
  SCENEC_ASSERT(image.samples.size() == reference.samples.size());
  ImageDifference result;
  if (image.samples.empty()) return result;
  const double mean = mean_luminance(reference);
  const double floor = 0.01 * mean * mean;
  double squares = 0;
  double relative = 0;
  bool finite = true;
  for (std::size_t i = 0; i < image.samples.size(); ++i) {
    const double r = static_cast<double>(reference.samples[i]);
    const double d = static_cast<double>(image.samples[i]) - r;
    if (d == 0) continue;
    ++result.differing;
    if (!std::isfinite(d)) finite = false;
    result.largest = std::max(result.largest, std::abs(d));
    squares += d * d;
    relative += d * d / (r * r + floor);
  }
  const double count = static_cast<double>(image.samples.size());
  result.rmse = std::sqrt(squares / count);
  result.rel_mse = relative / count;
  if (!finite) {
    result.largest = result.rmse = result.rel_mse = std::numeric_limits<double>::infinity();
  }
  return result;
}

ByteDifference difference_of(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b) {
  SCENEC_ASSERT(a.size() == b.size());
  ByteDifference result;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const int difference = std::abs(int{a[i]} - int{b[i]});
    result.differing += difference != 0 ? 1 : 0;
    result.largest = std::max(result.largest, difference);
  }
  return result;
}

}  // namespace scenec::backend
