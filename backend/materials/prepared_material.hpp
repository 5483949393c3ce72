// Materials made ready once a scene: what is the same at every hit is looked up, folded and
// converted before the first ray.
#pragma once

#include <vector>

#include "backend/materials/bsdf.hpp"
#include "ir/folding.hpp"
#include "ir/scene.hpp"

namespace scenec::backend {

struct PreparedMaterial {
  enum class Use : std::uint8_t {
    matt,      // `albedo` is all there is to know
    constant,  // `bsdf` but for what depends on the viewer
    varied,    // textures, a normal map or a mix: resolved at every hit
  };
  Use use = Use::varied;
  double ior = 1;  // inside over outside; 1 for what has no inside
  Rgb albedo;
  Bsdf bsdf;
};

// `ggx_albedo`: for the materials that need it; must outlive the result.
[[nodiscard]] std::vector<PreparedMaterial> prepare_materials(const ir::Scene& scene,
                                                              const ir::ImageFacts& images,
                                                              const GgxAlbedo* ggx_albedo);

}  // namespace scenec::backend
