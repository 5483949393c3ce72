#include "runtime/study/variant.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "backend/image/compare.hpp"

namespace scenec::runtime {

namespace {

struct Run {
  double seconds = 0;
  backend::Picture picture;
  backend::ErrorEstimate error;
};

Run run(const Variant& variant, std::int64_t samples, std::int64_t seed, ThreadPool& pool,
        const std::stop_token& stop) {
  Run result;
  ir::RenderSettings settings = variant.settings;
  settings.seed = seed;
  backend::RenderSession session(*variant.scene, settings, variant.effects, pool,
                                 backend::KernelChoice::smallest, nullptr, variant.spread);
  const double start = cpu_seconds();
  session.advance(samples, stop);
  result.seconds = cpu_seconds() - start;
  result.picture = session.picture();
  result.error = session.error();
  return result;
}

backend::FloatImage image_of(const backend::Picture& picture) {
  return {static_cast<std::uint32_t>(picture.width), static_cast<std::uint32_t>(picture.height), 3,
          picture.rgb};
}

// Pixels count as changed when a channel differs by more than 2 % of the picture's mean and of the
// pixel: with common random numbers pixels a variant does not touch are equal to the last bit.
double changed_share(const std::vector<float>& a, const std::vector<float>& b, double mean) {
  std::size_t changed = 0;
  for (std::size_t i = 0; i + 2 < a.size(); i += 3) {
    bool is_changed = false;
    for (std::size_t c = i; c < i + 3; ++c) {
      const double x = static_cast<double>(a[c]);
      const double y = static_cast<double>(b[c]);
      is_changed = is_changed || std::abs(x - y) > 0.02 * (std::abs(x) + mean);
    }
    changed += is_changed ? 1 : 0;
  }
  return 3 * static_cast<double>(changed) / static_cast<double>(a.size());
}

}  // namespace

double cpu_seconds() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

Json json_of(const backend::ErrorBand& band) {
  return {{"value", band.value}, {"low", band.low}, {"high", band.high}};
}

double mean_of(const std::vector<float>& values) {
  double sum = 0;
  for (const float value : values) sum += static_cast<double>(value);
  return sum / static_cast<double>(std::max<std::size_t>(1, values.size()));
}

Json spread_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return {{"value", (values[(n - 1) / 2] + values[n / 2]) / 2},
          {"low", values.front()},
          {"high", values.back()}};
}

Json mean_band_of(const std::vector<double>& values) {
  constexpr double quantile = 4.0321;  // of Student's distribution, 99.5 %
  static_assert(pairs == 6, "the quantile is that of five degrees of freedom");
  const double n = static_cast<double>(values.size());
  double mean = 0;
  for (const double value : values) mean += value / n;
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  const double half = quantile * std::sqrt(squares / (n * (n - 1)));
  return {{"value", mean}, {"low", mean - half}, {"high", mean + half}};
}

Json comparison(const Variant& base, const Variant& other, std::int64_t samples,
                const StudyPlan& plan, ThreadPool& pool) {
  std::vector<double> times;
  std::vector<double> errors;
  std::vector<double> equal_errors;  // time to the same error
  std::vector<double> means;
  std::vector<double> pieces;  // share of pixels changed
  double distance = 0;
  backend::ErrorEstimate base_error;
  backend::ErrorEstimate other_error;
  for (int pair = 0; pair < pairs && !plan.stop.stop_requested(); ++pair) {
    const std::int64_t seed = base.settings.seed + pair;
    const bool base_first = pair % 2 == 0;
    Run first = run(base_first ? base : other, samples, seed, pool, plan.stop);
    Run second = run(base_first ? other : base, samples, seed, pool, plan.stop);
    const Run& a = base_first ? first : second;
    const Run& b = base_first ? second : first;
    if (!a.error.known || !b.error.known || a.seconds <= 0) continue;
    times.push_back(b.seconds / a.seconds);
    if (a.error.relative.value > 0) {
      const double ratio = b.error.relative.value / a.error.relative.value;
      errors.push_back(ratio);
      equal_errors.push_back(times.back() * ratio * ratio);
    }
    const double mean = mean_of(a.picture.rgb);
    if (mean > 0) means.push_back(mean_of(b.picture.rgb) / mean - 1);
    const backend::ImageDifference difference =
        backend::difference_of(image_of(b.picture), image_of(a.picture));
    distance += std::sqrt(difference.rel_mse) / pairs;
    pieces.push_back(changed_share(a.picture.rgb, b.picture.rgb, mean));
    base_error = a.error;
    other_error = b.error;
  }
  if (times.size() < static_cast<std::size_t>(pairs)) return nullptr;
  Json row{{"name", other.name}, {"what", other.what}, {"samples", samples}};
  row["time_ratio"] = spread_of(times);
  if (!errors.empty()) {
    row["error_ratio"] = spread_of(errors);
    row["equal_error_ratio"] = spread_of(equal_errors);
  }
  if (means.size() == static_cast<std::size_t>(pairs)) row["brightness"] = mean_band_of(means);
  row["changed_pixels"] = spread_of(pieces)["value"];
  row["difference"] = distance;
  row["error_before"] = json_of(base_error.relative);
  row["error_after"] = json_of(other_error.relative);
  return row;
}

}  // namespace scenec::runtime
