#include "backend/accel/scene_accel.hpp"

#include <algorithm>
#include <utility>

#include "backend/accel/scene_data.hpp"
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

std::vector<Bounds3> face_boxes(const TriangleMesh& mesh) {
  std::vector<Bounds3> boxes(mesh.faces.size());
  for (std::uint32_t i = 0; i < boxes.size(); ++i) boxes[i] = bounds(triangle_of(mesh, i));
  return boxes;
}

}  // namespace

MeshAccel::MeshAccel(TriangleMesh mesh, ThreadPool& pool)
    : mesh_(std::move(mesh)), bvh_(face_boxes(mesh_), pool) {}

SceneAccel::SceneAccel() : data_(std::make_unique<Data>()) {}
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
      return meshes[item.index]->bvh().bounds();
    case ShapeKind::revolve:
      return backend::bounds(*revolves[item.index]);
    case ShapeKind::instance: {
      const Data& world = of(*worlds[item.index]);
      return world.unbounded.empty() ? world.bvh.bounds() : backend::bounds(Plane{});
    }
  }
  return {};
}

void SceneAccel::build(ThreadPool& pool) {
  Data& d = *data_;
  SCENEC_ASSERT(!d.built);
  d.built = true;
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
    }
  }
  d.bvh = Bvh(boxes, pool);
  // In leaf order, so that a leaf's items lie side by side.
  d.items.clear();
  d.items.reserve(bounded.size());
  for (const std::uint32_t i : d.bvh.order()) d.items.push_back(bounded[i]);
}

Bounds3 SceneAccel::bounds() const {
  return data_->bvh.bounds();
}
std::size_t SceneAccel::item_count() const {
  return data_->items.size() + data_->unbounded.size();
}

}  // namespace scenec::backend
