// The only way to make a Scene. Interns transforms and names, deduplicates assets by path, checks
// the invariants (verify) and hashes at the end.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "ir/scene.hpp"

namespace scenec::ir {

class SceneBuilder {
 public:
  SceneBuilder();

  OriginId add_origin(Origin origin) { return scene_.origins.push(origin); }
  NameId add_name(std::string_view name);  // equal names share an id; "" gives the invalid id
  AssetId add_asset(Asset asset);          // a second asset of the same path gives the first id
  TextureId add_texture(TextureNode texture);
  // Equal transforms share an id, unless thousands of others came between them.
  TransformId add_transform(const Transform& transform);
  MaterialId add_material(Material material, Declared declared);
  CameraId add_camera(Camera camera, Declared declared);
  Id<Light> add_light(Light light, Declared declared);
  ProtoId add_proto(Proto proto, Declared declared);

  template <class T>
  ShapeRef add_shape(T shape) {
    return std::get<Table<T>>(scene_.shapes).push(std::move(shape));
  }
  // Equal instances share a row: millions of them differ in their place only.
  ShapeRef add_shape(const Instance& instance);
  // Places an item in the world; items of protos are collected by the caller.
  void place(Item item) { scene_.items.push_back(item); }
  void set_render(RenderSettings settings, OriginId origin);

  [[nodiscard]] const Scene& scene() const { return scene_; }
  // Verifies (an invariant that does not hold is an assertion: the frontend let it through),
  // hashes, and gives the scene away. The builder is empty afterwards.
  [[nodiscard]] Scene finish();

 private:
  Scene scene_;
  std::unordered_map<std::string, NameId> names_;
  std::unordered_map<std::string, AssetId> assets_;
  std::unordered_map<std::uint32_t, Id<Instance>> instances_;  // by the proto's number
  // The rows of scene_.transforms that were asked for last, each in the place its hash gives it. A
  // table of all would outgrow the caches with a scene of a million instances, whose transforms
  // differ anyway.
  struct TransformSlot {
    TransformId row;
    std::uint32_t hash = 0;  // tells most rows apart without reading them
  };
  static constexpr std::size_t remembered_transforms = 8192;  // a power of two
  std::vector<TransformSlot> recent_transforms_ = std::vector<TransformSlot>(remembered_transforms);
};

}  // namespace scenec::ir
