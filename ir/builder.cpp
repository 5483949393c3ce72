#include "ir/builder.hpp"

#include <string>
#include <utility>

#include "base/assert.hpp"
#include "ir/content_hash.hpp"
#include "ir/verify.hpp"

namespace scenec::ir {

std::size_t SceneBuilder::TransformHash::operator()(const Transform& transform) const {
  Hasher hasher;
  for (double entry : transform.m) hasher.add(entry);
  return static_cast<std::size_t>(hasher.result().low);
}

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
  const auto [place, added] = transforms_.try_emplace(transform);
  if (added) place->second = scene_.transforms.push(transform);
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
  return std::exchange(scene_, Scene{});
}

}  // namespace scenec::ir
