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

// The slot that holds the row, or the first free one on its way.
template <class Slots, class IsSame>
auto& slot_of(Slots& index, std::uint32_t hash, IsSame&& is_same) {
  const std::size_t mask = index.size() - 1;
  std::size_t slot = hash & mask;
  while (index[slot].row.valid() && !(index[slot].hash == hash && is_same(index[slot].row)))
    slot = (slot + 1) & mask;
  return index[slot];
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
  if (3 * (scene_.transforms.size() + 1) > 2 * transform_index_.size()) grow_transform_index();
  const std::uint32_t hash = hash_of(transform);
  TransformSlot& slot = slot_of(transform_index_, hash, [&](TransformId row) {
    return scene_.transforms.holds(row, transform);
  });
  if (!slot.row.valid()) slot = {scene_.transforms.push(transform), hash};
  return slot.row;
}

void SceneBuilder::grow_transform_index() {
  constexpr std::size_t smallest = 16;
  std::vector<TransformSlot> larger(std::max(smallest, 2 * transform_index_.size()));
  for (const TransformSlot& slot : transform_index_) {
    if (slot.row.valid()) slot_of(larger, slot.hash, [](TransformId) { return false; }) = slot;
  }
  transform_index_ = std::move(larger);
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
  transform_index_ = {};  // memory the next step may need
  SCENEC_ASSERT(find_violations(scene_).empty());
  scene_.hash = content_hash(scene_);
  return std::exchange(scene_, Scene{});
}

}  // namespace scenec::ir
