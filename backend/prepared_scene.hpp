// A scene with its meshes and images in memory: what prepare() gives and build() takes. Parallel to
// the IR's tables; null where an entry is of no use (not a mesh, not an image).
#pragma once

#include <memory>
#include <vector>

#include "backend/geometry/mesh.hpp"
#include "backend/image/image.hpp"
#include "ir/scene.hpp"

namespace scenec::backend {

struct PreparedScene {
  const ir::Scene* scene = nullptr;
  std::vector<std::shared_ptr<const TriangleMesh>> meshes;  // by Id<ir::Mesh>
  std::vector<std::shared_ptr<const DecodedImage>> images;  // by AssetId
};

}  // namespace scenec::backend
