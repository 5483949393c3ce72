// A valid scene: immutable tables of values that refer to each other by id. Made by SceneBuilder
// only. Positions in source text live in the origin table and never enter the content hash.
#pragma once

#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "base/hash.hpp"
#include "base/ids.hpp"
#include "base/span.hpp"
#include "ir/cameras.hpp"
#include "ir/lights.hpp"
#include "ir/materials.hpp"
#include "ir/render_settings.hpp"
#include "ir/shapes.hpp"
#include "ir/textures.hpp"
#include "ir/transform_table.hpp"
#include "ir/values.hpp"

namespace scenec::ir {

// Where a part of the scene was written; `parent` leads outwards through macro calls and loops.
struct Origin;
using OriginId = Id<Origin>;
enum class OriginKind : std::uint8_t { written, expanded_from, included_from };
struct Origin {
  Span span;
  OriginId parent;
  OriginKind kind = OriginKind::written;  // of the step to `parent`
};

using NameId = Id<std::string>;
using TransformId = Id<Transform>;

struct Asset {
  std::string path;  // as the file system opens it, relative to the working directory
  Hash128 hash;      // of its bytes
  Span span;         // the first place that names it
};

// One placed shape or instance, 24 bytes. `material` is always valid, except for an instance whose
// proto keeps its own materials.
struct Item {
  ShapeRef shape;
  TransformId transform;  // world (or proto) from object
  MaterialId material;
  OriginId origin;
  NameId name;  // the author's label, or invalid
};
static_assert(sizeof(Item) == 24);
// A named group that is not placed itself: only its instances are. Items are in proto space.
struct Proto {
  std::vector<Item> items;
};

template <class List>
struct TableOf;
template <class... Ts>
struct TableOf<TypeList<Ts...>> {
  using type = std::tuple<Table<Ts>...>;
};
using ShapeTables = TableOf<ShapeTypes>::type;

// What a declaration is called and where it stands; parallel to its table.
struct Declared {
  NameId name;
  OriginId origin;
};

class Scene {
 public:
  Table<Origin> origins;
  Table<std::string> names;
  Table<Asset> assets;
  Table<TextureNode> textures;
  TransformTable transforms;
  Table<Material> materials;
  Table<Declared, Material> material_names;
  ShapeTables shapes;
  Table<Proto> protos;
  Table<Declared, Proto> proto_names;
  std::vector<Item> items;
  Table<Light> lights;
  Table<Declared, Light> light_names;
  Table<Camera> cameras;
  Table<Declared, Camera> camera_names;
  RenderSettings render;
  OriginId render_origin;
  Hash128 hash;  // content_hash(scene)

  template <class T>
  [[nodiscard]] const Table<T>& table() const {
    return std::get<Table<T>>(shapes);
  }
  template <class T>
  [[nodiscard]] const T& shape(Id<T> id) const {
    return table<T>()[id];
  }
};

}  // namespace scenec::ir
