#include "runtime/stats.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <nlohmann/json.hpp>

#include "runtime/progress.hpp"

namespace scenec::runtime {

namespace {

constexpr std::string_view render_phase = "render";

double peak_megabytes() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;  // Linux counts in KiB
}

double per_second(double amount, double seconds) {
  return seconds > 0 ? amount / seconds : 0;
}

double sample_count(const RunStats& stats) {
  return static_cast<double>(stats.samples) * static_cast<double>(stats.pixels);
}

std::string cache_rows(const ContentCacheCounts& cache) {
  std::string text = fmt::format("{:<18}{:>12}\n{:<18}{:>12}\n", "cache hits", cache.hits,
                                 "cache misses", cache.misses);
  if (!cache.note.empty()) text += fmt::format("not cached: {}\n", cache.note);
  return text;
}

}  // namespace

double RunStats::seconds_of(std::string_view phase) const {
  for (const auto& [name, seconds] : phases) {
    if (name == phase) return seconds;
  }
  return 0;
}

void PhaseClock::finish(std::string phase) {
  const Clock::time_point now = Clock::now();
  stats_.phases.emplace_back(std::move(phase), std::chrono::duration<double>(now - last_).count());
  last_ = now;
}

std::string stats_table(const RunStats& stats) {
  std::string text;
  double total = 0;
  for (const auto& [name, seconds] : stats.phases) {
    text += fmt::format("{:<18}{:>12.3f} s\n", name, seconds);
    total += seconds;
  }
  const double rendering = stats.seconds_of(render_phase);
  text += fmt::format("{:<18}{:>12.3f} s\n", "total", total);
  text += fmt::format("{:<18}{:>12}\n", "samples a pixel", stats.samples);
  if (stats.error.known) {
    text += fmt::format("{:<18}{:>12}\n", "error", error_text(stats.error.relative));
    text += fmt::format("{:<18}{:>12.4g}\n", "RMSE", stats.error.absolute.value);
  }
  text += fmt::format("{:<18}{:>12.3f} M/s\n", "samples",
                      per_second(sample_count(stats), rendering) * 1e-6);
  text += fmt::format("{:<18}{:>12}\n", "rays", stats.rays);
  text += fmt::format("{:<18}{:>12.3f} M/s\n", "ray rate",
                      per_second(static_cast<double>(stats.rays), rendering) * 1e-6);
  text += fmt::format("{:<18}{:>12}\n", "kernel", stats.kernel);
  for (const auto& [effect, runs] : stats.effect_runs)
    text += fmt::format("  {:<16}{:>12}\n", effect, runs);
  if (stats.dropped_samples == 0 && stats.saturated_samples == 0)
    text += "every sample was counted\n";
  if (stats.dropped_samples > 0)
    text += fmt::format("{:<18}{:>12} not finite, left out\n", "dropped samples",
                        stats.dropped_samples);
  if (stats.saturated_samples > 0)
    text +=
        fmt::format("{:<18}{:>12} too bright, cut\n", "saturated samples", stats.saturated_samples);
  if (stats.cache) text += cache_rows(*stats.cache);
  return text + fmt::format("{:<18}{:>12.1f} MiB\n", "peak memory", peak_megabytes());
}

std::string stats_json(const RunStats& stats) {
  nlohmann::ordered_json json;
  for (const auto& [name, seconds] : stats.phases) json["seconds"][name] = seconds;
  const double rendering = stats.seconds_of(render_phase);
  json["samples_per_pixel"] = stats.samples;
  if (stats.error.known) {
    const auto put = [&](const char* name, const backend::ErrorBand& band) {
      json[name] = {{"value", band.value}, {"low", band.low}, {"high", band.high}};
    };
    put("error", stats.error.relative);
    put("rmse", stats.error.absolute);
  }
  json["samples_per_second"] = per_second(sample_count(stats), rendering);
  json["rays"] = stats.rays;
  json["rays_per_second"] = per_second(static_cast<double>(stats.rays), rendering);
  json["kernel"] = stats.kernel;
  json["effect_runs"] = nlohmann::ordered_json::object();
  for (const auto& [effect, runs] : stats.effect_runs) json["effect_runs"][effect] = runs;
  json["dropped_samples"] = stats.dropped_samples;
  json["saturated_samples"] = stats.saturated_samples;
  if (stats.cache) {
    json["cache"] = {{"hits", stats.cache->hits},
                     {"misses", stats.cache->misses},
                     {"stored", stats.cache->stored},
                     {"note", stats.cache->note}};
  }
  json["peak_mebibytes"] = peak_megabytes();
  return json.dump(2) + "\n";
}

}  // namespace scenec::runtime
