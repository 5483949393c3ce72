// The error of a picture against the mean of many others of its scene, whose own variance is
// subtracted.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace scenec::test {

// Mean picture of many renders, with the variance of that mean.
struct Reference {
  std::vector<double> sum;
  std::vector<double> squares;
  double count = 0;

  void add(const std::vector<float>& rgb) {
    sum.resize(rgb.size());
    squares.resize(rgb.size());
    for (std::size_t i = 0; i < rgb.size(); ++i) {
      const double value = static_cast<double>(rgb[i]);
      sum[i] += value;
      squares[i] += value * value;
    }
    count += 1;
  }
};

// The language's error of a picture against the reference, `own` telling whether the picture is one
// of those the reference was made from; and the RMSE.
struct TrueError {
  double error = 0;
  double rmse = 0;
};
inline TrueError true_error(const std::vector<float>& rgb, const Reference& reference, bool own) {
  const double n = own ? reference.count - 1 : reference.count;
  std::vector<double> mean(rgb.size());
  double luminance = 0;
  for (std::size_t i = 0; i < rgb.size(); ++i) {
    mean[i] = (reference.sum[i] - (own ? static_cast<double>(rgb[i]) : 0)) / n;
    constexpr double parts[3] = {0.2126, 0.7152, 0.0722};
    luminance += parts[i % 3] * mean[i];
  }
  luminance /= static_cast<double>(rgb.size()) / 3;
  const double dark = 0.01 * luminance * luminance;
  double error = 0;
  double squares = 0;
  for (std::size_t i = 0; i < rgb.size(); ++i) {
    const double all = reference.sum[i] / reference.count;
    const double variance = std::max(0.0, reference.squares[i] / reference.count - all * all) *
                            reference.count / (reference.count - 1) / n;
    const double difference = static_cast<double>(rgb[i]) - mean[i];
    const double scale = mean[i] * mean[i] + dark;
    error += (difference * difference - variance) / scale;
    squares += difference * difference - variance;
  }
  const double count = static_cast<double>(rgb.size());
  return {std::sqrt(std::max(0.0, error / count)), std::sqrt(std::max(0.0, squares / count))};
}

}  // namespace scenec::test
