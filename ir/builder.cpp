#include "ir/builder.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "base/assert.hpp"
#include "ir/content_hash.hpp"
#include "ir/verify.hpp"

namespace scenec::ir {

namespace {

std::uint32_t hash_of(const Transform& transform) {
  return static_cast<std::uint32_t>(
      hash_bytes({reinterpret_cast<const char*>(transform.m.data()), sizeof transform.m}).low);
}

}  // namespace

SceneBuilder::SceneBuilder() {
  static_cast<void>(add_transform(Transform{}));
}

NameId SceneBuilder::add_name(std::string_view name) {
  if (name.empty()) return {};
  const auto [place, added] = names_.try_emplace(std::string(name));
  if (added) place->second = scene_.names.push(std::string(name));
  return place->second;
}

AssetId SceneBuilder::add_asset(Asset asset) {
  const auto [place, added] = assets_.try_emplace(asset.path);
  if (added) place->second = scene_.assets.push(std::move(asset));
  return place->second;
}

TextureId SceneBuilder::add_texture(TextureNode texture) {
  return scene_.textures.push(std::move(texture));
}

TransformId SceneBuilder::add_transform(const Transform& transform) {
  // The identity is the first row and by far the most frequent question.
  if (scene_.transforms.size() > 0 && transform.is_identity()) return TransformId(0);
  const std::uint32_t hash = hash_of(transform);
  TransformSlot& slot = recent_transforms_[hash & (remembered_transforms - 1)];
  const bool same =
      slot.row.valid() && slot.hash == hash && scene_.transforms.holds(slot.row, transform);
  if (!same) slot = {scene_.transforms.push(transform), hash};
  return slot.row;
}

ShapeRef SceneBuilder::add_shape(const Instance& instance) {
  const auto [place, added] = instances_.try_emplace(instance.of.value());
  if (added) place->second = std::get<Table<Instance>>(scene_.shapes).push(instance);
  return place->second;
}

MaterialId SceneBuilder::add_material(Material material, Declared declared) {
  scene_.material_names.push(declared);
  return scene_.materials.push(std::move(material));
}

CameraId SceneBuilder::add_camera(Camera camera, Declared declared) {
  scene_.camera_names.push(declared);
  return scene_.cameras.push(std::move(camera));
}

Id<Light> SceneBuilder::add_light(Light light, Declared declared) {
  scene_.light_names.push(declared);
  return scene_.lights.push(std::move(light));
}

ProtoId SceneBuilder::add_proto(Proto proto, Declared declared) {
  scene_.proto_names.push(declared);
  return scene_.protos.push(std::move(proto));
}

void SceneBuilder::set_render(RenderSettings settings, OriginId origin) {
  scene_.render = std::move(settings);
  scene_.render_origin = origin;
}

Scene SceneBuilder::finish() {
  SCENEC_ASSERT(find_violations(scene_).empty());
  scene_.hash = content_hash(scene_);
  std::fill(recent_transforms_.begin(), recent_transforms_.end(), TransformSlot{});
  return std::exchange(scene_, Scene{});
}

}  // namespace scenec::ir
