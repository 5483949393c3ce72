// When a picture has samples enough: after a number of them, a time or at an error, whichever comes
// first, as the render settings say.
#pragma once

#include <cstdint>

#include "backend/backend.hpp"
#include "ir/render_settings.hpp"

namespace scenec::backend {

// `stop.error` needs this many samples, and two looks that agree, before it is believed.
inline constexpr std::int64_t samples_before_error = 64;

// Samples a pixel after which a render ends in any case.
[[nodiscard]] std::int64_t sample_cap_of(const ir::RenderSettings& settings);
// The next number of samples, after `done` of them, at which `stop.error` is looked at: they grow
// by an eighth: coarser steps overshoot what was asked for, finer ones cost more looks.
[[nodiscard]] std::int64_t next_look(std::int64_t done);
// Whether the error asked for is reached, at a look. `reached` is what the look before found and
// becomes what this one does.
[[nodiscard]] bool error_holds(const ir::Stop& stop, std::int64_t samples,
                               const ErrorEstimate& error, bool& reached);

class StopRule {
 public:
  explicit StopRule(const ir::RenderSettings& settings);

  // Samples a pixel after which it holds in any case.
  [[nodiscard]] std::int64_t cap() const { return cap_; }
  // From look to look.
  [[nodiscard]] std::int64_t next_round(std::int64_t done) const;
  // Whether the estimate is asked for at all.
  [[nodiscard]] bool needs_error(std::int64_t samples) const;
  // Once a round, after it.
  [[nodiscard]] bool holds(std::int64_t samples, double seconds, const ErrorEstimate& error);

 private:
  ir::Stop stop_;
  std::int64_t cap_;
  bool error_reached_ = false;
};

}  // namespace scenec::backend
