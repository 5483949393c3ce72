// One feeder walks every kind by its Schema, so a new key is hashed without a line here. Referenced
// parts enter by their own hash, computed once: ids and the order of declarations stay outside.
#pragma once

#include <algorithm>
#include <optional>
#include <string_view>
#include <vector>

#include "base/hash.hpp"
#include "ir/scene.hpp"

namespace scenec::ir {

// What stands for a part that another one refers to: all it says, or its name where it has one.
enum class Reference : std::uint8_t { content, name };

class ContentHasher {
 public:
  explicit ContentHasher(const Scene& scene, Reference reference = Reference::content)
      : scene_(scene),
        reference_(reference),
        textures_(scene.textures.size()),
        materials_(scene.materials.size()),
        protos_(scene.protos.size()) {
    // A row refers to earlier rows only (verify), so going through in order keeps recursion flat.
    for (std::uint32_t i = 0; i < textures_.size(); ++i) static_cast<void>(of(TextureId(i)));
    for (std::uint32_t i = 0; i < materials_.size(); ++i) static_cast<void>(of(MaterialId(i)));
    for (std::uint32_t i = 0; i < protos_.size(); ++i) static_cast<void>(of(ProtoId(i)));
  }

  Hash128 whole() {
    Hasher hasher;
    hasher.add(std::string_view("scenec-ir-1"));
    feed_items(hasher, scene_.items);
    hasher.add(scene_.lights.size());
    for (const Light& light : scene_.lights) feed_kind(hasher, light.kind);
    std::vector<Hash128> cameras;
    for (const Camera& camera : scene_.cameras) cameras.push_back(hash_of(camera));
    std::sort(cameras.begin(), cameras.end());
    hasher.add(cameras.size());
    for (const Hash128& camera : cameras) hasher.add(camera);
    feed_fields(hasher, scene_.render);
    hasher.add(scene_.render.background_written);
    return hasher.result();
  }

  Hash128 of(MaterialId id) {
    return memo(materials_[id.value()], [&](Hasher& hasher) {
      feed_kind(hasher, scene_.materials[id].kind);
      feed_fields(hasher, scene_.materials[id].common);
    });
  }
  Hash128 of(TextureId id) {
    return memo(textures_[id.value()], [&](Hasher& hasher) {
      const TextureNode& node = scene_.textures[id];
      hasher.add(node.kind.index());
      hasher.add(node.scalar);
      std::visit([&](const auto& texture) { feed_texture(hasher, texture); }, node.kind);
    });
  }
  Hash128 of(ProtoId id) {
    return memo(protos_[id.value()],
                [&](Hasher& hasher) { feed_items(hasher, scene_.protos[id].items); });
  }
  Hash128 of(const ShapeRef& shape) {
    Hasher hasher;
    feed_shape(hasher, shape);
    return hasher.result();
  }
  // Of any value a key may have.
  template <class T>
  Hash128 of_value(const T& value) {
    Hasher hasher;
    feed(hasher, value);
    return hasher.result();
  }

 private:
  template <class F>
  static Hash128 memo(std::optional<Hash128>& place, F&& feed_all) {
    if (!place) {
      Hasher hasher;
      feed_all(hasher);
      place = hasher.result();
    }
    return *place;
  }
  Hash128 hash_of(const Camera& camera) {
    Hasher hasher;
    feed_kind(hasher, camera.kind);
    return hasher.result();
  }

  void feed_items(Hasher& hasher, const std::vector<Item>& items) {
    hasher.add(items.size());
    for (const Item& item : items) {
      feed_shape(hasher, item.shape);
      const Transform transform = scene_.transforms[item.transform];
      hasher.add(transform.is_identity());
      if (!transform.is_identity()) feed(hasher, transform.m);
      feed(hasher, item.material);
    }
  }
  void feed_shape(Hasher& hasher, const ShapeRef& shape) {
    hasher.add(shape.index());
    std::visit([&](auto id) { feed_fields(hasher, scene_.shape(id)); }, shape);
  }
  template <class Variant>
  void feed_kind(Hasher& hasher, const Variant& kind) {
    hasher.add(kind.index());
    std::visit([&](const auto& fields) { feed_fields(hasher, fields); }, kind);
  }
  template <class T>
  void feed_fields(Hasher& hasher, const T& fields) {
    visit_keys<T>([&](const auto& key) { feed(hasher, fields.*key.member); });
  }

  void feed(Hasher& hasher, bool value) { hasher.add(value); }
  void feed(Hasher& hasher, double value) { hasher.add(value); }
  void feed(Hasher& hasher, std::int64_t value) { hasher.add(value); }
  void feed(Hasher& hasher, std::uint32_t value) { hasher.add(value); }
  template <NamedEnum E>
  void feed(Hasher& hasher, E value) {
    hasher.add(value);
  }
  template <class Tag>
  void feed(Hasher& hasher, const Quantity<Tag>& value) {
    hasher.add(value.value);
  }
  void feed(Hasher& hasher, const std::string& value) { hasher.add(std::string_view(value)); }
  void feed(Hasher& hasher, const Vec2& v) { hasher.add(v.x), hasher.add(v.y); }
  template <class T>
    requires(std::same_as<T, Vec3> || std::same_as<T, Direction> || std::same_as<T, Point3>)
  void feed(Hasher& hasher, const T& v) {
    hasher.add(v.x), hasher.add(v.y), hasher.add(v.z);
  }
  void feed(Hasher& hasher, const Color& c) { hasher.add(c.r), hasher.add(c.g), hasher.add(c.b); }
  void feed(Hasher& hasher, const Transform& t) { feed(hasher, t.m); }
  void feed(Hasher& hasher, const Curve& curve) {
    hasher.add(curve.kind), hasher.add(curve.clamped);
    feed(hasher, curve.points);
  }
  void feed(Hasher& hasher, const MeshNormals& normals) {
    hasher.add(normals.mode);
    feed(hasher, normals.list);
  }
  void feed(Hasher& hasher, const FocusDistance& focus) {
    hasher.add(focus.at_aim);
    if (!focus.at_aim) hasher.add(focus.distance.value);
  }
  void feed(Hasher& hasher, const PixelFilter& filter) {
    hasher.add(filter.kind), hasher.add(filter.radius);
  }
  void feed(Hasher& hasher, const ImageSize& size) {
    hasher.add(size.width), hasher.add(size.height);
  }
  void feed(Hasher& hasher, const Region& r) {
    hasher.add(r.x0), hasher.add(r.y0), hasher.add(r.x1), hasher.add(r.y1);
  }

  void feed(Hasher& hasher, AssetId id) {
    feed_optional(hasher, id, [&] { hasher.add(scene_.assets[id].hash); });
  }
  void feed(Hasher& hasher, TextureId id) {
    feed_optional(hasher, id, [&] { hasher.add(of(id)); });
  }
  void feed(Hasher& hasher, MaterialId id) {
    if (feed_name(hasher, id, scene_.material_names)) return;
    feed_optional(hasher, id, [&] { hasher.add(of(id)); });
  }
  void feed(Hasher& hasher, ProtoId id) {
    if (feed_name(hasher, id, scene_.proto_names)) return;
    feed_optional(hasher, id, [&] { hasher.add(of(id)); });
  }
  void feed(Hasher& hasher, CameraId id) {
    if (feed_name(hasher, id, scene_.camera_names)) return;
    feed_optional(hasher, id, [&] { hasher.add(hash_of(scene_.cameras[id])); });
  }
  template <class Id, class Names>
  bool feed_name(Hasher& hasher, Id id, const Names& names) {
    if (reference_ == Reference::content || !id.valid() || !names[id].name.valid()) return false;
    hasher.add(std::string_view(scene_.names[names[id].name]));
    return true;
  }
  template <class Tag, class F>
  static void feed_optional(Hasher& hasher, Id<Tag> id, F&& feed_target) {
    hasher.add(id.valid());
    if (id.valid()) feed_target();
  }

  template <class T>
  void feed(Hasher& hasher, const Input<T>& input) {
    feed(hasher, input.texture);
    if (!input.texture.valid()) feed(hasher, input.value);
  }
  template <class T>
  void feed(Hasher& hasher, const std::optional<T>& value) {
    hasher.add(value.has_value());
    if (value) feed(hasher, *value);
  }
  template <class T, std::size_t N>
  void feed(Hasher& hasher, const std::array<T, N>& values) {
    for (const T& value : values) feed(hasher, value);
  }
  template <class T>
  void feed(Hasher& hasher, const std::vector<T>& values) {
    hasher.add(values.size());
    for (const T& value : values) feed(hasher, value);
  }
  template <HasSchema T>
  void feed(Hasher& hasher, const T& block) {
    feed_fields(hasher, block);
  }

  void feed_texture(Hasher& hasher, const ImageTexture& t) {
    feed(hasher, t.file);
    hasher.add(t.wrap), hasher.add(t.filter), hasher.add(t.encoding);
    feed(hasher, t.scale);
  }
  void feed_texture(Hasher& hasher, const CheckerTexture& t) {
    feed(hasher, t.a), feed(hasher, t.b), hasher.add(t.scale);
  }
  void feed_texture(Hasher& hasher, const FractalTexture& t) {
    hasher.add(t.scale), hasher.add(t.octaves);
    feed(hasher, t.a), feed(hasher, t.b);
  }
  void feed_texture(Hasher& hasher, const RampTexture& t) {
    feed(hasher, t.t);
    hasher.add(t.stops.size());
    for (const auto& [at, color] : t.stops) hasher.add(at), feed(hasher, color);
  }
  void feed_texture(Hasher& hasher, const GridTexture& t) {
    feed(hasher, t.line), feed(hasher, t.fill);
    hasher.add(t.scale), hasher.add(t.width);
  }
  void feed_texture(Hasher& hasher, const ConstantTexture& t) { feed(hasher, t.color); }
  void feed_texture(Hasher& hasher, const ProductTexture& t) {
    feed(hasher, t.a), feed(hasher, t.b);
  }
  void feed_texture(Hasher& hasher, const MixTexture& t) {
    feed(hasher, t.a), feed(hasher, t.b), feed(hasher, t.t);
  }
  void feed_texture(Hasher& hasher, const ChannelTexture& t) {
    feed(hasher, t.source), hasher.add(t.channel);
  }

  const Scene& scene_;
  Reference reference_;
  std::vector<std::optional<Hash128>> textures_;
  std::vector<std::optional<Hash128>> materials_;
  std::vector<std::optional<Hash128>> protos_;
};

}  // namespace scenec::ir
