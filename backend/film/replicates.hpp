// Replicates: a pixel's samples are dealt out in turn to independent scrambles of the sampler. Each
// replicate's mean is an unbiased estimate of the pixel, so what they differ by is a true measure
// of the error — which the differences between the samples of one low-discrepancy set are not.
#pragma once

#include <array>
#include <cstdint>

#include "backend/math/rng.hpp"

namespace scenec::backend {

inline constexpr std::size_t replicate_count = 4;

// What the sampler is asked for instead of the sample's number.
struct ReplicateSample {
  std::uint64_t seed;
  std::uint64_t number;  // within the replicate
};
[[nodiscard]] constexpr ReplicateSample replicate_sample(std::uint64_t seed, std::uint64_t number) {
  const std::uint64_t replicate = number % replicate_count;
  return {replicate == 0 ? seed : mix_bits(seed ^ (replicate << 60)), number / replicate_count};
}

// Of one pixel, by replicate and channel.
using ReplicateMeans = std::array<std::array<double, 3>, replicate_count>;

// The variance of the mean of all replicates.
[[nodiscard]] constexpr double variance_of_mean(const ReplicateMeans& means, std::size_t channel) {
  double mean = 0;
  for (const auto& replicate : means) mean += replicate[channel];
  mean /= replicate_count;
  double squares = 0;
  for (const auto& replicate : means) {
    const double difference = replicate[channel] - mean;
    squares += difference * difference;
  }
  return squares / (replicate_count * (replicate_count - 1));
}

}  // namespace scenec::backend
