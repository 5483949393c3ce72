// The loop over the pixels and samples of a tile, for one method and one set of effects.
#pragma once

#include "backend/integrators/kernel.hpp"
#include "backend/integrators/path-inl.hpp"
#include "backend/integrators/phong-inl.hpp"
#include "backend/integrators/whitted-inl.hpp"

namespace scenec::backend {

template <ir::Method method, EffectMask compiled>
TracedSample trace_sample(const Tracer<compiled>& tracer, const Ray& ray, const Sampler& sampler,
                          [[maybe_unused]] KernelWorker& worker) {
  if constexpr (method == ir::Method::path) {
    return PathTracer<compiled>(tracer, sampler).trace(ray);
  } else if constexpr (method == ir::Method::whitted) {
    return WhittedTracer<compiled>(tracer, sampler, worker.branches).trace(ray);
  } else {
    return trace_phong(tracer, ray, sampler);
  }
}

template <ir::Method method, EffectMask compiled>
bool render_tile(const TileJob& job, Film& film, const Tile& tile, const SampleRange& samples,
                 KernelWorker& worker, const std::stop_token& stop) {
  const Tracer<compiled> tracer(job.trace, worker.rays);
  const ir::RenderSettings& settings = job.trace.settings;
  const auto seed = static_cast<std::uint64_t>(settings.seed);
  const bool has_lens = job.camera.has_lens();
  for (std::size_t y = tile.y0; y < tile.y1; ++y) {
    const std::int64_t py = film.region().y0 + static_cast<std::int64_t>(y);
    for (std::size_t x = tile.x0; x < tile.x1; ++x) {
      const std::int64_t px = film.region().x0 + static_cast<std::int64_t>(x);
      const auto pixel = static_cast<std::uint64_t>(py * settings.size.width + px);
      Film::Pixel sums = film.open(x, y);
      for (std::int64_t number = samples.first; number < samples.end; ++number) {
        if (stop.stop_requested()) return false;
        const ReplicateSample one = replicate_sample(seed, static_cast<std::uint64_t>(number));
        const Sampler sampler(settings.sampler, one.seed, pixel, one.number);
        FilmSample out;
        // film .course: the lower left corner.
        double film_x = static_cast<double>(px);
        double film_y = static_cast<double>(py + 1);
        if (settings.film == ir::FilmKind::standard) {
          const FilterSample offset = job.filter.sample(sampler.get_2d(dimension::pixel_filter));
          film_x = static_cast<double>(px) + 0.5 + offset.dx;
          film_y = static_cast<double>(py) + 0.5 + offset.dy;
          out.weight = offset.weight;
        }
        Sample2 lens;
        if (has_lens) {
          tracer.count(ir::Effect::depth_of_field);
          lens = sampler.get_2d(dimension::lens);
        }
        const TracedSample traced =
            trace_sample<method>(tracer, job.camera.ray(film_x, film_y, lens), sampler, worker);
        out.radiance = traced.radiance;
        out.covered = traced.covered;
        if (job.trace.wants_first_hit) out.first = traced.first;
        sums.add(number, out);
      }
      sums.close();
    }
  }
  return true;
}

}  // namespace scenec::backend
