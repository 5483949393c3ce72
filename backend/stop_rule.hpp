// When a picture has samples enough: after a number of them, a time or at an error, whichever comes
// first, as the render settings say.
#pragma once

#include <cstdint>

#include "backend/backend.hpp"
#include "ir/render_settings.hpp"

namespace scenec::backend {

class StopRule {
 public:
  explicit StopRule(const ir::RenderSettings& settings);

  // Samples a pixel after which it holds in any case.
  [[nodiscard]] std::int64_t cap() const { return cap_; }
  // Rounds grow by a quarter of what is there, so that stopping at a round's end costs little.
  [[nodiscard]] std::int64_t next_round(std::int64_t done) const;
  // Whether the estimate is asked for at all.
  [[nodiscard]] bool needs_error(std::int64_t samples) const;
  // Once a round, after it: an error is believed when two rounds agree.
  [[nodiscard]] bool holds(std::int64_t samples, double seconds, const ErrorEstimate& error);

 private:
  ir::Stop stop_;
  std::int64_t cap_;
  bool error_reached_ = false;
};

}  // namespace scenec::backend
