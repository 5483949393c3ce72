// A render from the first sample to the one at which its stop rule holds.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>
#include <utility>

#include "backend/render_session.hpp"
#include "backend/stop_rule.hpp"

namespace scenec::backend {
namespace {

using Clock = std::chrono::steady_clock;

// A round should end in time for a checkpoint, a look or a stop by time.
constexpr double longest_round = 3;
// An estimate for the progress line may take this part of the time.
constexpr double share_of_estimates = 0.005;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Tells the caller how far the picture is, at most every few milliseconds.
class ProgressReporter {
 public:
  explicit ProgressReporter(const ProgressFunction& report)
      : report_(report), last_(Clock::now()) {}

  [[nodiscard]] bool is_wanted() const { return static_cast<bool>(report_); }
  void update(Progress progress) {
    if (!report_) return;
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock) return;
    const Clock::time_point now = Clock::now();
    if (now - last_ < std::chrono::milliseconds(5) && progress.fraction < 1) return;
    last_ = now;
    best_ = std::max(best_, std::clamp(progress.fraction, 0.0, 1.0));
    progress.fraction = best_;
    report_(progress);
  }

 private:
  const ProgressFunction& report_;
  std::mutex mutex_;
  Clock::time_point last_;
  double best_ = 0;
};

class Renderer {
 public:
  Renderer(RenderSession& session, const ir::RenderSettings& settings, const std::stop_token& stop,
           const RenderHooks& hooks, StopState& state)
      : session_(session),
        settings_(settings),
        stop_(stop),
        hooks_(hooks),
        state_(state),
        reporter_(hooks.progress),
        cap_(sample_cap_of(settings)) {}

  StopReason run() {
    while (session_.samples() < cap_) {
      const std::int64_t done = session_.samples();
      const std::int64_t look = settings_.stop.error ? std::min(cap_, next_look(done)) : cap_;
      // Long rounds, as each one visits the sums of every pixel anew; short ones at first, when
      // what a sample takes is little known.
      if (!advance(std::min({look - done, longest_count(), std::max<std::int64_t>(1, done)})))
        return StopReason::request;
      if (hooks_.between) hooks_.between();
      if (session_.samples() == look && error_is_reached()) return StopReason::error;
      if (settings_.stop.time && state_.seconds >= settings_.stop.time->value)
        return StopReason::time;
    }
    return StopReason::samples;
  }

 private:
  [[nodiscard]] std::int64_t longest_count() const {
    if (told_.seconds_a_sample <= 0) return 1;
    double seconds = longest_round;
    if (settings_.stop.time)
      seconds = std::min(seconds, std::max(0.0, settings_.stop.time->value - state_.seconds));
    const double count = std::min(seconds / told_.seconds_a_sample, 1e6);
    return std::max<std::int64_t>(1, static_cast<std::int64_t>(count));
  }

  bool advance(std::int64_t count) {
    const Clock::time_point start = Clock::now();
    const double first = static_cast<double>(session_.samples());
    const bool finished = session_.advance(count, stop_, [&](double part) {
      if (!reporter_.is_wanted()) return;
      Progress progress = told_;
      progress.fraction = fraction(first + part * static_cast<double>(count),
                                   state_.seconds + seconds_since(start));
      reporter_.update(progress);
    });
    const double seconds = seconds_since(start);
    state_.seconds += seconds;
    told_.samples_done = session_.samples();
    if (finished) {
      told_.seconds_a_sample = seconds / static_cast<double>(count);
      if (reporter_.is_wanted()) estimate_now_and_then();
    }
    return finished;
  }

  void estimate_now_and_then() {
    if (state_.seconds - estimated_at_ < estimate_cost_ / share_of_estimates) return;
    const Clock::time_point start = Clock::now();
    look();
    estimate_cost_ = seconds_since(start);
    estimated_at_ = state_.seconds;
  }
  const ErrorEstimate& look() {
    told_.error = session_.error();
    told_.error_samples = session_.samples();
    return told_.error;
  }

  bool error_is_reached() {
    if (!settings_.stop.error || session_.samples() < samples_before_error) return false;
    return error_holds(settings_.stop, session_.samples(), look(), state_.error_reached);
  }

  // Of the work the rule that is nearest calls for.
  [[nodiscard]] double fraction(double samples, double seconds) const {
    double f = samples / static_cast<double>(cap_);
    if (settings_.stop.time) f = std::max(f, seconds / settings_.stop.time->value);
    if (settings_.stop.error && told_.error.known) {
      const double missing = told_.error.relative.value / *settings_.stop.error;
      const double wanted = static_cast<double>(told_.error_samples) * missing * missing;
      f = std::max(f, samples / std::max(wanted, static_cast<double>(samples_before_error)));
    }
    return f;
  }

  RenderSession& session_;
  const ir::RenderSettings& settings_;
  const std::stop_token& stop_;
  const RenderHooks& hooks_;
  StopState& state_;
  ProgressReporter reporter_;
  std::int64_t cap_;
  Progress told_;
  double estimate_cost_ = 0;
  double estimated_at_ = 0;
};

}  // namespace

StopReason render_to_end(RenderSession& session, const ir::RenderSettings& settings,
                         const std::stop_token& stop, const RenderHooks& hooks, StopState& state) {
  return Renderer(session, settings, stop, hooks, state).run();
}

Picture render(const RenderScene& scene, const ir::RenderSettings& settings, ThreadPool& pool,
               std::stop_token stop, const ProgressFunction& progress) {
  return render(scene, settings, find_effects(scene, settings).simulated(), pool, std::move(stop),
                progress);
}

Picture render(const RenderScene& scene, const ir::RenderSettings& settings,
               const ir::EffectSet& effects, ThreadPool& pool, std::stop_token stop,
               const ProgressFunction& progress, KernelChoice kernel) {
  RenderSession session(scene, settings, effects, pool, kernel);
  StopState state;
  const StopReason reason = render_to_end(session, settings, stop, {progress}, state);
  Picture picture = session.picture();
  picture.complete = reason != StopReason::request;
  return picture;
}

}  // namespace scenec::backend
