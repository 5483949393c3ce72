#include "backend/build.hpp"

#include <algorithm>
#include <cmath>

#include "backend/accel/tree_store.hpp"
#include "backend/backend.hpp"
#include "backend/math/rng.hpp"

namespace scenec::backend {

void destroy(RenderScene* scene) {
  delete scene;
}

RenderScene::RenderScene(const PreparedScene& prepared)
    : scene(prepared.scene),
      images(prepared.images),
      textures(*prepared.scene, images),
      facts(*prepared.scene),
      meshes(prepared.meshes) {}

std::uint64_t path_key(const std::uint32_t* instances, std::uint32_t count, std::uint32_t item) {
  std::uint64_t key = mix_bits(item + 1);
  for (std::uint32_t i = 0; i < count; ++i)
    key = mix_bits(key + 0x9e3779b97f4a7c15ULL * (instances[i] + 1));
  return key;
}

ir::MaterialId RenderScene::material_of(const Hit& hit) const {
  for (std::uint32_t i = 0; i < hit.instance_count; ++i) {
    const ir::MaterialId replaced = items[hit.instances[i]].material;
    if (replaced.valid()) return replaced;
  }
  return items[hit.item].material;
}

std::uint32_t RenderScene::emitter_of(const Hit& hit) const {
  const RenderItem& item = items[hit.item];
  if (item.light != RenderItem::none) return item.light;
  if (hit.instance_count == 0)
    return item.emitters == RenderItem::none ? RenderItem::none : item.emitters + hit.primitive;
  const auto found =
      instanced_emitters.find(path_key(hit.instances.data(), hit.instance_count, hit.item));
  return found == instanced_emitters.end() ? RenderItem::none : found->second + hit.primitive;
}

RenderScenePtr build(const PreparedScene& prepared, ThreadPool& pool, const BuildOptions& options) {
  RenderScenePtr scene(new RenderScene(prepared));
  if (scene->facts.any_facets()) scene->ggx_albedo.emplace();
  scene->materials = prepare_materials(*scene->scene, image_facts(*scene),
                                       scene->ggx_albedo ? &*scene->ggx_albedo : nullptr);
  add_items(prepared, *scene, pool, options);
  add_lights(prepared, *scene);
  add_casters(*scene);
  build_world(scene->accel, pool, options);
  if (options.trees != nullptr) options.trees->drop_unused();
  const Bounds3 bounds = scene->accel.bounds();
  if (!bounds.empty() && bounds.finite())
    scene->radius = std::fmax(length(bounds.extent()) / 2, 0x1p-500);
  scene->lights.finish(scene->radius);
  return scene;
}

}  // namespace scenec::backend
