// Rounds of samples over tiles and threads.
#include "backend/render_session.hpp"

#include <algorithm>
#include <atomic>

#include "backend/film/error.hpp"
#include "backend/film/film.hpp"
#include "backend/integrators/kernel.hpp"
#include "base/packed_bytes.hpp"

namespace scenec::backend {
namespace {

constexpr std::size_t tile_side = 16;
// Smaller where a tile is what gets more or fewer samples.
constexpr std::size_t adaptive_tile_side = 8;
// Fewer say next to nothing.
constexpr std::int64_t samples_before_estimate = 2 * replicate_count;

std::int64_t part_of(std::int64_t pixels, std::int64_t step) {
  return std::max<std::int64_t>(1, (pixels + step - 1) / step);
}

// The same view with fewer pixels and no layers.
ir::RenderSettings coarse_settings(ir::RenderSettings settings, std::int64_t step) {
  settings.size = {part_of(settings.size.width, step), part_of(settings.size.height, step)};
  if (auto& region = settings.region) {
    const ir::Region fine = *region;
    region->x0 = fine.x0 / step;
    region->y0 = fine.y0 / step;
    region->x1 = std::min(settings.size.width, region->x0 + part_of(fine.x1 - fine.x0, step));
    region->y1 = std::min(settings.size.height, region->y0 + part_of(fine.y1 - fine.y0, step));
  }
  settings.aovs.clear();
  return settings;
}

}  // namespace

struct RenderSession::Impl {
  Impl(const RenderScene& of_scene, const ir::RenderSettings& with_settings,
       const ir::EffectSet& with_effects, ThreadPool& on_pool, KernelChoice choice,
       const ir::Camera* camera, SampleSpread with_spread)
      : scene(of_scene),
        settings(with_settings),
        effects(with_effects),
        pool(on_pool),
        kernel(scene, settings, effects, choice, camera),
        film(settings),
        workers(pool.size()),
        side(with_spread == SampleSpread::adaptive ? adaptive_tile_side : tile_side),
        tiles_x((film.region_width() + side - 1) / side),
        tiles_y((film.region_height() + side - 1) / side) {
    if (with_spread == SampleSpread::even) return;
    std::vector<std::int64_t> pixels(tiles());
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const Tile t = tile(i);
      pixels[i] = static_cast<std::int64_t>((t.x1 - t.x0) * (t.y1 - t.y0));
    }
    plan.emplace(std::move(pixels), tiles_x);
  }

  [[nodiscard]] Tile tile(std::size_t number) const {
    const std::size_t x0 = number % tiles_x * side;
    const std::size_t y0 = number / tiles_x * side;
    return {x0, y0, std::min(x0 + side, film.region_width()),
            std::min(y0 + side, film.region_height())};
  }
  [[nodiscard]] std::size_t tiles() const { return tiles_x * tiles_y; }

  // Numbers of the samples of a tile that take the picture from one mean number to another.
  [[nodiscard]] SampleRange range(std::size_t number, std::int64_t first, std::int64_t end) const {
    if (!plan) return {first, end};
    return {plan->count(number, first), plan->count(number, end)};
  }
  void begin_stage() {
    const std::vector<double> pixels = squared_errors_of(film, pool);
    std::vector<double> sums(pixels.empty() ? 0 : tiles());
    for (std::size_t i = 0; i < sums.size(); ++i) {
      const Tile t = tile(i);
      for (std::size_t y = t.y0; y < t.y1; ++y)
        for (std::size_t x = t.x0; x < t.x1; ++x) sums[i] += pixels[y * film.region_width() + x];
    }
    plan->next_stage(sums);
  }
  bool render_round(std::int64_t samples, const std::stop_token& stop,
                    const std::function<void(double)>& part_done);

  const RenderScene& scene;
  const ir::RenderSettings settings;
  ir::EffectSet effects;
  ThreadPool& pool;
  TileKernel kernel;
  Film film;
  std::vector<KernelWorker> workers;
  std::size_t side;
  std::size_t tiles_x;
  std::size_t tiles_y;
  ErrorEstimate estimate;
  std::int64_t estimated_at = 0;   // samples; 0: not yet
  std::optional<SamplePlan> plan;  // none: every pixel gets the same
};

RenderSession::RenderSession(const RenderScene& scene, const ir::RenderSettings& settings,
                             const ir::EffectSet& effects, ThreadPool& pool, KernelChoice kernel,
                             const ir::Camera* camera, SampleSpread spread) {
  SCENEC_ASSERT(settings.camera.valid());
  impl_ = std::make_unique<Impl>(scene, settings, effects, pool, kernel, camera, spread);
}
RenderSession::~RenderSession() = default;
RenderSession::RenderSession(RenderSession&&) noexcept = default;
RenderSession& RenderSession::operator=(RenderSession&&) noexcept = default;

bool RenderSession::Impl::render_round(std::int64_t samples, const std::stop_token& stop,
                                       const std::function<void(double)>& part_done) {
  const std::int64_t first = film.samples();
  std::atomic<std::size_t> done{0};
  std::atomic<bool> cut{false};
  film.begin_round();
  const bool all = pool.for_each(
      tiles(),
      [&](std::size_t number, unsigned worker) {
        if (!kernel.render(film, tile(number), range(number, first, first + samples),
                           workers[worker], stop)) {
          cut.store(true, std::memory_order_relaxed);
          return;
        }
        const std::size_t finished = done.fetch_add(1, std::memory_order_relaxed) + 1;
        part_done(static_cast<double>(finished) / static_cast<double>(tiles()));
      },
      stop);
  if (!all || cut.load()) {
    film.drop_round();
    return false;
  }
  film.finish_round(samples);
  return true;
}

bool RenderSession::advance(std::int64_t samples, const std::stop_token& stop,
                            const PartFunction& part_done) {
  Impl& my = *impl_;
  const std::int64_t first = my.film.samples();
  const std::int64_t end = first + samples;
  // A stage of the plan ends a round.
  while (my.film.samples() < end) {
    if (my.plan && my.film.samples() == my.plan->stage_end()) my.begin_stage();
    const std::int64_t now = my.film.samples();
    const std::int64_t until = my.plan ? std::min(end, my.plan->stage_end()) : end;
    const auto told = [&](double part) {
      if (!part_done) return;
      const double at = static_cast<double>(now - first) + part * static_cast<double>(until - now);
      part_done(at / static_cast<double>(samples));
    };
    if (!my.render_round(until - now, stop, told)) return false;
  }
  return true;
}

std::int64_t RenderSession::samples() const {
  return impl_->film.samples();
}

Picture RenderSession::picture() const {
  Picture picture = impl_->film.picture();
  picture.rays = rays();
  for (const KernelWorker& worker : impl_->workers) {
    picture.forgotten_media += worker.rays.forgotten_media;
    for (std::size_t i = 0; i < ir::effect_count; ++i)
      picture.effect_runs[i] += worker.rays.effects[i];
  }
  return picture;
}

ErrorEstimate RenderSession::error() const {
  Impl& my = *impl_;
  if (my.film.samples() < samples_before_estimate) return {};
  // Whoever decided by it and whoever tells it at the end ask for the same one.
  if (my.estimated_at != my.film.samples()) {
    my.estimate = error_of(my.film, my.pool);
    my.estimated_at = my.film.samples();
  }
  return my.estimate;
}

RayCounts RenderSession::rays() const {
  RayCounts sum{};
  for (const KernelWorker& worker : impl_->workers) {
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += worker.rays.rays[i];
  }
  return sum;
}

std::uint64_t RenderSession::memory() const {
  return impl_->film.memory();
}

std::string RenderSession::save() const {
  std::string sums = impl_->film.save();
  if (!impl_->plan) return sums;
  std::string bytes;
  append_packed(bytes, static_cast<std::uint64_t>(sums.size()));
  return bytes + sums + impl_->plan->save();
}

bool RenderSession::restore(std::string_view bytes) {
  Impl& my = *impl_;
  my.estimated_at = 0;
  if (!my.plan) return my.film.restore(bytes);
  PackedReader reader(bytes);
  const auto size = reader.value<std::uint64_t>();
  const std::string_view sums = reader.take(size);
  if (!reader.ok()) return false;
  SamplePlan plan = *my.plan;
  if (!plan.restore(bytes.substr(sizeof size + sums.size())) || !my.film.restore(sums))
    return false;
  my.plan = std::move(plan);
  return true;
}

std::optional<Picture> coarse_picture(const RenderScene& scene, const ir::RenderSettings& settings,
                                      const ir::EffectSet& effects, ThreadPool& pool, int step,
                                      const std::stop_token& stop, const ir::Camera* camera) {
  SCENEC_ASSERT(step >= 1);
  RenderSession coarse(scene, coarse_settings(settings, step), effects, pool,
                       KernelChoice::smallest, camera);
  if (!coarse.advance(1, stop)) return std::nullopt;
  return coarse.picture();
}

}  // namespace scenec::backend
