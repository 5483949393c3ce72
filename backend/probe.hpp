// What is under a place of the picture: for pages that lead from a pixel to the line that made it.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "backend/backend.hpp"

namespace scenec::backend {

struct ProbeResult {
  // Indices of ir::Scene::items: of the shape, or of the instances round it, outermost first, and
  // then of the shape in its proto.
  struct Step {
    std::optional<ir::ProtoId> proto;  // none: the world
    std::uint32_t item = 0;
  };
  std::vector<Step> path;  // empty: the shape of a light
  ir::MaterialId material;
  double distance = 0;
  ir::Point3 point;
  ir::Vec3 normal;  // of the surface, not turned
};

// The first thing the camera's ray through the middle of the pixel meets, see-through or not.
[[nodiscard]] std::optional<ProbeResult> probe(const RenderScene& scene,
                                               const ir::RenderSettings& settings, std::int64_t x,
                                               std::int64_t y, const ir::Camera* camera = nullptr);

}  // namespace scenec::backend
