#include "backend/render_profile.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <vector>

#include "backend/integrators/kernel.hpp"
#include "backend/math/rng.hpp"

namespace scenec::backend {
namespace {

// Samples are traced again in runs of so many, as a pixel's samples follow each other in a render.
constexpr std::int64_t run_length = 4;
// Traced twice, and slower than in a render: about a hundredth of its time.
constexpr std::int64_t one_in = 250;
constexpr std::int64_t fewest_runs = 64;
constexpr std::int64_t most_runs = 4096;

struct Worker {
  KernelWorker kernel;
  ProbeCounters probe;
  std::uint64_t ticks = 0;  // of all runs
};

// Of looking at the clock twice: what a stage seems to take that does nothing.
double ticks_of_looking() {
  constexpr int looks = 4096;
  std::uint64_t least = ~std::uint64_t{0};
  for (int i = 0; i < looks; ++i) {
    const std::uint64_t start = ticks_now();
    least = std::min(least, ticks_now() - start);
  }
  return static_cast<double>(least);
}

// How often the system has taken the processor from this thread.
long interruptions_so_far() {
  rusage usage{};
  ::getrusage(RUSAGE_THREAD, &usage);
  return usage.ru_nivcsw;
}

class Profiler {
 public:
  Profiler(const RenderScene& scene, const ir::RenderSettings& settings,
           const ir::EffectSet& effects, ThreadPool& pool, std::int64_t samples)
      : settings_(settings),
        pool_(pool),
        kernel_(scene, settings_, effects, KernelChoice::probing),
        region_(region_of(settings)),
        samples_(samples),
        workers_(pool.size()) {
    for (Worker& worker : workers_) worker.kernel.rays.probe = &worker.probe;
  }

  RenderProfile profile() {
    const std::int64_t pixels = (region_.x1 - region_.x0) * (region_.y1 - region_.y0);
    if (pixels <= 0 || samples_ <= 0) return {};
    const std::int64_t part = pixels * samples_ / one_in / run_length;
    const auto runs = static_cast<std::size_t>(std::clamp(part, fewest_runs, most_runs));
    for (const auto mode : {ProbeCounters::Mode::time, ProbeCounters::Mode::tests}) {
      for (Worker& worker : workers_) worker.probe.mode = mode;
      pool_.for_each(runs, [&](std::size_t run, unsigned worker) {
        trace(run, runs, pixels, workers_[worker]);
      });
    }
    RenderProfile result = summary();
    result.samples = static_cast<std::int64_t>(runs) * std::min(run_length, samples_);
    return result;
  }

 private:
  void trace(std::size_t run, std::size_t runs, std::int64_t pixels, Worker& worker) const {
    // A pixel of the run's share of the picture, and where in its samples to begin.
    const std::uint64_t chance = mix_bits(run + 1);
    const double at = (static_cast<double>(run) + static_cast<double>(chance >> 11) * 0x1p-53) /
                      static_cast<double>(runs);
    const std::int64_t pixel =
        std::min(pixels - 1, static_cast<std::int64_t>(at * static_cast<double>(pixels)));
    const std::int64_t width = region_.x1 - region_.x0;
    const std::int64_t count = std::min(run_length, samples_);
    const auto starts = static_cast<std::uint64_t>(samples_ - count + 1);
    const auto first = static_cast<std::int64_t>(mix_bits(chance) % starts);
    ir::RenderSettings own = settings_;
    const std::int64_t x = region_.x0 + pixel % width;
    const std::int64_t y = region_.y0 + pixel / width;
    own.region = ir::Region{x, y, x + 1, y + 1};
    Film film(own);
    film.begin_round();
    const auto before = worker.probe.stages;
    const long interruptions = interruptions_so_far();
    const std::uint64_t start = ticks_now();
    static_cast<void>(
        kernel_.render(film, {0, 0, 1, 1}, {first, first + count}, worker.kernel, {}));
    const std::uint64_t ticks = ticks_now() - start;
    if (worker.probe.mode != ProbeCounters::Mode::time) return;
    // The time of another program would be that of whatever stage it came in.
    if (interruptions_so_far() == interruptions) {
      worker.ticks += ticks;
    } else {
      worker.probe.stages = before;
    }
  }

  // The clock's own time is taken off: each look takes it once within its stage and once outside.
  [[nodiscard]] RenderProfile summary() const {
    const double looking = ticks_of_looking();
    std::array<double, render_stage_count> stages{};
    double all = 0;
    double in_stages = 0;
    RenderProfile result;
    for (const Worker& worker : workers_) {
      all += static_cast<double>(worker.ticks);
      for (std::size_t i = 0; i < stages.size(); ++i) {
        const auto calls = static_cast<double>(worker.probe.stages[i].calls);
        const double ticks = static_cast<double>(worker.probe.stages[i].ticks) - looking * calls;
        stages[i] += std::max(0.0, ticks);
        all -= 2 * looking * calls;
      }
    }
    for (const double ticks : stages) in_stages += ticks;
    all = std::max(all, in_stages);
    if (!(all > 0)) return result;
    for (std::size_t i = 0; i < result.rays.size(); ++i) result.rays[i].share = stages[i] / all;
    result.lights = stages[static_cast<std::size_t>(RenderStage::lights)] / all;
    result.materials = stages[static_cast<std::size_t>(RenderStage::materials)] / all;
    result.rest = 1 - in_stages / all;
    add_tests(result);
    return result;
  }

  void add_tests(RenderProfile& result) const {
    for (std::size_t i = 0; i < result.rays.size(); ++i) {
      ProbeCounters::Tests sum;
      for (const Worker& worker : workers_) {
        sum.rays += worker.probe.rays[i].rays;
        sum.tests.nodes += worker.probe.rays[i].tests.nodes;
        sum.tests.primitives += worker.probe.rays[i].tests.primitives;
      }
      if (sum.rays == 0) continue;
      const auto rays = static_cast<double>(sum.rays);
      result.rays[i].nodes = static_cast<double>(sum.tests.nodes) / rays;
      result.rays[i].primitives = static_cast<double>(sum.tests.primitives) / rays;
    }
  }

  ir::RenderSettings settings_;
  ThreadPool& pool_;
  TileKernel kernel_;
  ir::Region region_;
  std::int64_t samples_;
  std::vector<Worker> workers_;
};

}  // namespace

RenderProfile profile_of(const RenderScene& scene, const ir::RenderSettings& settings,
                         const ir::EffectSet& effects, ThreadPool& pool, std::int64_t samples) {
  return Profiler(scene, settings, effects, pool, samples).profile();
}

}  // namespace scenec::backend
