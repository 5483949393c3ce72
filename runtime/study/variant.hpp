// Two ways to render a scene beside each other. Times are CPU seconds of the whole process, which
// other programs on the machine disturb least; runs are made in turn with the same random numbers.
#pragma once

#include <string>
#include <vector>

#include "runtime/study/study.hpp"

namespace scenec::runtime {

// The least and the largest of six ratios enclose the median 97 times in 100.
inline constexpr int pairs = 6;

// A scene made ready, with what it is rendered with.
struct Variant {
  std::string name;
  std::string what;  // for the reader
  ir::RenderSettings settings;
  ir::EffectSet effects;
  const backend::RenderScene* scene = nullptr;
  backend::SampleSpread spread = backend::SampleSpread::even;
};

[[nodiscard]] double cpu_seconds();
[[nodiscard]] Json json_of(const backend::ErrorBand& band);
// Median, least and largest; of at least one value.
[[nodiscard]] Json spread_of(std::vector<double> values);
// Mean with the band that holds the true one 99 times in 100, of one value a pair. For biases: rare
// bright samples make a median lie below the mean, six times out of six.
[[nodiscard]] Json mean_band_of(const std::vector<double>& values);
[[nodiscard]] double mean_of(const std::vector<float>& values);

// What a variant costs and changes beside the base; null when it was stopped, or an error is not
// known.
[[nodiscard]] Json comparison(const Variant& base, const Variant& other, std::int64_t samples,
                              const StudyPlan& plan, ThreadPool& pool);

// What it would do to cut off every sample at `times` the picture's mean: read from the samples
// themselves, one round each. `other` names the row. Null as above.
[[nodiscard]] Json clamp_row(const Variant& base, const Variant& other, double times,
                             std::int64_t samples, const StudyPlan& plan, ThreadPool& pool);

}  // namespace scenec::runtime
