#include "backend/integrators/kernel.hpp"

namespace scenec::backend {

TileKernel::TileKernel(const RenderScene& scene, const ir::RenderSettings& settings,
                       const ir::EffectSet& effects)
    : scene_(scene),
      settings_(settings),
      effects_(effects),
      camera_(scene.scene->cameras[settings.camera], settings.size,
              effects.has(ir::Effect::depth_of_field) ? CameraSampler::Lens::simulated
                                                      : CameraSampler::Lens::left_out),
      filter_(settings.filter) {}

bool TileKernel::render(Film& film, const Tile& tile, const SampleRange& samples,
                        KernelWorker& worker, const std::stop_token& stop) const {
  const Tracer tracer(scene_, settings_, effects_, worker.rays);
  for (std::size_t y = tile.y0; y < tile.y1; ++y) {
    const std::int64_t py = film.region().y0 + static_cast<std::int64_t>(y);
    for (std::size_t x = tile.x0; x < tile.x1; ++x) {
      const std::int64_t px = film.region().x0 + static_cast<std::int64_t>(x);
      for (std::int64_t number = samples.first; number < samples.end; ++number) {
        if (stop.stop_requested()) return false;
        film.add(x, y, sample(tracer, px, py, number, worker));
      }
    }
  }
  return true;
}

FilmSample TileKernel::sample(const Tracer& tracer, std::int64_t px, std::int64_t py,
                              std::int64_t number, KernelWorker& worker) const {
  const auto pixel = static_cast<std::uint64_t>(py * settings_.size.width + px);
  const Sampler sampler(settings_.sampler, static_cast<std::uint64_t>(settings_.seed), pixel,
                        static_cast<std::uint64_t>(number));
  FilmSample out;
  // film .course: the lower left corner.
  double film_x = static_cast<double>(px);
  double film_y = static_cast<double>(py + 1);
  if (settings_.film == ir::FilmKind::standard) {
    const FilterSample offset = filter_.sample(sampler.get_2d(dimension::pixel_filter));
    film_x = static_cast<double>(px) + 0.5 + offset.dx;
    film_y = static_cast<double>(py) + 0.5 + offset.dy;
    out.weight = offset.weight;
  }
  const Sample2 lens = camera_.has_lens() ? sampler.get_2d(dimension::lens) : Sample2{};
  const TracedSample traced = trace(tracer, camera_.ray(film_x, film_y, lens), sampler, worker);
  out.radiance = traced.radiance;
  out.covered = traced.covered;
  out.first = traced.first;
  return out;
}

TracedSample TileKernel::trace(const Tracer& tracer, const Ray& ray, const Sampler& sampler,
                               KernelWorker& worker) const {
  switch (settings_.method) {
    case ir::Method::path:
      return trace_path(tracer, ray, sampler);
    case ir::Method::whitted:
      return trace_whitted(tracer, ray, sampler, worker.branches);
    case ir::Method::phong:
      return trace_phong(tracer, ray, sampler);
  }
  return {};
}

}  // namespace scenec::backend
