#include "backend/accel/scene_accel.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

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

template <class T>
std::uint32_t push(std::vector<T>& values, T value) {
  SCENEC_ASSERT(values.size() < Hit::none);
  values.push_back(std::move(value));
  return static_cast<std::uint32_t>(values.size() - 1);
}

}  // namespace

SceneAccel::SceneAccel()
    : data_(std::make_unique<Data>()), kernels_(&query_kernels(Target::baseline)) {}
SceneAccel::~SceneAccel() = default;
SceneAccel::SceneAccel(SceneAccel&&) noexcept = default;
SceneAccel& SceneAccel::operator=(SceneAccel&&) noexcept = default;

SceneAccel::TransformIndex SceneAccel::add_transform(const Transform& world_from_object) {
  if (world_from_object.is_identity()) return identity;
  return push(data_->transforms, world_from_object);
}

template <class Shape>
void SceneAccel::add(std::uint32_t item, const Shape& shape, TransformIndex place,
                     ItemOption option) {
  static_assert(ShapeKernel<Shape>);
  SCENEC_ASSERT(!data_->built && place < data_->transforms.size());
  const auto [store, kind] = store_of(*data_, shape);
  data_->items.push_back({item, place, push(*store, shape), kind, option});
}

template void SceneAccel::add(std::uint32_t, const Sphere&, TransformIndex, ItemOption);
template void SceneAccel::add(std::uint32_t, const Plane&, TransformIndex, ItemOption);
template void SceneAccel::add(std::uint32_t, const Triangle&, TransformIndex, ItemOption);
template void SceneAccel::add(std::uint32_t, const Quad&, TransformIndex, ItemOption);
template void SceneAccel::add(std::uint32_t, const Disk&, TransformIndex, ItemOption);
template void SceneAccel::add(std::uint32_t, const Box&, TransformIndex, ItemOption);
template void SceneAccel::add(std::uint32_t, const Cylinder&, TransformIndex, ItemOption);

void SceneAccel::add_mesh(std::uint32_t item, std::shared_ptr<const MeshAccel> mesh,
                          TransformIndex place, ItemOption option) {
  SCENEC_ASSERT(!data_->built && place < data_->transforms.size() && mesh != nullptr);
  data_->items.push_back(
      {item, place, push(data_->meshes, std::move(mesh)), ShapeKind::mesh, option});
}

void SceneAccel::add_revolve(std::uint32_t item, std::shared_ptr<const Revolve> revolve,
                             TransformIndex place, ItemOption option) {
  SCENEC_ASSERT(!data_->built && place < data_->transforms.size() && revolve != nullptr);
  data_->items.push_back(
      {item, place, push(data_->revolves, std::move(revolve)), ShapeKind::revolve, option});
}

void SceneAccel::add_instance(std::uint32_t item, std::shared_ptr<const SceneAccel> world,
                              TransformIndex place) {
  SCENEC_ASSERT(!data_->built && place < data_->transforms.size() && world != nullptr &&
                world->data_->built);
  SCENEC_ASSERT(world->data_->depth < Hit::max_instances);
  data_->depth = std::max(data_->depth, world->data_->depth + 1);
  data_->items.push_back(
      {item, place, push(data_->worlds, std::move(world)), ShapeKind::instance, ItemOption::plain});
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
constexpr double spoiling = 16;
constexpr int max_apart = 8;
// A shape takes longer than the boxes of a node.
constexpr float node_cost_of_items = 0.5F;

double reach_from(const Point3& middle, const Bounds3& b) {
  return std::fmax(max_abs(b.min - middle), max_abs(b.max - middle));
}

// The boxes that are moved out of the tree, largest first.
std::vector<std::size_t> spoiling_boxes(std::vector<Bounds3> boxes) {
  std::vector<std::size_t> apart;
  while (static_cast<int>(apart.size()) < max_apart && boxes.size() > apart.size() + 1) {
    Vector3 sum;
    for (const Bounds3& b : boxes)
      if (!b.empty()) sum += as_vector(b.centroid()) / static_cast<double>(boxes.size());
    std::size_t farthest = 0;
    double reach = -1;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const double r = boxes[i].empty() ? -1 : reach_from(as_point(sum), boxes[i]);
      if (r > reach) {
        reach = r;
        farthest = i;
      }
    }
    Bounds3 all;
    Bounds3 rest;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      all.grow(boxes[i]);
      if (i != farthest) rest.grow(boxes[i]);
    }
    if (!(max_abs(rest.extent()) * spoiling < max_abs(all.extent()))) break;
    apart.push_back(farthest);
    boxes[farthest] = {};
  }
  return apart;
}

// One ulp outward beyond what rounding to tree space can cost.
BuildRef ref_of(const TreeSpace& space, const Bounds3& box, std::uint32_t id) {
  const Bounds3 b = outward({space.to_local(box.min), space.to_local(box.max)});
  return {{float_below(b.min.x), float_below(b.min.y), float_below(b.min.z)},
          id,
          {float_above(b.max.x), float_above(b.max.y), float_above(b.max.z)},
          0};
}

}  // namespace

void SceneAccel::build(ThreadPool& pool, Target target) {
  Data& d = *data_;
  SCENEC_ASSERT(!d.built);
  d.built = true;
  d.target = target;
  kernels_ = &query_kernels(target);
  std::vector<PlacedItem> bounded;
  std::vector<Bounds3> boxes;
  bounded.reserve(d.items.size());
  boxes.reserve(d.items.size());
  for (const PlacedItem& item : d.items) {
    const Bounds3 own = d.object_bounds(item);
    if (own.empty()) continue;
    const Bounds3 box = own.finite() ? d.transforms[item.transform].apply(own) : own;
    if (box.finite()) {
      bounded.push_back(item);
      boxes.push_back(box);
    } else {
      d.unbounded.push_back(item);
      d.infinite = true;
    }
  }
  for (const Bounds3& b : boxes) d.tree.bounds.grow(b);
  for (const std::size_t i : spoiling_boxes(boxes)) {
    d.unbounded.push_back(bounded[i]);
    boxes[i] = {};
  }
  Bounds3 inside;
  for (const Bounds3& b : boxes) inside.grow(b);
  d.tree.space = space_of(inside);
  std::vector<BuildRef> refs;
  refs.reserve(boxes.size());
  for (std::uint32_t i = 0; i < boxes.size(); ++i)
    if (!boxes[i].empty()) refs.push_back(ref_of(d.tree.space, boxes[i], i));
  BuildSettings settings;
  settings.node_cost = node_cost_of_items;
  BuiltTree built = build_tree(refs, settings, pool);
  d.tree.root = built.root;
  d.tree.empty = built.empty;
  d.tree.nodes = std::move(built.nodes);
  // In leaf order, so that a leaf's items lie side by side.
  d.items.clear();
  d.items.reserve(built.ids.size());
  for (const std::uint32_t i : built.ids) d.items.push_back(bounded[i]);
}

Bounds3 SceneAccel::bounds() const {
  return data_->tree.bounds;
}
std::size_t SceneAccel::item_count() const {
  return data_->items.size() + data_->unbounded.size();
}

}  // namespace scenec::backend
