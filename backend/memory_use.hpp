// Bytes of what a scene keeps in memory while it is rendered, by what they are for. What several
// share counts once.
#pragma once

#include <cstdint>

#include "backend/backend.hpp"

namespace scenec::backend {

struct MemoryUse {
  std::uint64_t meshes = 0;        // vertices and faces, as read and as traced
  std::uint64_t images = 0;        // decoded, with their smaller versions
  std::uint64_t accelerators = 0;  // trees, shapes and where they are placed
  std::uint64_t shading = 0;       // materials and lights
};
[[nodiscard]] MemoryUse memory_use_of(const PreparedScene& prepared, const RenderScene& scene);

}  // namespace scenec::backend
