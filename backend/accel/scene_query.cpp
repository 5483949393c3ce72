// Tracing a SceneAccel: one walk serves closest and any hit, plain and filtered, tree and brute
// force, and is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "backend/accel/scene_query.cpp"
#ifndef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#endif
#include <hwy/foreach_target.h>  // IWYU pragma: keep: re-includes this file
#include <hwy/highway.h>

#include <cmath>
#include <limits>

#include "backend/accel/flat-inl.hpp"
#include "backend/accel/scene_data.hpp"
#include "backend/accel/traverse-inl.hpp"
#include "base/assert.hpp"

// What the loop over nodes calls must be part of it: a call would push the ray out of its
// registers.
#undef SCENEC_INLINE_LAMBDA
#define SCENEC_INLINE_LAMBDA __attribute__((always_inline))

HWY_BEFORE_NAMESPACE();
namespace scenec::backend {
namespace HWY_NAMESPACE {  // NOLINT(readability-identifier-naming): Highway's

enum class Want : std::uint8_t { closest, any };
enum class Filtering : std::uint8_t { none, some };

using World = SceneAccel::Data;

// What a query does not count, and what it counts.
struct Uncounted {
  HWY_INLINE void operator()() const {}
  HWY_INLINE void add(std::size_t) const {}
  template <class Block>
  HWY_INLINE void add_block(const Block&) const {}
};
struct Counted {
  TestCounts* counts;

  void operator()() const { ++counts->nodes; }
  void add(std::size_t primitives) const { counts->primitives += primitives; }
  template <class T>
  void add_block(const TriangleBlock<T>& block) const {
    for (const std::uint32_t face : block.face) add(face == TriangleBlock<T>::no_face ? 0 : 1);
  }
  // Places without a shape hold NaN.
  void add_block(const FlatSpheres& block) const { add_lanes(block.radius); }
  template <class Block>
    requires requires(const Block& block) { block.normal; }
  void add_block(const Block& block) const {
    add_lanes(block.normal[0]);
  }

 private:
  void add_lanes(const FlatLane& lane) const {
    for (const double value : lane) add(value == value ? 1 : 0);
  }
};

template <Want want, Filtering filtering, class Counter = Uncounted>
class Query {
 public:
  HWY_INLINE Query(const Ray& ray, const HitFilter& filter, Walk walk, Counter counter = {})
      : world_ray_(ray),
        filter_(filter),
        counter_(counter),
        best_{ray.t_max, 0, 0, 0},
        walk_(walk) {
    path_.size = 0;
  }

  // True when a search for any hit may stop.
  bool trace(const World& world, const Ray& ray) {
    if (world.flat.used && trace_flat_list(world, ray)) return true;
    for (const PlacedItem& item : world.unbounded)
      if (trace_item(world, item, ray)) return true;
    if (world.tree.empty) return false;
    if (walk_ == Walk::brute_force) return trace_items(world, 0, world.items.size(), ray);
    if (world.tree.root.is_leaf())
      return trace_items(world, world.tree.root.first(), world.tree.root.count(), ray);
    TreeRay local;
    if (!local.prepare(world.tree, ray, best_.t)) return false;
    const auto leaf = [&](TreeRef ref, float& limit) HWY_ATTR {
      const double before = best_.t;
      if (trace_items(world, ref.first(), ref.count(), ray)) return true;
      if (best_.t != before) limit = local.box.limit(local.times.to_local(best_.t));
      return false;
    };
    return walk < want == Want::any
               ? Order::any
               : Order::nearest_first > (world.tree.nodes.data(), world.tree.root, local.box,
                                         local.box.limit(local.t_max), leaf, counter_);
  }

  [[nodiscard]] bool found() const { return found_; }
  [[nodiscard]] const ShapeHit& best() const { return best_; }
  [[nodiscard]] const ItemPath& path() const { return best_path_; }

 private:
  bool trace_items(const World& world, std::size_t first, std::size_t count, const Ray& ray) {
    for (std::size_t i = first; i < first + count; ++i)
      if (trace_item(world, world.items[i], ray)) return true;
    return false;
  }

  bool trace_item(const World& world, const PlacedItem& item, const Ray& ray) {
    path_.steps[path_.size++] = {&world, &item};
    if (item.kind == ShapeKind::mesh && item.transform == SceneAccel::identity) {
      const bool stop = trace_mesh(world.meshes[item.index]->tree(), item, ray, best_.t);
      --path_.size;
      return stop;
    }
    Ray local = to_object(path_.leaf(), ray);
    local.t_max = best_.t;
    bool done = false;
    if (item.kind == ShapeKind::instance) {
      done = trace(World::of(*world.worlds[item.index]), local);
    } else if (item.kind == ShapeKind::mesh) {
      done = trace_mesh(world.meshes[item.index]->tree(), item, local, best_.t);
    } else {
      done = trace_shape(world, item, local);
    }
    --path_.size;
    return done;
  }

  bool trace_flat_list(const World& world, const Ray& ray) {
    if (walk_ == Walk::tree && FlatItems::takes(ray)) return trace_flat(world, ray);
    for (const PlacedItem& item : world.flat_list)
      if (trace_item(world, item, ray)) return true;
    return false;
  }

  bool trace_flat(const World& world, const Ray& ray) {
    Nearest nearest{best_.t, Hit::none, 0};
    FlatTest test(ray);
    const FlatItems& flat = world.flat;
    const bool any = test_flat(world, test, flat.planes, nearest) ||
                     test_flat(world, test, flat.disks, nearest) ||
                     test_flat(world, test, flat.spheres, nearest);
    if (!any && !flat.quads.empty()) {
      test.prepare_quads(ray);
      test_flat(world, test, flat.quads, nearest);
    }
    if (nearest.number == Hit::none) return false;
    // The rest of the hit; t has the same bits.
    const PlacedItem& item = world.flat_list[nearest.number];
    path_.steps[path_.size++] = {&world, &item};
    Ray local = ray;
    local.t_max = best_.t;
    ShapeHit hit;
    bool stop = false;
    if constexpr (want == Want::any) {
      hit.t = nearest.t;
      stop = accept(hit);
    } else if (intersect_shape(world, item, local, hit) && improves(hit)) {
      stop = accept(hit);
    }
    --path_.size;
    return stop;
  }

  struct Nearest {
    double t;
    std::uint32_t number;  // of the flat item
    std::uint32_t item;    // its number to the caller
  };

  // True when a search for any hit may stop.
  template <class Block>
  HWY_INLINE bool test_flat(const World& world, const FlatTest& test,
                            const std::vector<Block>& blocks, Nearest& nearest) {
    alignas(32) double ts[flat_width];
    for (const Block& block : blocks) {
      counter_.add_block(block);
      for (std::size_t at = 0; at < flat_width; at += triangle_lanes) {
        std::uint32_t bits = test(block, at, nearest.t, ts);
        while (bits != 0) {
          const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
          bits &= bits - 1;
          const std::uint32_t number = block.item[at + lane];
          const std::uint32_t item = world.flat_list[number].item;
          const bool nearer = nearest.number == Hit::none || ts[lane] < nearest.t ||
                              (ts[lane] == nearest.t && item < nearest.item);
          if (!nearer) continue;
          nearest = {ts[lane], number, item};
          if constexpr (want == Want::any) return true;
        }
      }
    }
    return false;
  }

  bool trace_shape(const World& world, const PlacedItem& item, Ray ray) {
    ShapeHit hit;
    counter_.add(1);
    while (intersect_shape(world, item, ray, hit)) {
      if (!improves(hit)) return false;
      if (passes(item, hit)) return accept(hit);
      // Behind a refused hit the shape may have another.
      ray.t_min = next_up(hit.t);
      if (!(ray.t_min <= ray.t_max)) return false;
      counter_.add(1);
    }
    return false;
  }

  bool trace_mesh(const MeshTree& mesh, const PlacedItem& item, const Ray& ray, double t_max) {
    if (mesh.tree.empty) return false;
    return mesh.full() ? trace_blocks(mesh.tree, mesh.full_blocks, item, ray, t_max)
                       : trace_blocks(mesh.tree, mesh.blocks, item, ray, t_max);
  }

  template <class T>
  bool trace_blocks(const WideTree& tree, const HugeVector<TriangleBlock<T>>& blocks,
                    const PlacedItem& item, const Ray& ray, double t_max) {
    TreeRay local;
    if (!local.prepare(tree, ray, t_max)) return false;
    TriangleTest test;
    bool prepared = false;
    double best_t = local.t_max;
    ShapeHit best;
    bool found = false;
    const auto test_block = [&](const TriangleBlock<T>& block) SCENEC_INLINE_LAMBDA {
      counter_.add_block(block);
      return test(block, best_t,
                  [&](double t, std::uint32_t face, double b1, double b2) SCENEC_INLINE_LAMBDA {
                    if (t > best_t || (found && t == best_t && face >= best.part)) return false;
                    const ShapeHit candidate{local.times.to_world(t), face, b1, b2};
                    if (!(std::fabs(candidate.t) <= std::numeric_limits<double>::max()))
                      return false;
                    if constexpr (filtering == Filtering::some) {
                      if (!improves(candidate) || !passes(item, candidate)) return false;
                    }
                    if constexpr (want == Want::any) {
                      accept(candidate);
                      return true;
                    }
                    found = true;
                    best = candidate;
                    best_t = t;
                    return false;
                  });
    };
    const auto leaf = [&](TreeRef ref, float& limit) SCENEC_INLINE_LAMBDA {
      // Many rays never come to a leaf.
      if (!prepared) {
        test.prepare(local);
        prepared = true;
      }
      const double before = best_t;
      const TriangleBlock<T>* block = blocks.data() + ref.first();
      const TriangleBlock<T>* end = block + ref.count();
      do {
        if (test_block(*block)) return true;
      } while (++block != end);
      if (best_t != before) limit = local.box.limit(best_t);
      return false;
    };
    bool stopped = false;
    if (walk_ == Walk::brute_force) {
      test.prepare(local);
      for (const TriangleBlock<T>& block : blocks)
        if ((stopped = test_block(block))) break;
    } else {
      stopped = walk < want == Want::any
                    ? Order::any
                    : Order::nearest_first > (tree.nodes.data(), tree.root, local.box,
                                              local.box.limit(local.t_max), leaf, counter_);
    }
    if (found && improves(best)) accept(best);
    return stopped;
  }

  // Nearer than the best so far, or as near and earlier in the caller's numbering.
  [[nodiscard]] bool improves(const ShapeHit& hit) const {
    if (!found_ || hit.t < best_.t) return true;
    if (hit.t > best_.t) return false;
    const std::uint32_t common = path_.size < best_path_.size ? path_.size : best_path_.size;
    for (std::uint32_t i = 0; i < common; ++i) {
      const std::uint32_t a = path_.steps[i].item->item;
      const std::uint32_t b = best_path_.steps[i].item->item;
      if (a != b) return a < b;
    }
    if (path_.size != best_path_.size) return path_.size < best_path_.size;
    return hit.part < best_.part;
  }

  [[nodiscard]] bool passes(const PlacedItem& item, const ShapeHit& hit) const {
    if constexpr (filtering == Filtering::none) return true;
    if (!item.traits.filtered) return true;
    Hit whole;
    complete(path_, world_ray_, hit, HitDetail::texture, whole);
    return filter_.keeps(whole);
  }

  bool accept(const ShapeHit& hit) {
    best_ = hit;
    for (std::uint32_t i = 0; i < path_.size; ++i) best_path_.steps[i] = path_.steps[i];
    best_path_.size = path_.size;
    found_ = true;
    return want == Want::any;
  }

  const Ray& world_ray_;
  const HitFilter& filter_;
  [[no_unique_address]] Counter counter_;
  ShapeHit best_;
  ItemPath path_;
  ItemPath best_path_;
  bool found_ = false;
  Walk walk_;
};

template <Want want, Filtering filtering, class F>
HWY_INLINE bool run(const World& world, const Ray& ray, const HitFilter& filter, Walk walk,
                    F&& use) {
  Query<want, filtering> query(ray, filter, walk);
  query.trace(world, ray);
  if (query.found()) use(query);
  return query.found();
}

template <Want want, class F>
HWY_INLINE bool run(const World& world, const Ray& ray, const HitFilter& filter, Walk walk,
                    F&& use) {
  if (!is_traceable(ray)) return false;
  return filter.active() ? run<want, Filtering::some>(world, ray, filter, walk, use)
                         : run<want, Filtering::none>(world, ray, filter, walk, use);
}

bool intersect_world(const World& world, const Ray& ray, const HitFilter& filter, Walk walk,
                     HitDetail detail, Hit& hit) {
  return run<Want::closest>(world, ray, filter, walk, [&](const auto& q) HWY_ATTR {
    complete(q.path(), ray, q.best(), detail, hit);
  });
}

bool find_in_world(const World& world, const Ray& ray, const HitFilter& filter, Walk walk,
                   FoundHit& hit) {
  return run<Want::closest>(world, ray, filter, walk, [&](const auto& q) HWY_ATTR {
    hit = {q.best().t, q.path().leaf().item->item, q.best().part};
  });
}

bool occluded_in_world(const World& world, const Ray& ray, const HitFilter& filter, Walk walk) {
  return run<Want::any>(world, ray, filter, walk, [](const auto&) {});
}

#if HWY_ONCE
void count_in_world(const World& world, const Ray& ray, Search search, const HitFilter& filter,
                    TestCounts& counts) {
  if (!is_traceable(ray)) return;
  const Counted counter{&counts};
  if (search == Search::any) {
    Query<Want::any, Filtering::some, Counted>(ray, filter, Walk::tree, counter).trace(world, ray);
  } else {
    Query<Want::closest, Filtering::some, Counted>(ray, filter, Walk::tree, counter)
        .trace(world, ray);
  }
}
#endif

const QueryKernels& kernels() {
  static constexpr QueryKernels table{intersect_world, find_in_world, occluded_in_world};
  return table;
}

}  // namespace HWY_NAMESPACE
}  // namespace scenec::backend
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace scenec::backend {

const QueryKernels& query_kernels(Target target) {
  switch (target) {
#if (HWY_TARGETS & HWY_AVX3) != 0
    case Target::avx512:
      return N_AVX3::kernels();
#endif
#if (HWY_TARGETS & HWY_AVX2) != 0
    case Target::avx2:
      return N_AVX2::kernels();
#endif
#if (HWY_TARGETS & HWY_SSE4) != 0
    case Target::sse4:
      return N_SSE4::kernels();
#endif
    default:
      return HWY_STATIC_DISPATCH(kernels)();
  }
}

bool SceneAccel::intersect(const Ray& ray, Hit& hit, const HitFilter& filter,
                           HitDetail detail) const {
  return kernels_->intersect(*data_, ray, filter, Walk::tree, detail, hit);
}

bool SceneAccel::find(const Ray& ray, FoundHit& hit) const {
  return kernels_->find(*data_, ray, HitFilter{}, Walk::tree, hit);
}

bool SceneAccel::intersect_brute_force(const Ray& ray, Hit& hit, const HitFilter& filter) const {
  return kernels_->intersect(*data_, ray, filter, Walk::brute_force, HitDetail::texture, hit);
}

void SceneAccel::count_tests(const Ray& ray, Search search, const HitFilter& filter,
                             TestCounts& counts) const {
  HWY_STATIC_DISPATCH(count_in_world)(*data_, ray, search, filter, counts);
}

bool SceneAccel::occluded(const Ray& ray, const HitFilter& filter) const {
  return kernels_->occluded(*data_, ray, filter, Walk::tree);
}

}  // namespace scenec::backend
#endif
