// Where the time of a render goes and what its rays test, found by tracing a few of its samples
// again with a kernel that looks at the clock: the render itself pays nothing for it.
//
// The samples are spread evenly over the picture and at random over the numbers; they are traced
// twice, once for the times and once for the counts. The kernel is the one with all effects, whose
// shares differ a little from those of a smaller one.
#pragma once

#include <array>
#include <cstdint>

#include "backend/backend.hpp"

namespace scenec::backend {

struct RenderProfile {
  struct Rays {
    double share = 0;       // of the time
    double nodes = 0;       // visited a ray
    double primitives = 0;  // tested a ray
  };
  std::int64_t samples = 0;  // traced again; 0: none
  std::array<Rays, ray_kind_names.size()> rays{};
  double lights = 0;     // share of choosing lights and drawing points of them
  double materials = 0;  // share of textures and materials, what they reflect included
  double rest = 0;       // camera, random numbers, weights, film
};

// Takes about a hundredth of what `samples` a pixel have taken. No sample of the picture changes.
[[nodiscard]] RenderProfile profile_of(const RenderScene& scene, const ir::RenderSettings& settings,
                                       const ir::EffectSet& effects, ThreadPool& pool,
                                       std::int64_t samples);

}  // namespace scenec::backend
