// A scene with its meshes and images in memory: what prepare() gives and build() takes. Parallel to
// the IR's tables; null where an entry is of no use (not a mesh, not an image).
#pragma once

#include <memory>
#include <vector>

#include "backend/geometry/mesh.hpp"
#include "backend/image/image.hpp"
#include "base/hash.hpp"
#include "ir/scene.hpp"

namespace scenec::backend {

struct PreparedScene {
  const ir::Scene* scene = nullptr;
  std::vector<std::shared_ptr<const TriangleMesh>> meshes;  // by Id<ir::Mesh>
  // What each of them was made from; zero: no file worth keeping anything of.
  std::vector<Hash128> mesh_keys;
  std::vector<std::shared_ptr<const DecodedImage>> images;  // by AssetId
};

}  // namespace scenec::backend
