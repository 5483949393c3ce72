// The work on one tile of the picture: from pixel and sample number to radiance in the film, by the
// kernel that holds the picture's effects and the fewest others. A tile belongs to one worker at a
// time; the numbers depend on scene, settings and effects only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <stop_token>

#include "backend/cameras/camera.hpp"
#include "backend/film/film.hpp"
#include "backend/film/filter.hpp"
#include "backend/integrators/kernel_set.hpp"
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

// What the tiles of one picture share.
struct TileJob {
  TraceJob trace;
  CameraSampler camera;
  FilterSampler filter;
};

class TileKernel {
 public:
  // `scene` and `settings` must outlive the kernel. `choice`: which of the compiled kernels runs;
  // none has an influence on the picture. `camera`, where there is one, stands for the scene's.
  TileKernel(const RenderScene& scene, const ir::RenderSettings& settings,
             const ir::EffectSet& effects, KernelChoice choice = KernelChoice::smallest,
             const ir::Camera* camera = nullptr);

  // Adds the samples of every pixel to the film. False when a stop request came in between: some
  // pixels then have fewer samples than others.
  [[nodiscard]] bool render(Film& film, const Tile& tile, const SampleRange& samples,
                            KernelWorker& worker, const std::stop_token& stop) const {
    return run_(job_, film, tile, samples, worker, stop);
  }

 private:
  TileJob job_;
  bool (*run_)(const TileJob&, Film&, const Tile&, const SampleRange&, KernelWorker&,
               const std::stop_token&);
};

}  // namespace scenec::backend
