// What integrators need of a scene: accelerators, lights, and for every hit what was hit.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "backend/accel/scene_accel.hpp"
#include "backend/lights/casters.hpp"
#include "backend/lights/light_table.hpp"
#include "backend/materials/prepared_material.hpp"
#include "backend/prepared_scene.hpp"
#include "backend/scene_facts.hpp"
#include "backend/textures/texture.hpp"

namespace scenec::backend {

// What Hit::item and Hit::instances number: placed items of the world, then of protos, then the
// shapes of lights.
struct RenderItem {
  static constexpr std::uint32_t none = 0xffffffff;
  ir::MaterialId material;     // invalid: a light, or an instance that keeps its materials
  std::uint32_t light = none;  // emitter of a light's shape
  std::uint32_t emitters =
      none;  // first emitter of an emissive item that stands in the world itself
};

struct RenderScene {
  explicit RenderScene(const PreparedScene& prepared);

  const ir::Scene* scene = nullptr;
  std::vector<std::shared_ptr<const DecodedImage>> images;
  TextureEvaluator textures;
  MaterialFacts facts;
  std::vector<std::shared_ptr<const TriangleMesh>> meshes;  // by Id<ir::Mesh>, as they are traced
  std::optional<GgxAlbedo> ggx_albedo;                      // only where a material needs it
  std::vector<PreparedMaterial> materials;                  // by MaterialId
  SceneAccel accel;
  std::vector<RenderItem> items;
  LightTable lights;
  CasterTable casters;
  // First emitter of emissive items inside instances, by path_key.
  std::unordered_map<std::uint64_t, std::uint32_t> instanced_emitters;
  // `.path`: paths of fewer bounces never end by chance. Has no influence on the mean.
  std::uint32_t sure_bounces = 3;
  double radius = 1;  // of a sphere round everything bounded

  // The material at a hit: the outermost instance that has one decides.
  [[nodiscard]] ir::MaterialId material_of(const Hit& hit) const;
  // The emitter that was hit, or none.
  [[nodiscard]] std::uint32_t emitter_of(const Hit& hit) const;
};

// 64 bits of the instances and the item of a hit. Two paths of one scene with the same key are as
// likely as a memory error.
[[nodiscard]] std::uint64_t path_key(const std::uint32_t* instances, std::uint32_t count,
                                     std::uint32_t item);

}  // namespace scenec::backend
