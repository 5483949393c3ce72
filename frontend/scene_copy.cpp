#include "frontend/scene_copy.hpp"

#include <concepts>
#include <memory>
#include <utility>

#include "ir/schema.hpp"

namespace scenec::frontend {

namespace {
// Rows refer to rows, values hold values: deeper than any library needs, shallow for the stack.
constexpr std::uint32_t deepest = 200;
}  // namespace

template <class Tag, class Make>
Id<Tag> SceneCopy::once(Rows rows, Id<Tag> id, Make&& make) {
  if (!id.valid()) return id;
  if (const auto known = (ends_.rows.*rows).find(id.value()); known != (ends_.rows.*rows).end())
    return Id<Tag>(known->second);
  if (depth_ >= deepest) {
    sound_ = false;
    return {};
  }
  ++depth_;
  const Id<Tag> made = make();
  --depth_;
  (ends_.rows.*rows).emplace(id.value(), made.value());
  (ends_.back.*rows).emplace(made.value(), id.value());
  return made;
}

Span SceneCopy::copy(Span span) {
  if (!span.valid()) return span;
  const FileId file = ends_.file_of(span.file);
  sound_ = sound_ && file.valid();
  return {file, span.begin, span.end};
}

ir::NameId SceneCopy::copy(ir::NameId id) {
  return id.valid() ? ends_.to.add_name(ends_.from.names[id]) : id;
}

ir::OriginId SceneCopy::copy(ir::OriginId id) {
  return once(&RowMap::origins, id, [&] {
    const ir::Origin& origin = ends_.from.origins[id];
    return ends_.to.add_origin({copy(origin.span), copy(origin.parent), origin.kind});
  });
}

ir::Declared SceneCopy::copy(const ir::Declared& declared) {
  return {copy(declared.name), copy(declared.origin)};
}

ir::AssetId SceneCopy::copy(ir::AssetId id) {
  return once(&RowMap::assets, id, [&] {
    const ir::Asset& asset = ends_.from.assets[id];
    return ends_.to.add_asset({asset.path, asset.hash, copy(asset.span)});
  });
}

template <class Fields>
void SceneCopy::renumber_keys(Fields& fields) {
  ir::visit_keys<Fields>([&](const auto& key) {
    auto& member = fields.*key.member;
    if constexpr (requires { member.texture; }) {
      member.texture = copy(member.texture);
    } else if constexpr (requires { member = this->copy(member); }) {
      if constexpr (requires { member.valid(); }) member = copy(member);
    }
  });
}

template <class Texture>
void SceneCopy::renumber_texture(Texture& texture) {
  if constexpr (requires { texture.a; }) texture.a.texture = copy(texture.a.texture);
  if constexpr (requires { texture.b; }) texture.b.texture = copy(texture.b.texture);
  if constexpr (requires { texture.t; }) texture.t.texture = copy(texture.t.texture);
  if constexpr (requires { texture.line; }) texture.line.texture = copy(texture.line.texture);
  if constexpr (requires { texture.fill; }) texture.fill.texture = copy(texture.fill.texture);
  if constexpr (requires { texture.source; }) texture.source = copy(texture.source);
  if constexpr (requires { texture.file; }) texture.file = copy(texture.file);
}

ir::TextureId SceneCopy::copy(ir::TextureId id) {
  return once(&RowMap::textures, id, [&] {
    ir::TextureNode node = ends_.from.textures[id];
    std::visit([&](auto& texture) { renumber_texture(texture); }, node.kind);
    return ends_.to.add_texture(std::move(node));
  });
}

ir::MaterialId SceneCopy::copy(ir::MaterialId id) {
  return once(&RowMap::materials, id, [&] {
    ir::Material material = ends_.from.materials[id];
    std::visit([&](auto& kind) { renumber_keys(kind); }, material.kind);
    renumber_keys(material.common);
    const ir::Declared declared = copy(ends_.from.material_names[id]);
    return ends_.to.add_material(std::move(material), declared);
  });
}

ir::Item SceneCopy::copy(const ir::Item& item) {
  ir::Item made;
  std::visit(
      [&]<class Shape>(Id<Shape> id) {
        Shape shape = ends_.from.shape(id);
        renumber_keys(shape);
        made.shape = ends_.to.add_shape(std::move(shape));
      },
      item.shape);
  made.transform = ends_.to.add_transform(ends_.from.transforms[item.transform]);
  made.material = copy(item.material);
  made.origin = copy(item.origin);
  made.name = copy(item.name);
  return made;
}

ir::ProtoId SceneCopy::copy(ir::ProtoId id) {
  return once(&RowMap::protos, id, [&] {
    ir::Proto proto;
    for (const ir::Item& item : ends_.from.protos[id].items) proto.items.push_back(copy(item));
    const ir::Declared declared = copy(ends_.from.proto_names[id]);
    return ends_.to.add_proto(std::move(proto), declared);
  });
}

Value SceneCopy::operator()(const Value& value) {
  Value made = value;
  const auto take = [&](auto id) { made.integer = id.value(); };
  switch (value.type) {
    case Type::string:
      take(copy(Span{value.id<SourceFile>(), 0, 0}).file);
      break;
    case Type::texture:
      if (value.known) take(copy(value.id<ir::TextureNode>()));
      break;
    case Type::material:
      if (value.known) take(copy(value.id<ir::Material>()));
      break;
    case Type::proto:
      if (value.known) take(copy(value.id<ir::Proto>()));
      break;
    case Type::list: {
      if (value.heap == nullptr) break;
      if (depth_ >= deepest) {
        sound_ = false;
        break;
      }
      ++depth_;
      ValueList elements;
      elements.reserve(value.elements().size());
      for (const Value& element : value.elements()) elements.push_back((*this)(element));
      made.heap = std::make_shared<const Heap>(Heap{std::move(elements)});
      --depth_;
      break;
    }
    default:
      break;
  }
  return made;
}

}  // namespace scenec::frontend
