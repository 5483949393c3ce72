// A render from the first sample to the one at which its stop rule holds.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>

#include "backend/backend.hpp"
#include "backend/render_session.hpp"
#include "backend/stop_rule.hpp"

namespace scenec::backend {
namespace {

using Clock = std::chrono::steady_clock;

// Tells the caller how far the picture is, at most every few milliseconds.
class ProgressReporter {
 public:
  ProgressReporter(const ProgressFunction& report, Clock::time_point start)
      : report_(report), last_(start) {}

  void update(double fraction, std::int64_t samples_done) {
    if (!report_) return;
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock) return;
    const Clock::time_point now = Clock::now();
    if (now - last_ < std::chrono::milliseconds(5) && fraction < 1) return;
    last_ = now;
    best_ = std::max(best_, std::clamp(fraction, 0.0, 1.0));
    report_({best_, samples_done});
  }

 private:
  const ProgressFunction& report_;
  std::mutex mutex_;
  Clock::time_point last_;
  double best_ = 0;
};

class Renderer {
 public:
  Renderer(const RenderScene& scene, const ir::RenderSettings& settings,
           const ir::EffectSet& effects, ThreadPool& pool, std::stop_token stop,
           const ProgressFunction& progress, KernelChoice kernel)
      : settings_(settings),
        stop_(std::move(stop)),
        start_(Clock::now()),
        progress_(progress, start_),
        session_(scene, settings, effects, pool, kernel),
        rule_(settings) {}

  Picture run() {
    bool complete = true;
    while (complete && !good_enough()) {
      const double first = static_cast<double>(session_.samples());
      const std::int64_t count = rule_.next_round(session_.samples());
      complete = session_.advance(count, stop_, [&](double part) {
        progress_.update(fraction(first + part * static_cast<double>(count)), session_.samples());
      });
    }
    Picture picture = session_.picture();
    picture.complete = complete;
    return picture;
  }

 private:
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(Clock::now() - start_).count();
  }

  bool good_enough() {
    const bool asked = rule_.needs_error(session_.samples());
    return rule_.holds(session_.samples(), seconds(), asked ? session_.error() : ErrorEstimate{});
  }

  [[nodiscard]] double fraction(double samples) const {
    double f = samples / static_cast<double>(rule_.cap());
    if (settings_.stop.time) f = std::fmax(f, seconds() / settings_.stop.time->value);
    return f;
  }

  const ir::RenderSettings& settings_;
  std::stop_token stop_;
  Clock::time_point start_;
  ProgressReporter progress_;
  RenderSession session_;
  StopRule rule_;
};

}  // namespace

Picture render(const RenderScene& scene, const ir::RenderSettings& settings, ThreadPool& pool,
               std::stop_token stop, const ProgressFunction& progress) {
  return render(scene, settings, find_effects(scene, settings).simulated(), pool, std::move(stop),
                progress);
}

Picture render(const RenderScene& scene, const ir::RenderSettings& settings,
               const ir::EffectSet& effects, ThreadPool& pool, std::stop_token stop,
               const ProgressFunction& progress, KernelChoice kernel) {
  SCENEC_ASSERT(settings.camera.valid());
  return Renderer(scene, settings, effects, pool, std::move(stop), progress, kernel).run();
}

}  // namespace scenec::backend
