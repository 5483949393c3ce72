#include "backend/stop_rule.hpp"

#include <algorithm>
#include <utility>

namespace scenec::backend {

namespace {

constexpr std::int64_t most_samples = 1'048'576;
// `stop.error` needs this many samples, and two rounds that agree, before it is believed.
constexpr std::int64_t samples_before_error = 64;

std::int64_t sample_cap(const ir::RenderSettings& s) {
  if (s.samples) return *s.samples;
  if (s.stop.samples) return *s.stop.samples;
  if (s.stop.error || s.stop.time) return most_samples;
  if (s.film == ir::FilmKind::course) return 1;
  return s.method == ir::Method::path ? 64 : 16;
}

}  // namespace

StopRule::StopRule(const ir::RenderSettings& settings)
    : stop_(settings.stop), cap_(sample_cap(settings)) {}

std::int64_t StopRule::next_round(std::int64_t done) const {
  return std::min(cap_ - done, std::max<std::int64_t>(1, done / 4));
}

bool StopRule::needs_error(std::int64_t samples) const {
  return stop_.error && samples >= samples_before_error;
}

bool StopRule::holds(std::int64_t samples, double seconds, const ErrorEstimate& error) {
  if (samples == 0) return false;
  if (samples >= cap_) return true;
  if (stop_.time && seconds >= stop_.time->value) return true;
  if (!needs_error(samples)) return false;
  const bool now = error.known && error.relative.value <= *stop_.error;
  const bool before = std::exchange(error_reached_, now);
  return now && before;
}

}  // namespace scenec::backend
