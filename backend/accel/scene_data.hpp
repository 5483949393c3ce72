// What a SceneAccel holds, shared by the files that fill it and those that trace it.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "backend/accel/flat_items.hpp"
#include "backend/accel/placements.hpp"
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
  std::uint32_t transform = 0;  // into Data::places, 0 = identity
  std::uint32_t index = 0;      // into the array of its kind
  ShapeKind kind = ShapeKind::sphere;
  ItemTraits traits;
};

struct SceneAccel::Data {
  Placements places;
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

  std::vector<PlacedItem> items;      // in the order of the tree's leaves once built
  std::vector<PlacedItem> unbounded;  // planes, instances of worlds that have some, and what is so
                                      // much larger than the rest that it would spoil the tree
  bool infinite = false;              // some of them are truly unbounded
  std::vector<PlacedItem> flat_list;  // the few that are tested by `flat`, outside the tree
  FlatItems flat;
  WideTree tree;
  Target target = Target::baseline;
  std::uint32_t depth = 0;  // levels of instances below
  bool built = false;

  [[nodiscard]] static const Data& of(const SceneAccel& accel) { return *accel.data_; }
  [[nodiscard]] Bounds3 object_bounds(const PlacedItem& item) const;
  // Empty: nothing to hit; not finite: to be kept out of the tree.
  [[nodiscard]] Bounds3 world_bounds(const PlacedItem& item) const;
};

// An item and the world it is placed in.
struct Placement {
  const SceneAccel::Data* world;
  const PlacedItem* item;
};

// From the outermost instance down to the shape. Without initial values: queries make many.
struct ItemPath {
  std::array<Placement, Hit::max_instances + 1> steps;
  std::uint32_t size;

  [[nodiscard]] const Placement& leaf() const { return steps[size - 1]; }
};

[[nodiscard]] Ray to_object(const Placement& place, const Ray& ray);
// Kinds that have a kernel of their own: all but meshes and instances.
[[nodiscard]] bool intersect_shape(const SceneAccel::Data& world, const PlacedItem& item,
                                   const Ray& ray, ShapeHit& out);
// What a query found, with as much of the surface there as `detail` asks for.
void complete(const ItemPath& path, const Ray& world_ray, const ShapeHit& found, HitDetail detail,
              Hit& hit);

// Moves what FlatItems takes, if it is few, from `bounded` and `data.unbounded` to
// `data.flat_list`, and lays it out.
void take_flat_items(SceneAccel::Data& data, std::vector<PlacedItem>& bounded);

// The queries, compiled for one instruction set.
enum class Walk : std::uint8_t { tree, brute_force };
struct QueryKernels {
  bool (*intersect)(const SceneAccel::Data&, const Ray&, const HitFilter&, Walk, HitDetail, Hit&);
  bool (*find)(const SceneAccel::Data&, const Ray&, const HitFilter&, Walk, FoundHit&);
  bool (*occluded)(const SceneAccel::Data&, const Ray&, const HitFilter&, Walk);
};
[[nodiscard]] const QueryKernels& query_kernels(Target target);

}  // namespace scenec::backend
