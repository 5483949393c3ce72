#include "backend/memory_use.hpp"

#include <memory>
#include <set>
#include <vector>

#include "backend/render_scene.hpp"

namespace scenec::backend {

namespace {

template <class T>
std::uint64_t once_each(const std::vector<std::shared_ptr<const T>>& values,
                        std::set<const void*>& counted) {
  std::uint64_t bytes = 0;
  for (const auto& value : values)
    if (value != nullptr && counted.insert(value.get()).second) bytes += memory_of(*value);
  return bytes;
}

}  // namespace

MemoryUse memory_use_of(const PreparedScene& prepared, const RenderScene& scene) {
  std::set<const void*> counted;
  MemoryUse use;
  use.meshes = once_each(prepared.meshes, counted) + once_each(scene.meshes, counted);
  use.images = once_each(prepared.images, counted) + once_each(scene.images, counted) +
               scene.textures.memory();
  use.accelerators = scene.accel.memory();
  // A map's entry: key, value, link.
  constexpr std::uint64_t map_entry = 32;
  use.shading = scene.lights.memory() + scene.casters.memory() +
                scene.materials.capacity() * sizeof(PreparedMaterial) +
                scene.items.capacity() * sizeof(RenderItem) +
                (scene.ggx_albedo ? sizeof(GgxAlbedo) : 0) +
                scene.instanced_emitters.size() * map_entry;
  return use;
}

}  // namespace scenec::backend
