// The work on one tile of the picture: from pixel and sample number to radiance in the film. A tile
// belongs to one worker at a time; the numbers depend on scene, settings and effects only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <stop_token>

#include "backend/cameras/camera.hpp"
#include "backend/film/film.hpp"
#include "backend/film/filter.hpp"
#include "backend/integrators/tracer.hpp"

namespace scenec::backend {

// Pixels of the film's region, ends left out.
struct Tile {
  std::size_t x0 = 0, y0 = 0;
  std::size_t x1 = 0, y1 = 0;
};
// Numbers of samples of a pixel, the end left out.
struct SampleRange {
  std::int64_t first = 0;
  std::int64_t end = 0;
};

// What a worker keeps from tile to tile. Workers do not share cache lines.
struct alignas(64) KernelWorker {
  RayCounters rays;
  BranchStack branches;
};

class TileKernel {
 public:
  // All three must outlive the kernel.
  TileKernel(const RenderScene& scene, const ir::RenderSettings& settings,
             const ir::EffectSet& effects);

  // Adds the samples of every pixel to the film. False when a stop request came in between: some
  // pixels then have fewer samples than others.
  [[nodiscard]] bool render(Film& film, const Tile& tile, const SampleRange& samples,
                            KernelWorker& worker, const std::stop_token& stop) const;

 private:
  [[nodiscard]] FilmSample sample(const Tracer& tracer, std::int64_t px, std::int64_t py,
                                  std::int64_t number, KernelWorker& worker) const;
  [[nodiscard]] TracedSample trace(const Tracer& tracer, const Ray& ray, const Sampler& sampler,
                                   KernelWorker& worker) const;

  const RenderScene& scene_;
  const ir::RenderSettings& settings_;
  ir::EffectSet effects_;
  CameraSampler camera_;
  FilterSampler filter_;
};

}  // namespace scenec::backend
