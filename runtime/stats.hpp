// Where the time and the memory of a run went: phases in order, rays by kind, samples, consumers of
// memory. As a table for people or as JSON for programs (docs/statistics.md).
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "backend/backend.hpp"
#include "backend/render_profile.hpp"
#include "base/content_cache.hpp"

namespace scenec::runtime {

struct RunStats {
  struct Phase {
    std::string name;
    double seconds = 0;
    std::uint64_t peak = 0;  // bytes of the process, at its end or before
    // What it spent its time on, as far as that is told apart; no more than all of it.
    std::vector<std::pair<std::string, double>> parts = {};
  };
  std::vector<Phase> phases;
  std::string kernel;  // that rendered
  backend::RayCounts rays{};
  backend::RenderProfile profile;                                  // without samples: not made
  std::vector<std::pair<std::string, std::uint64_t>> effect_runs;  // those that ran
  std::vector<std::pair<std::string, std::uint64_t>> memory;       // bytes by consumer
  std::int64_t samples = 0;                                        // a pixel
  std::uint64_t dropped_samples = 0;
  std::uint64_t saturated_samples = 0;
  backend::ErrorEstimate error;
  std::optional<ContentCacheCounts> cache;  // nullopt: nothing is kept

  [[nodiscard]] double seconds_of(std::string_view phase) const;
  // Consumers of nothing are left out.
  void add_memory(std::string consumer, std::uint64_t bytes);
};

// Adds the time since its making or the last call to the phase named.
class PhaseClock {
 public:
  explicit PhaseClock(RunStats& stats) : stats_(stats), last_(Clock::now()) {}
  // `parts`: see Phase; what is left of the phase is its part `rest`, if that has a name.
  void finish(std::string phase, std::vector<std::pair<std::string, double>> parts = {},
              std::string rest = {});

 private:
  using Clock = std::chrono::steady_clock;
  RunStats& stats_;
  Clock::time_point last_;
};

// Bytes that the general allocator has given out; 0 where that cannot be known.
[[nodiscard]] std::uint64_t allocated_bytes();

[[nodiscard]] std::string stats_table(const RunStats& stats);
[[nodiscard]] std::string stats_json(const RunStats& stats);

}  // namespace scenec::runtime
