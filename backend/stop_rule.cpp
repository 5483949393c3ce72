#include "backend/stop_rule.hpp"

#include <algorithm>
#include <utility>

namespace scenec::backend {

namespace {
constexpr std::int64_t most_samples = 1'048'576;
}  // namespace

std::int64_t sample_cap_of(const ir::RenderSettings& s) {
  if (s.samples) return *s.samples;
  if (s.stop.samples) return *s.stop.samples;
  if (s.stop.error || s.stop.time) return most_samples;
  if (s.film == ir::FilmKind::course) return 1;
  return s.method == ir::Method::path ? 64 : 16;
}

std::int64_t next_look(std::int64_t done) {
  std::int64_t look = 1;
  while (look <= done) look += std::max<std::int64_t>(1, look / 8);
  return look;
}

bool error_holds(const ir::Stop& stop, std::int64_t samples, const ErrorEstimate& error,
                 bool& reached) {
  if (!stop.error || samples < samples_before_error) return false;
  const bool now = error.known && error.relative.value <= *stop.error;
  const bool before = std::exchange(reached, now);
  return now && before;
}

StopRule::StopRule(const ir::RenderSettings& settings)
    : stop_(settings.stop), cap_(sample_cap_of(settings)) {}

std::int64_t StopRule::next_round(std::int64_t done) const {
  return std::min(cap_, next_look(done)) - done;
}

bool StopRule::needs_error(std::int64_t samples) const {
  return stop_.error && samples >= samples_before_error;
}

bool StopRule::holds(std::int64_t samples, double seconds, const ErrorEstimate& error) {
  if (samples == 0) return false;
  if (samples >= cap_) return true;
  if (stop_.time && seconds >= stop_.time->value) return true;
  return error_holds(stop_, samples, error, error_reached_);
}

}  // namespace scenec::backend
