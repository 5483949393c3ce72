#include "runtime/stats.hpp"

#include <fmt/format.h>
#include <malloc.h>
#include <sys/resource.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "runtime/progress.hpp"

namespace scenec::runtime {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view render_phase = "render";
constexpr double mebibyte = 1024.0 * 1024.0;

std::uint64_t peak_bytes() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;  // Linux counts in KiB
}

double mebibytes(std::uint64_t bytes) {
  return static_cast<double>(bytes) / mebibyte;
}

double per_second(double amount, double seconds) {
  return seconds > 0 ? amount / seconds : 0;
}

// Of this process: what a checkpoint brought along took none of its time.
double samples_per_second(const RunStats& stats) {
  const auto camera = static_cast<std::size_t>(backend::RayKind::camera);
  return per_second(static_cast<double>(stats.rays[camera]), stats.seconds_of(render_phase));
}
double rays_per_second(const RunStats& stats) {
  return per_second(static_cast<double>(backend::total_of(stats.rays)),
                    stats.seconds_of(render_phase));
}

std::string phase_rows(const RunStats& stats) {
  std::string text;
  double total = 0;
  for (const RunStats::Phase& phase : stats.phases) {
    text += fmt::format("{:<18}{:>12.3f} s{:>14.1f} MiB at most\n", phase.name, phase.seconds,
                        mebibytes(phase.peak));
    for (const auto& [name, seconds] : phase.parts)
      text += fmt::format("  {:<16}{:>12.3f} s\n", name, seconds);
    total += phase.seconds;
  }
  return text + fmt::format("{:<18}{:>12.3f} s\n", "total", total);
}

std::string percent(double share) {
  return fmt::format("{:.1f} %", 100 * share);
}

// How many rays of each kind there were; and, of a few samples, what they took and tested.
std::string ray_rows(const RunStats& stats) {
  const backend::RenderProfile& profile = stats.profile;
  const bool profiled = profile.samples > 0;
  std::string text = fmt::format("{:<18}{:>12}", "rays", backend::total_of(stats.rays));
  text +=
      profiled ? fmt::format("{:>10}{:>13}{:>13}\n", "time", "nodes a ray", "tests a ray") : "\n";
  for (std::size_t i = 0; i < stats.rays.size(); ++i) {
    if (stats.rays[i] == 0) continue;
    text += fmt::format("  {:<16}{:>12}", backend::ray_kind_names[i], stats.rays[i]);
    const auto& rays = profile.rays[i];
    text += profiled ? fmt::format("{:>10}{:>13.1f}{:>13.1f}\n", percent(rays.share), rays.nodes,
                                   rays.primitives)
                     : "\n";
  }
  if (!profiled) return text;
  for (const auto& [name, share] : {std::pair{"choosing lights", profile.lights},
                                    {"materials", profile.materials},
                                    {"everything else", profile.rest}})
    text += fmt::format("  {:<28}{:>10}\n", name, percent(share));
  return text +
         fmt::format("  times and tests are those of {} samples traced again\n", profile.samples);
}

std::string cache_rows(const ContentCacheCounts& cache) {
  std::string text = fmt::format("{:<18}{:>12}\n{:<18}{:>12}\n", "cache hits", cache.hits,
                                 "cache misses", cache.misses);
  if (!cache.note.empty()) text += fmt::format("not cached: {}\n", cache.note);
  return text;
}

std::string memory_rows(const RunStats& stats) {
  std::string text = fmt::format("{:<18}{:>12.1f} MiB\n", "peak memory", mebibytes(peak_bytes()));
  for (const auto& [name, bytes] : stats.memory)
    text += fmt::format("  {:<16}{:>12.3f} MiB\n", name, mebibytes(bytes));
  return text;
}

Json json_of(const backend::ErrorBand& band) {
  return {{"value", band.value}, {"low", band.low}, {"high", band.high}};
}

Json json_of(const RunStats& stats, const backend::RenderProfile& profile) {
  Json json{{"samples", profile.samples}};
  for (std::size_t i = 0; i < stats.rays.size(); ++i) {
    if (stats.rays[i] == 0) continue;
    const auto& rays = profile.rays[i];
    json["rays"][backend::ray_kind_names[i]] = {{"share_of_time", rays.share},
                                                {"nodes_per_ray", rays.nodes},
                                                {"tests_per_ray", rays.primitives}};
  }
  json["share_of_time"] = {{"choosing_lights", profile.lights},
                           {"materials", profile.materials},
                           {"everything_else", profile.rest}};
  return json;
}

}  // namespace

double RunStats::seconds_of(std::string_view phase) const {
  for (const Phase& one : phases) {
    if (one.name == phase) return one.seconds;
  }
  return 0;
}

void RunStats::add_memory(std::string consumer, std::uint64_t bytes) {
  if (bytes > 0) memory.emplace_back(std::move(consumer), bytes);
}

void PhaseClock::finish(std::string phase, std::vector<std::pair<std::string, double>> parts,
                        std::string rest) {
  const Clock::time_point now = Clock::now();
  const double seconds = std::chrono::duration<double>(now - last_).count();
  if (!rest.empty()) {
    double left = seconds;
    for (const auto& part : parts) left -= part.second;
    parts.emplace_back(std::move(rest), std::max(0.0, left));
  }
  stats_.phases.push_back({std::move(phase), seconds, peak_bytes(), std::move(parts)});
  last_ = now;
}

std::uint64_t allocated_bytes() {
  const struct mallinfo2 info = ::mallinfo2();
  return info.uordblks + info.hblkhd;
}

std::string stats_table(const RunStats& stats) {
  std::string text = phase_rows(stats);
  text += fmt::format("{:<18}{:>12}\n", "samples a pixel", stats.samples);
  if (stats.error.known) {
    text += fmt::format("{:<18}{:>12}\n", "error", error_text(stats.error.relative));
    text += fmt::format("{:<18}{:>12.4g}\n", "RMSE", stats.error.absolute.value);
  }
  text += fmt::format("{:<18}{:>12.3f} M/s\n", "samples", samples_per_second(stats) * 1e-6);
  text += fmt::format("{:<18}{:>12.3f} M/s\n", "ray rate", rays_per_second(stats) * 1e-6);
  text += ray_rows(stats);
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
  return text + memory_rows(stats);
}

std::string stats_json(const RunStats& stats) {
  Json json;
  for (const RunStats::Phase& phase : stats.phases) json["seconds"][phase.name] = phase.seconds;
  for (const RunStats::Phase& phase : stats.phases) {
    for (const auto& [name, seconds] : phase.parts)
      json["seconds_within"][phase.name][name] = seconds;
  }
  json["samples_per_pixel"] = stats.samples;
  if (stats.error.known) {
    json["error"] = json_of(stats.error.relative);
    json["rmse"] = json_of(stats.error.absolute);
  }
  json["samples_per_second"] = samples_per_second(stats);
  json["rays"] = backend::total_of(stats.rays);
  json["rays_per_second"] = rays_per_second(stats);
  for (std::size_t i = 0; i < stats.rays.size(); ++i)
    json["rays_by_kind"][backend::ray_kind_names[i]] = stats.rays[i];
  if (stats.profile.samples > 0) json["profile"] = json_of(stats, stats.profile);
  json["kernel"] = stats.kernel;
  json["effect_runs"] = Json::object();
  for (const auto& [effect, runs] : stats.effect_runs) json["effect_runs"][effect] = runs;
  json["dropped_samples"] = stats.dropped_samples;
  json["saturated_samples"] = stats.saturated_samples;
  if (stats.cache) {
    json["cache"] = {{"hits", stats.cache->hits},
                     {"misses", stats.cache->misses},
                     {"stored", stats.cache->stored},
                     {"note", stats.cache->note}};
  }
  json["peak_mebibytes"] = mebibytes(peak_bytes());
  for (const RunStats::Phase& phase : stats.phases)
    json["peak_mebibytes_after"][phase.name] = mebibytes(phase.peak);
  json["memory_bytes"] = Json::object();
  for (const auto& [consumer, bytes] : stats.memory) json["memory_bytes"][consumer] = bytes;
  return json.dump(2) + "\n";
}

}  // namespace scenec::runtime
