// Rounds of samples over tiles and threads.
#include "backend/render_session.hpp"

#include <algorithm>
#include <atomic>

#include "backend/film/error.hpp"
#include "backend/film/film.hpp"
#include "backend/integrators/kernel.hpp"

namespace scenec::backend {
namespace {

constexpr std::size_t tile_side = 16;
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
       const ir::Camera* camera)
      : scene(of_scene),
        settings(with_settings),
        effects(with_effects),
        pool(on_pool),
        kernel(scene, settings, effects, choice, camera),
        film(settings),
        workers(pool.size()),
        tiles_x((film.region_width() + tile_side - 1) / tile_side),
        tiles_y((film.region_height() + tile_side - 1) / tile_side) {}

  [[nodiscard]] Tile tile(std::size_t number) const {
    const std::size_t x0 = number % tiles_x * tile_side;
    const std::size_t y0 = number / tiles_x * tile_side;
    return {x0, y0, std::min(x0 + tile_side, film.region_width()),
            std::min(y0 + tile_side, film.region_height())};
  }

  const RenderScene& scene;
  const ir::RenderSettings settings;
  ir::EffectSet effects;
  ThreadPool& pool;
  TileKernel kernel;
  Film film;
  std::vector<KernelWorker> workers;
  std::size_t tiles_x;
  std::size_t tiles_y;
};

RenderSession::RenderSession(const RenderScene& scene, const ir::RenderSettings& settings,
                             const ir::EffectSet& effects, ThreadPool& pool, KernelChoice kernel,
                             const ir::Camera* camera) {
  SCENEC_ASSERT(settings.camera.valid());
  impl_ = std::make_unique<Impl>(scene, settings, effects, pool, kernel, camera);
}
RenderSession::~RenderSession() = default;
RenderSession::RenderSession(RenderSession&&) noexcept = default;
RenderSession& RenderSession::operator=(RenderSession&&) noexcept = default;

bool RenderSession::advance(std::int64_t samples, const std::stop_token& stop,
                            const PartFunction& part_done) {
  Impl& my = *impl_;
  const std::size_t tiles = my.tiles_x * my.tiles_y;
  const SampleRange range{my.film.samples(), my.film.samples() + samples};
  std::atomic<std::size_t> done{0};
  std::atomic<bool> cut{false};
  my.film.begin_round();
  const bool all = my.pool.for_each(
      tiles,
      [&](std::size_t number, unsigned worker) {
        if (!my.kernel.render(my.film, my.tile(number), range, my.workers[worker], stop)) {
          cut.store(true, std::memory_order_relaxed);
          return;
        }
        const std::size_t finished = done.fetch_add(1, std::memory_order_relaxed) + 1;
        if (part_done) part_done(static_cast<double>(finished) / static_cast<double>(tiles));
      },
      stop);
  if (!all || cut.load()) {
    my.film.drop_round();
    return false;
  }
  my.film.finish_round(samples);
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
  if (impl_->film.samples() < samples_before_estimate) return {};
  return error_of(impl_->film, impl_->pool);
}

std::uint64_t RenderSession::rays() const {
  std::uint64_t sum = 0;
  for (const KernelWorker& worker : impl_->workers) sum += worker.rays.rays;
  return sum;
}

std::string RenderSession::save() const {
  return impl_->film.save();
}

bool RenderSession::restore(std::string_view bytes) {
  return impl_->film.restore(bytes);
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
