// The world of placed shapes: closest and any hit over spheres, planes, triangles, quads, disks,
// boxes, cylinders, meshes, revolves and instances of other worlds.
//
// Domain:     shapes valid in their kernel's sense; up to 2^32 - 1 items; instances nested at most
//             Hit::max_instances deep.
// Method:     a wide tree over the items' world boxes with one array a kind and a switch at the
// leaf;
//             meshes and instanced worlds bring their own tree; planes are a list beside it, and
//             the few items that are so much larger than the rest that they would spoil the tree's
//             floats. Rays enter object space without renormalising, so every t compares with every
//             other.
// Error:      that of the kernels, plus the round trip through the item's transform, which
//             Hit::error carries.
// Degenerate: rays that are not traceable hit nothing; equal t goes to the smallest
//             (instances outermost first, item, primitive).
// Proof:      tests/unit/backend/accel/scene_accel_test.cpp.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <type_traits>
#include <vector>

#include "backend/accel/mesh_accel.hpp"
#include "backend/accel/target.hpp"
#include "backend/geometry/box.hpp"
#include "backend/geometry/cylinder.hpp"
#include "backend/geometry/disk.hpp"
#include "backend/geometry/kernel.hpp"
#include "backend/geometry/plane.hpp"
#include "backend/geometry/quad.hpp"
#include "backend/geometry/revolve.hpp"
#include "backend/geometry/sphere.hpp"
#include "backend/geometry/triangle.hpp"
#include "backend/math/transform.hpp"
#include "base/hash.hpp"

namespace scenec::backend {

// Decides whether a hit on an item that is `filtered` counts (alpha cut-outs); a
// refused hit lets the ray go on, within the same shape too. A reference to any callable
// `bool(const Hit&)`; must not outlive it. Empty: everything counts.
class HitFilter {
 public:
  HitFilter() = default;
  template <class F>
    requires(!std::is_same_v<std::remove_cvref_t<F>, HitFilter> &&
             std::is_invocable_r_v<bool, F&, const Hit&>)
  HitFilter(F&& keep)  // NOLINT(google-explicit-constructor): a call site passes a lambda
      : context_(const_cast<void*>(static_cast<const void*>(&keep))),
        call_([](void* context, const Hit& hit) -> bool {
          return (*static_cast<std::remove_reference_t<F>*>(context))(hit);
        }) {}
  [[nodiscard]] bool active() const { return call_ != nullptr; }
  [[nodiscard]] bool keeps(const Hit& hit) const {
    return call_ == nullptr || call_(context_, hit);
  }

 private:
  void* context_ = nullptr;
  bool (*call_)(void*, const Hit&) = nullptr;
};

struct ItemTraits {
  bool filtered = false;  // hits are put before the filter
  bool textured = true;   // HitDetail::where_textured includes it
};

// A hit without the surface there: all that a benchmark or a count of crossings needs.
struct FoundHit {
  double t = std::numeric_limits<double>::infinity();
  std::uint32_t item = Hit::none;
  std::uint32_t primitive = 0;
};
// What a query tests on its way.
struct TestCounts {
  std::uint64_t nodes = 0;       // of trees, with eight boxes each
  std::uint64_t primitives = 0;  // triangles and other shapes
};
enum class Search : std::uint8_t { closest, any };
struct QueryKernels;

class SceneAccel {
 public:
  using TransformIndex = std::uint32_t;
  static constexpr TransformIndex identity = 0;

  SceneAccel();
  ~SceneAccel();
  SceneAccel(SceneAccel&&) noexcept;
  SceneAccel& operator=(SceneAccel&&) noexcept;

  // Placements are shared: store one a group, not one an item. The identity gives `identity`.
  TransformIndex add_transform(const Transform& world_from_object);

  // `item` is the caller's number, returned in hits. Numbers need not be unique or ordered.
  template <class Shape>
  void add(std::uint32_t item, const Shape& shape, TransformIndex place = identity,
           ItemTraits traits = {});
  void add_mesh(std::uint32_t item, std::shared_ptr<const MeshAccel> mesh,
                TransformIndex place = identity, ItemTraits traits = {});
  void add_revolve(std::uint32_t item, std::shared_ptr<const Revolve> revolve,
                   TransformIndex place = identity, ItemTraits traits = {});
  // `world` must be built. Its hits carry `item` in `Hit::instances`.
  void add_instance(std::uint32_t item, std::shared_ptr<const SceneAccel> world,
                    TransformIndex place = identity);

  // Once, after all items. Hits do not depend on the target.
  void build(ThreadPool& pool, Target target = best_target());

  // Before it is built: of everything that the built one would depend on. Meshes, revolves and
  // worlds count by which they are, so keys compare only while both sides are kept.
  [[nodiscard]] Hash128 content_key(Target target) const;
  // Another handle of the same built world.
  [[nodiscard]] SceneAccel share() const;

  // The closest hit in the ray's closed interval. The filter sees hits in full detail.
  [[nodiscard]] bool intersect(const Ray& ray, Hit& hit, const HitFilter& filter = {},
                               HitDetail detail = HitDetail::texture) const;
  // The same, without the surface; nothing is filtered.
  [[nodiscard]] bool find(const Ray& ray, FoundHit& hit) const;
  // Whether anything is hit in it.
  [[nodiscard]] bool occluded(const Ray& ray, const HitFilter& filter = {}) const;

  // Adds what such a query tests, by walking once more. Counted with the least instruction set:
  // others round boxes differently and may visit a node more or less.
  void count_tests(const Ray& ray, Search search, const HitFilter& filter,
                   TestCounts& counts) const;

  // Bytes of trees and of what is placed, each shared part once; meshes themselves are left out.
  [[nodiscard]] std::uint64_t memory() const;
  // Bounds of everything but planes.
  [[nodiscard]] Bounds3 bounds() const;
  [[nodiscard]] std::size_t item_count() const;
  // The oracle of the tests: as `intersect`, without the tree over items.
  [[nodiscard]] bool intersect_brute_force(const Ray& ray, Hit& hit,
                                           const HitFilter& filter = {}) const;

  struct Data;

 private:
  std::shared_ptr<Data> data_;   // shared once built, and not changed from then on
  const QueryKernels* kernels_;  // of the chosen instruction set
};

}  // namespace scenec::backend
