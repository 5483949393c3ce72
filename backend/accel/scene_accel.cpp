#include "backend/accel/scene_accel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "backend/accel/chunks.hpp"
#include "backend/accel/float_box.hpp"
#include "backend/accel/scene_data.hpp"
#include "backend/accel/tree_build.hpp"
#include "base/assert.hpp"

namespace scenec::backend {
namespace {

// Where shapes of each type live; adding a kind is one line here and one case in `object_bounds`
// and in the query's switch.
std::pair<std::vector<Sphere>*, ShapeKind> store_of(SceneAccel::Data& d, const Sphere&) {
  return {&d.spheres, ShapeKind::sphere};
}
std::pair<std::vector<Plane>*, ShapeKind> store_of(SceneAccel::Data& d, const Plane&) {
  return {&d.planes, ShapeKind::plane};
}
std::pair<std::vector<Triangle>*, ShapeKind> store_of(SceneAccel::Data& d, const Triangle&) {
  return {&d.triangles, ShapeKind::triangle};
}
std::pair<std::vector<Quad>*, ShapeKind> store_of(SceneAccel::Data& d, const Quad&) {
  return {&d.quads, ShapeKind::quad};
}
std::pair<std::vector<Disk>*, ShapeKind> store_of(SceneAccel::Data& d, const Disk&) {
  return {&d.disks, ShapeKind::disk};
}
std::pair<std::vector<Box>*, ShapeKind> store_of(SceneAccel::Data& d, const Box&) {
  return {&d.boxes, ShapeKind::box};
}
std::pair<std::vector<Cylinder>*, ShapeKind> store_of(SceneAccel::Data& d, const Cylinder&) {
  return {&d.cylinders, ShapeKind::cylinder};
}

// One entry for all items that share it and follow each other: ten million instances of one proto
// need one.
template <class T>
std::uint32_t push_shared(std::vector<std::shared_ptr<const T>>& values,
                          std::shared_ptr<const T> value) {
  if (values.empty() || values.back() != value) values.push_back(std::move(value));
  return static_cast<std::uint32_t>(values.size() - 1);
}

template <class T>
std::uint32_t push(std::vector<T>& values, T value) {
  SCENEC_ASSERT(values.size() < Hit::none);
  values.push_back(std::move(value));
  return static_cast<std::uint32_t>(values.size() - 1);
}

template <class T>
std::uint64_t bytes_of(const std::vector<T>& values) {
  return values.capacity() * sizeof(T);
}

std::uint64_t memory_of(const SceneAccel::Data& d, std::set<const void*>& counted) {
  if (!counted.insert(&d).second) return 0;
  std::uint64_t bytes = sizeof d + d.places.memory() + bytes_of(d.spheres) + bytes_of(d.planes) +
                        bytes_of(d.triangles) + bytes_of(d.quads) + bytes_of(d.disks) +
                        bytes_of(d.boxes) + bytes_of(d.cylinders) + bytes_of(d.meshes) +
                        bytes_of(d.revolves) + bytes_of(d.worlds) + bytes_of(d.items) +
                        bytes_of(d.unbounded) + bytes_of(d.flat_list) + bytes_of(d.flat.spheres) +
                        bytes_of(d.flat.quads) + bytes_of(d.flat.disks) + bytes_of(d.flat.planes) +
                        d.tree.nodes.capacity() * sizeof(WideNode);
  for (const auto& mesh : d.meshes)
    if (counted.insert(mesh.get()).second) bytes += sizeof *mesh + mesh->tree().bytes();
  for (const auto& revolve : d.revolves)
    if (counted.insert(revolve.get()).second) bytes += revolve->memory();
  for (const auto& world : d.worlds) bytes += memory_of(SceneAccel::Data::of(*world), counted);
  return bytes;
}

}  // namespace

SceneAccel::SceneAccel()
    : data_(std::make_shared<Data>()), kernels_(&query_kernels(Target::baseline)) {}
SceneAccel::~SceneAccel() = default;
SceneAccel::SceneAccel(SceneAccel&&) noexcept = default;
SceneAccel& SceneAccel::operator=(SceneAccel&&) noexcept = default;

SceneAccel::TransformIndex SceneAccel::add_transform(const Transform& world_from_object) {
  return data_->places.add(world_from_object);
}

template <class Shape>
void SceneAccel::add(std::uint32_t item, const Shape& shape, TransformIndex place,
                     ItemTraits traits) {
  static_assert(ShapeKernel<Shape>);
  SCENEC_ASSERT(!data_->built && data_->places.holds(place));
  const auto [store, kind] = store_of(*data_, shape);
  data_->items.push_back({item, place, push(*store, shape), kind, traits});
}

template void SceneAccel::add(std::uint32_t, const Sphere&, TransformIndex, ItemTraits);
template void SceneAccel::add(std::uint32_t, const Plane&, TransformIndex, ItemTraits);
template void SceneAccel::add(std::uint32_t, const Triangle&, TransformIndex, ItemTraits);
template void SceneAccel::add(std::uint32_t, const Quad&, TransformIndex, ItemTraits);
template void SceneAccel::add(std::uint32_t, const Disk&, TransformIndex, ItemTraits);
template void SceneAccel::add(std::uint32_t, const Box&, TransformIndex, ItemTraits);
template void SceneAccel::add(std::uint32_t, const Cylinder&, TransformIndex, ItemTraits);

void SceneAccel::add_mesh(std::uint32_t item, std::shared_ptr<const MeshAccel> mesh,
                          TransformIndex place, ItemTraits traits) {
  SCENEC_ASSERT(!data_->built && data_->places.holds(place) && mesh != nullptr);
  data_->items.push_back(
      {item, place, push_shared(data_->meshes, std::move(mesh)), ShapeKind::mesh, traits});
}

void SceneAccel::add_revolve(std::uint32_t item, std::shared_ptr<const Revolve> revolve,
                             TransformIndex place, ItemTraits traits) {
  SCENEC_ASSERT(!data_->built && data_->places.holds(place) && revolve != nullptr);
  data_->items.push_back(
      {item, place, push_shared(data_->revolves, std::move(revolve)), ShapeKind::revolve, traits});
}

void SceneAccel::add_instance(std::uint32_t item, std::shared_ptr<const SceneAccel> world,
                              TransformIndex place) {
  SCENEC_ASSERT(!data_->built && data_->places.holds(place) && world != nullptr &&
                world->data_->built);
  SCENEC_ASSERT(world->data_->depth < Hit::max_instances);
  data_->depth = std::max(data_->depth, world->data_->depth + 1);
  data_->items.push_back({item, place, push_shared(data_->worlds, std::move(world)),
                          ShapeKind::instance, ItemTraits{}});
}

Bounds3 SceneAccel::Data::object_bounds(const PlacedItem& item) const {
  switch (item.kind) {
    case ShapeKind::sphere:
      return backend::bounds(spheres[item.index]);
    case ShapeKind::plane:
      return backend::bounds(planes[item.index]);
    case ShapeKind::triangle:
      return backend::bounds(triangles[item.index]);
    case ShapeKind::quad:
      return backend::bounds(quads[item.index]);
    case ShapeKind::disk:
      return backend::bounds(disks[item.index]);
    case ShapeKind::box:
      return backend::bounds(boxes[item.index]);
    case ShapeKind::cylinder:
      return backend::bounds(cylinders[item.index]);
    case ShapeKind::mesh:
      return meshes[item.index]->bounds();
    case ShapeKind::revolve:
      return backend::bounds(*revolves[item.index]);
    case ShapeKind::instance: {
      const Data& world = of(*worlds[item.index]);
      return world.infinite ? backend::bounds(Plane{}) : world.tree.bounds;
    }
  }
  return {};
}

namespace {

// An item that alone makes the whole this many times larger is better kept out of the tree.
constexpr float spoiling_ratio = 16;
constexpr int max_apart = 8;
// A shape takes longer than the boxes of a node.
constexpr float node_cost_of_items = 0.5F;

// One ulp outward beyond what rounding to tree space can cost.
BuildRef ref_of(const TreeSpace& space, const Bounds3& box, std::uint32_t id) {
  const Bounds3 b = outward({space.to_local(box.min), space.to_local(box.max)});
  return {{float_below(b.min.x), float_below(b.min.y), float_below(b.min.z)},
          id,
          {float_above(b.max.x), float_above(b.max.y), float_above(b.max.z)},
          0};
}

// The largest extent of a box of floats.
float extent_of(const FloatBox& box) {
  const Float4 e = box.max - box.min;
  return std::fmax(e[0], std::fmax(e[1], e[2]));
}

// The item that makes the whole many times larger, if there is one.
std::optional<std::uint32_t> find_spoiling(std::span<const BuildRef> refs) {
  if (refs.size() < 2) return std::nullopt;
  std::array<double, 3> sum{};
  FloatBox all;
  for (const BuildRef& ref : refs) {
    const FloatBox box = box_of(ref);
    all.grow(box);
    const Float4 center = center_of(box);
    for (std::size_t k = 0; k < 3; ++k) sum[k] += static_cast<double>(center[k]);
  }
  Float4 middle{};
  for (std::size_t k = 0; k < 3; ++k)
    middle[k] = static_cast<float>(sum[k] / static_cast<double>(2 * refs.size()));
  // `rest`: without the one that reaches farthest so far.
  FloatBox rest;
  FloatBox farthest;
  float reach = -1;
  std::uint32_t spoiling = 0;
  for (const BuildRef& ref : refs) {
    const FloatBox box = box_of(ref);
    const Float4 far = max_of(box.max - middle, middle - box.min);
    const float r = std::fmax(far[0], std::fmax(far[1], far[2]));
    if (r > reach) {
      rest.grow(farthest);
      reach = r;
      farthest = box;
      spoiling = ref.id;
    } else {
      rest.grow(box);
    }
  }
  if (!(extent_of(rest) * spoiling_ratio < extent_of(all))) return std::nullopt;
  return spoiling;
}

// Bounds of all items, a chunk at a time.
Bounds3 bounds_of(const SceneAccel::Data& d, std::span<const PlacedItem> items, ThreadPool& pool) {
  std::vector<Bounds3> parts(chunks_of(items.size()));
  for_chunks(pool, items.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      parts[first / chunk_size].grow(d.world_bounds(items[i]));
  });
  Bounds3 all;
  for (const Bounds3& b : parts) all.grow(b);
  return all;
}

std::vector<BuildRef> refs_of(const SceneAccel::Data& d, std::span<const PlacedItem> items,
                              const TreeSpace& space, ThreadPool& pool) {
  std::vector<BuildRef> refs(items.size());
  for_chunks(pool, items.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      refs[i] = ref_of(space, d.world_bounds(items[i]), static_cast<std::uint32_t>(i));
  });
  return refs;
}

}  // namespace

Bounds3 SceneAccel::Data::world_bounds(const PlacedItem& item) const {
  const Bounds3 own = object_bounds(item);
  return own.empty() || !own.finite() ? own : places[item.transform].apply(own);
}

// Boxes are computed again rather than kept: ten million of them in double would be half a
// gigabyte.
void SceneAccel::build(ThreadPool& pool, Target target) {
  Data& d = *data_;
  SCENEC_ASSERT(!d.built);
  d.built = true;
  d.target = target;
  kernels_ = &query_kernels(target);
  std::vector<PlacedItem> bounded = std::move(d.items);
  std::erase_if(bounded, [&](const PlacedItem& item) {
    const Bounds3 box = d.world_bounds(item);
    if (box.empty()) return true;
    if (box.finite()) return false;
    d.unbounded.push_back(item);
    d.infinite = true;
    return true;
  });
  take_flat_items(d, bounded);
  d.tree.bounds = bounds_of(d, bounded, pool);
  std::vector<BuildRef> refs;
  for (int apart = 0; apart <= max_apart; ++apart) {
    d.tree.space = space_of(apart == 0 ? d.tree.bounds : bounds_of(d, bounded, pool));
    refs = refs_of(d, bounded, d.tree.space, pool);
    const auto spoiling = apart < max_apart ? find_spoiling(refs) : std::nullopt;
    if (!spoiling) break;
    d.unbounded.push_back(bounded[*spoiling]);
    bounded.erase(bounded.begin() + static_cast<std::ptrdiff_t>(*spoiling));
  }
  BuildSettings settings;
  settings.node_cost = node_cost_of_items;
  BuiltTree built = build_tree(std::move(refs), settings, pool);
  d.tree.root = built.root;
  d.tree.empty = built.empty;
  d.tree.nodes = std::move(built.nodes);
  // In leaf order, so that a leaf's items lie side by side.
  d.items.clear();
  d.items.reserve(built.ids.size());
  for (const std::uint32_t i : built.ids) d.items.push_back(bounded[i]);
  for (const PlacedItem& item : d.flat_list) {
    const Bounds3 box = d.world_bounds(item);
    if (box.finite()) d.tree.bounds.grow(box);
  }
}

std::uint64_t SceneAccel::memory() const {
  std::set<const void*> counted;
  return memory_of(*data_, counted);
}

Bounds3 SceneAccel::bounds() const {
  return data_->tree.bounds;
}
std::size_t SceneAccel::item_count() const {
  return data_->items.size() + data_->unbounded.size() + data_->flat_list.size();
}

}  // namespace scenec::backend
