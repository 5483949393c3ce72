// What a SceneAccel holds, shared by the file that fills it and the file that traces it.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "backend/accel/scene_accel.hpp"

namespace scenec::backend {

enum class ShapeKind : std::uint8_t {
  sphere,
  plane,
  triangle,
  quad,
  disk,
  box,
  cylinder,
  mesh,
  revolve,
  instance
};

struct PlacedItem {
  std::uint32_t item = 0;       // the caller's number
  std::uint32_t transform = 0;  // into Data::transforms, 0 = identity
  std::uint32_t index = 0;      // into the array of its kind
  ShapeKind kind = ShapeKind::sphere;
  ItemOption option = ItemOption::plain;
};

struct SceneAccel::Data {
  std::vector<Transform> transforms{Transform()};
  std::vector<Sphere> spheres;
  std::vector<Plane> planes;
  std::vector<Triangle> triangles;
  std::vector<Quad> quads;
  std::vector<Disk> disks;
  std::vector<Box> boxes;
  std::vector<Cylinder> cylinders;
  std::vector<std::shared_ptr<const MeshAccel>> meshes;
  std::vector<std::shared_ptr<const Revolve>> revolves;
  std::vector<std::shared_ptr<const SceneAccel>> worlds;

  std::vector<PlacedItem> items;      // bounded ones in leaf order once built
  std::vector<PlacedItem> unbounded;  // planes, and instances of worlds that have some
  Bvh bvh;
  std::uint32_t depth = 0;  // levels of instances below
  bool built = false;

  [[nodiscard]] static const Data& of(const SceneAccel& accel) { return *accel.data_; }
  [[nodiscard]] Bounds3 object_bounds(const PlacedItem& item) const;
};

}  // namespace scenec::backend
