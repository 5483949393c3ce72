// Where the time of a run went: phases in order, rays, samples, memory. As a table for people or
// as JSON for programs.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "backend/backend.hpp"
#include "base/content_cache.hpp"

namespace scenec::runtime {

struct RunStats {
  std::vector<std::pair<std::string, double>> phases;  // name, seconds
  std::string kernel;                                  // that rendered
  std::uint64_t rays = 0;
  std::vector<std::pair<std::string, std::uint64_t>> effect_runs;  // those that ran
  std::int64_t samples = 0;                                        // a pixel
  std::int64_t pixels = 0;
  std::uint64_t dropped_samples = 0;
  std::uint64_t saturated_samples = 0;
  backend::ErrorEstimate error;
  std::optional<ContentCacheCounts> cache;  // nullopt: nothing is kept

  [[nodiscard]] double seconds_of(std::string_view phase) const;
};

// Adds the time since its making or the last call to the phase named.
class PhaseClock {
 public:
  explicit PhaseClock(RunStats& stats) : stats_(stats), last_(Clock::now()) {}
  void finish(std::string phase);

 private:
  using Clock = std::chrono::steady_clock;
  RunStats& stats_;
  Clock::time_point last_;
};

[[nodiscard]] std::string stats_table(const RunStats& stats);
[[nodiscard]] std::string stats_json(const RunStats& stats);

}  // namespace scenec::runtime
