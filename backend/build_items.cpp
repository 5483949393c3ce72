// Placed items to accelerators.
#include <map>
#include <utility>

#include "backend/accel/quick_mesh.hpp"
#include "backend/accel/tree_codec.hpp"
#include "backend/accel/tree_store.hpp"
#include "backend/build.hpp"
#include "backend/geometry/revolve_mesh.hpp"

namespace scenec::backend {
namespace {

Point3 point_of(const ir::Point3& p) {
  return {p.x, p.y, p.z};
}
Vector3 vector_of(const ir::Point3& p) {
  return {p.x, p.y, p.z};
}
Vector3 vector_of(const ir::Direction& d) {
  return {d.x, d.y, d.z};
}

Hash128 key_of(const ir::Revolve& shape) {
  Hasher hasher;
  hasher.add(shape.profile.kind);
  hasher.add(shape.profile.clamped);
  hasher.add(shape.profile.points.size());
  for (const ir::Vec2& p : shape.profile.points) hasher.add(p.x), hasher.add(p.y);
  hasher.add(shape.axis);
  hasher.add(shape.solver);
  return hasher.result();
}

// Shares what can be shared: one accelerator a mesh, a revolve, a proto.
class ItemAdder {
 public:
  ItemAdder(const PreparedScene& prepared, RenderScene& out, ThreadPool& pool,
            const BuildOptions& options)
      : prepared_(prepared), scene_(*prepared.scene), out_(out), pool_(pool), options_(options) {}

  void add_all() {
    // World items first, so that ties between them go to the first one placed.
    const auto world = static_cast<std::uint32_t>(scene_.items.size());
    out_.items.reserve(item_count());
    for (const ir::Item& item : scene_.items) out_.items.push_back({item.material});
    first_of_proto_.reserve(scene_.protos.size());
    std::uint32_t next = world;
    for (const ir::Proto& proto : scene_.protos) {
      first_of_proto_.push_back(next);
      next += static_cast<std::uint32_t>(proto.items.size());
      for (const ir::Item& item : proto.items) out_.items.push_back({item.material});
    }
    protos_.resize(scene_.protos.size());
    for (std::size_t i = 0; i < protos_.size(); ++i) {
      auto accel = std::make_shared<SceneAccel>();
      fill(*accel, scene_.protos[ir::ProtoId(static_cast<std::uint32_t>(i))].items,
           first_of_proto_[i]);
      build_world(*accel, pool_, options_);
      protos_[i] = std::move(accel);
    }
    fill(out_.accel, scene_.items, 0);
  }

 private:
  void fill(SceneAccel& accel, const std::vector<ir::Item>& items, std::uint32_t first) {
    for (std::size_t i = 0; i < items.size(); ++i) {
      const ir::Item& item = items[i];
      add(accel, first + static_cast<std::uint32_t>(i), item, place_of(accel, item.transform),
          {.filtered = overrides_.transparent || is_transparent(item),
           .textured = overrides_.textured || is_textured(item)});
    }
    for (const ir::Item& item : items)
      if (item.transform.valid()) places_[item.transform.value()] = unplaced;
  }

  SceneAccel::TransformIndex place_of(SceneAccel& accel, ir::TransformId id) {
    if (!id.valid()) return SceneAccel::identity;
    SceneAccel::TransformIndex& place = places_[id.value()];
    if (place == unplaced) place = accel.add_transform(transform_of(scene_, id));
    return place;
  }

  void add(SceneAccel& accel, std::uint32_t number, const ir::Item& item,
           SceneAccel::TransformIndex place, ItemTraits traits) {
    if (const auto* id = std::get_if<Id<ir::Instance>>(&item.shape)) {
      const std::size_t proto = scene_.shape(*id).of.value();
      accel.add_instance(number, protos_[proto], place);
    } else if (const auto* mesh = std::get_if<Id<ir::Mesh>>(&item.shape)) {
      accel.add_mesh(number, mesh_accel(mesh->value()), place, traits);
    } else if (const auto* revolve = std::get_if<Id<ir::Revolve>>(&item.shape)) {
      if (scene_.shape(*revolve).solver == ir::RevolveSolver::tessellated)
        accel.add_mesh(number, tessellated_accel(*revolve), place, traits);
      else
        accel.add_revolve(number, revolve_accel(*revolve), place, traits);
    } else if (const auto* triangle = std::get_if<Id<ir::Triangle>>(&item.shape)) {
      const ir::Triangle& shape = scene_.shape(*triangle);
      if (shape.normals || shape.uvs)
        accel.add_mesh(number, kept_accel(std::make_shared<const TriangleMesh>(mesh_of(shape)), {}),
                       place, traits);
      else
        accel.add(number, kernel_of(shape), place, traits);
    } else {
      std::visit([&](auto typed) { add_kernel(accel, number, typed, place, traits); }, item.shape);
    }
  }

  template <class Shape>
  void add_kernel(SceneAccel& accel, std::uint32_t number, Id<Shape> id,
                  SceneAccel::TransformIndex place, ItemTraits traits) {
    if constexpr (requires { kernel_of(scene_.shape(id)); })
      accel.add(number, kernel_of(scene_.shape(id)), place, traits);
  }

  // Files that say the same share one mesh, and so one tree.
  std::shared_ptr<const MeshAccel> mesh_accel(std::size_t index) {
    const std::shared_ptr<const TriangleMesh>& mesh = prepared_.meshes[index];
    auto& slot = meshes_[mesh.get()];
    if (!slot) slot = kept_accel(mesh, prepared_.mesh_keys[index]);
    out_.meshes[index] = slot->shared_mesh();
    return slot;
  }
  std::shared_ptr<const MeshAccel> tessellated_accel(Id<ir::Revolve> id) {
    auto& slot = tessellated_[id];
    if (!slot) {
      const ir::Revolve& shape = scene_.shape(id);
      slot = kept_accel(std::make_shared<const TriangleMesh>(
                            tessellate(revolve_of(shape), static_cast<std::uint32_t>(shape.steps))),
                        {});
    }
    return slot;
  }
  std::shared_ptr<const MeshAccel> kept_accel(const std::shared_ptr<const TriangleMesh>& mesh,
                                              const Hash128& mesh_key) {
    if (options_.trees == nullptr) return made_accel(mesh, mesh_key);
    const Hash128 key = TreeStore::key_of(*mesh, options_.precision);
    auto accel = options_.trees->find(key);
    if (accel == nullptr) {
      accel = made_accel(mesh, mesh_key);
      options_.trees->keep(key, accel);
    }
    return accel;
  }
  std::shared_ptr<const MeshAccel> made_accel(const std::shared_ptr<const TriangleMesh>& mesh,
                                              const Hash128& mesh_key) {
    ContentCache* const cache = options_.cache;
    if (cache == nullptr || mesh_key == Hash128{}) return built_accel(mesh).accel;
    const Hash128 key = tree_key(mesh_key, options_.precision);
    if (const auto entry = cache->find(key)) {
      if (auto accel = decode_tree(entry->bytes, mesh)) return accel;
      cache->refuse();
    }
    QuickMesh built = built_accel(mesh);
    // Others who find a tree there want the one that was worth its time.
    if (built.is_final) {
      const EncodedTree encoded(*built.accel, *mesh);
      cache->store(key, encoded.pieces());
    }
    return std::move(built.accel);
  }
  // Whoever builds the same scene again and again waits for each of them.
  QuickMesh built_accel(const std::shared_ptr<const TriangleMesh>& mesh) {
    if (options_.trees != nullptr) return build_quickly(mesh, pool_, options_.precision);
    return {.accel = std::make_shared<const MeshAccel>(mesh, pool_, options_.precision)};
  }
  std::shared_ptr<const Revolve> revolve_accel(Id<ir::Revolve> id) {
    auto& slot = revolves_[id];
    if (slot) return slot;
    const Hash128 key = key_of(scene_.shape(id));
    if (options_.trees != nullptr) slot = options_.trees->find_revolve(key);
    if (slot) return slot;
    slot = std::make_shared<const Revolve>(revolve_of(scene_.shape(id)));
    if (options_.trees != nullptr) options_.trees->keep_revolve(key, slot);
    return slot;
  }

  // What instances put in the place of the materials inside: any item may come to have it.
  struct Overrides {
    bool transparent = false;
    bool textured = false;
  };

  const PreparedScene& prepared_;
  const ir::Scene& scene_;
  RenderScene& out_;
  ThreadPool& pool_;
  const BuildOptions& options_;
  Overrides overrides_ = find_overrides();
  std::vector<std::uint32_t> first_of_proto_;
  std::vector<std::shared_ptr<const SceneAccel>> protos_;
  // What each transform has become in the accelerator that is being filled.
  static constexpr SceneAccel::TransformIndex unplaced = 0xffffffff;
  std::vector<SceneAccel::TransformIndex> places_ =
      std::vector<SceneAccel::TransformIndex>(scene_.transforms.size(), unplaced);
  std::map<const void*, std::shared_ptr<const MeshAccel>> meshes_;
  std::map<Id<ir::Revolve>, std::shared_ptr<const Revolve>> revolves_;
  std::map<Id<ir::Revolve>, std::shared_ptr<const MeshAccel>> tessellated_;

  [[nodiscard]] std::size_t item_count() const {
    std::size_t count = scene_.items.size();
    for (const ir::Proto& proto : scene_.protos) count += proto.items.size();
    return count;
  }

  [[nodiscard]] bool is_transparent(const ir::Item& item) const {
    return !item.material.valid() || out_.facts.transparent(item.material);
  }
  [[nodiscard]] bool is_textured(const ir::Item& item) const {
    return !item.material.valid() || out_.facts.textured_emission(item.material) ||
           out_.materials[item.material.value()].use == PreparedMaterial::Use::varied;
  }

  [[nodiscard]] Overrides find_overrides() const {
    Overrides found;
    const auto look_at = [&](const std::vector<ir::Item>& items) {
      for (const ir::Item& item : items) {
        if (!std::holds_alternative<Id<ir::Instance>>(item.shape) || !item.material.valid())
          continue;
        found.transparent = found.transparent || is_transparent(item);
        found.textured = found.textured || is_textured(item);
      }
    };
    look_at(scene_.items);
    for (const ir::Proto& proto : scene_.protos) look_at(proto.items);
    return found;
  }
};

}  // namespace

void build_world(SceneAccel& world, ThreadPool& pool, const BuildOptions& options) {
  if (options.trees != nullptr)
    options.trees->build(world, pool, options.target);
  else
    world.build(pool, options.target);
}

Transform transform_of(const ir::Scene& scene, ir::TransformId id) {
  if (!id.valid()) return {};
  // Singular matrices do not pass the front end.
  const auto transform = Transform::from_matrix(scene.transforms[id].m);
  SCENEC_ASSERT(transform.has_value());
  return *transform;
}

Sphere kernel_of(const ir::Sphere& s) {
  return {point_of(s.center), s.radius.value};
}
Plane kernel_of(const ir::Plane& p) {
  return {as_normal(normalized(vector_of(p.normal)).vector()), p.offset.value};
}
Triangle kernel_of(const ir::Triangle& t) {
  return {point_of(t.vertices[0]), point_of(t.vertices[1]), point_of(t.vertices[2])};
}
Quad kernel_of(const ir::Quad& q) {
  return {point_of(q.corner), vector_of(q.edge_u), vector_of(q.edge_v)};
}
Disk kernel_of(const ir::Disk& d) {
  return {point_of(d.center), normalized(vector_of(d.normal)), d.radius.value};
}
Box kernel_of(const ir::Box& b) {
  return {point_of(b.min), point_of(b.max)};
}
Cylinder kernel_of(const ir::Cylinder& c) {
  return Cylinder(point_of(c.base), point_of(c.top), c.radius.value, c.capped);
}

TriangleMesh mesh_of(const ir::Triangle& t) {
  TriangleMesh mesh;
  for (const ir::Point3& p : t.vertices) mesh.positions.push_back(point_of(p));
  mesh.faces.push_back({0, 1, 2});
  if (t.normals) {
    for (const ir::Direction& n : *t.normals) mesh.normals.push_back({n.x, n.y, n.z});
  }
  if (t.uvs) {
    for (const ir::Vec2& uv : *t.uvs) mesh.uvs.push_back({uv.x, uv.y});
  }
  return mesh;
}

Revolve revolve_of(const ir::Revolve& r) {
  std::vector<ProfilePoint> points;
  for (const ir::Vec2& p : r.profile.points) points.push_back({p.x, p.y});
  Profile profile;
  switch (r.profile.kind) {
    case ir::CurveKind::polyline:
      profile = polyline_profile(points);
      break;
    case ir::CurveKind::bezier:
      profile = bezier_profile(points);
      break;
    case ir::CurveKind::beziers:
      profile = beziers_profile(points);
      break;
    case ir::CurveKind::bspline:
      profile =
          bspline_profile(points, r.profile.clamped ? SplineEnds::clamped : SplineEnds::uniform);
      break;
  }
  const Axis axis = r.axis == ir::Axis::x ? Axis::x : r.axis == ir::Axis::y ? Axis::y : Axis::z;
  return Revolve(
      std::move(profile), axis,
      r.solver == ir::RevolveSolver::newton ? RootFinder::newton : RootFinder::certified);
}

void add_items(const PreparedScene& prepared, RenderScene& scene, ThreadPool& pool,
               const BuildOptions& options) {
  ItemAdder(prepared, scene, pool, options).add_all();
}

}  // namespace scenec::backend
