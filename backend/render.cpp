// Tiles over threads, rounds of samples, stopping.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <mutex>

#include "backend/backend.hpp"
#include "backend/film/film.hpp"
#include "backend/integrators/kernel.hpp"

namespace scenec::backend {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t tile_side = 16;
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

// Rounds grow by a quarter of what is there, so that stopping at a round's end costs little.
std::int64_t next_round(std::int64_t done, std::int64_t cap) {
  return std::min(cap - done, std::max<std::int64_t>(1, done / 4));
}

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
           const ProgressFunction& progress)
      : settings_(settings),
        pool_(pool),
        stop_(std::move(stop)),
        start_(Clock::now()),
        progress_(progress, start_),
        kernel_(scene, settings, effects),
        film_(settings, settings.stop.error ? Film::Squares::yes : Film::Squares::no),
        cap_(sample_cap(settings)),
        workers_(pool.size()) {
    tiles_x_ = (film_.region_width() + tile_side - 1) / tile_side;
    tiles_y_ = (film_.region_height() + tile_side - 1) / tile_side;
  }

  Picture run() {
    bool complete = true;
    while (film_.samples() < cap_ && !good_enough()) {
      const std::int64_t count = next_round(film_.samples(), cap_);
      if (!render_round(count)) {
        complete = false;
        break;
      }
      film_.finish_round(count, pool_);
    }
    Picture picture = film_.picture();
    picture.complete = complete;
    for (const KernelWorker& worker : workers_) picture.rays += worker.rays.rays;
    return picture;
  }

 private:
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(Clock::now() - start_).count();
  }

  bool good_enough() {
    if (film_.samples() == 0) return false;
    if (settings_.stop.time && seconds() >= settings_.stop.time->value) return true;
    if (!settings_.stop.error || film_.samples() < samples_before_error) return false;
    const bool now = film_.estimated_error() <= *settings_.stop.error;
    const bool before = std::exchange(error_reached_, now);
    return now && before;
  }

  bool render_round(std::int64_t count) {
    const std::size_t tiles = tiles_x_ * tiles_y_;
    std::atomic<std::size_t> done{0};
    std::atomic<bool> cut{false};
    const std::int64_t first = film_.samples();
    const bool all = pool_.for_each(
        tiles,
        [&](std::size_t tile, unsigned worker) {
          if (!render_tile(tile, first, count, workers_[worker])) {
            cut.store(true, std::memory_order_relaxed);
            return;
          }
          const std::size_t finished = done.fetch_add(1, std::memory_order_relaxed) + 1;
          const double part = static_cast<double>(finished) / static_cast<double>(tiles);
          progress_.update(fraction(static_cast<double>(first) + part * static_cast<double>(count)),
                           first);
        },
        stop_);
    return all && !cut.load();
  }

  [[nodiscard]] double fraction(double samples) const {
    double f = samples / static_cast<double>(cap_);
    if (settings_.stop.time) f = std::fmax(f, seconds() / settings_.stop.time->value);
    return f;
  }

  // False when a stop request came in between.
  bool render_tile(std::size_t tile, std::int64_t first, std::int64_t count, KernelWorker& worker) {
    const std::size_t x0 = tile % tiles_x_ * tile_side;
    const std::size_t y0 = tile / tiles_x_ * tile_side;
    const Tile pixels{x0, y0, std::min(x0 + tile_side, film_.region_width()),
                      std::min(y0 + tile_side, film_.region_height())};
    return kernel_.render(film_, pixels, {first, first + count}, worker, stop_);
  }

  const ir::RenderSettings& settings_;
  ThreadPool& pool_;
  std::stop_token stop_;
  Clock::time_point start_;
  ProgressReporter progress_;
  TileKernel kernel_;
  Film film_;
  std::int64_t cap_;
  std::vector<KernelWorker> workers_;
  std::size_t tiles_x_ = 0;
  std::size_t tiles_y_ = 0;
  bool error_reached_ = false;
};

}  // namespace

Picture render(const RenderScene& scene, const ir::RenderSettings& settings, ThreadPool& pool,
               std::stop_token stop, const ProgressFunction& progress) {
  return render(scene, settings, find_effects(scene, settings).simulated(), pool, std::move(stop),
                progress);
}

Picture render(const RenderScene& scene, const ir::RenderSettings& settings,
               const ir::EffectSet& effects, ThreadPool& pool, std::stop_token stop,
               const ProgressFunction& progress) {
  SCENEC_ASSERT(settings.camera.valid());
  return Renderer(scene, settings, effects, pool, std::move(stop), progress).run();
}

}  // namespace scenec::backend
