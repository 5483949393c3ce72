// Walking a WideTree and testing blocks of triangles, compiled once for each instruction set:
// include only from files that Highway re-includes.
//
// Domain:     as box_ray.hpp and triangle.hpp.
// Method:     boxes by box_ray.hpp in float, eight at a time, nearest child first; triangles in
//             double, element by element the formula of triangle.hpp, nothing fused, so that every
//             instruction set gives the same bits and shared edges never leak.
// Error:      that of triangle.hpp.
// Degenerate: equal t goes to the smallest face, in whatever order leaves are met.
// Proof:      tests/unit/backend/accel/mesh_accel_test.cpp: the bits of triangle.hpp on every
// target.
#if defined(SCENEC_TRAVERSE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SCENEC_TRAVERSE_INL
#undef SCENEC_TRAVERSE_INL
#else
#define SCENEC_TRAVERSE_INL
#endif

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include <hwy/highway.h>
#include "backend/accel/box_ray.hpp"
#include "backend/accel/wide_tree.hpp"

HWY_BEFORE_NAMESPACE();
namespace scenec::backend {
namespace HWY_NAMESPACE {  // NOLINT(readability-identifier-naming): Highway's
namespace hn = hwy::HWY_NAMESPACE;

// Lanes of the two vectors: the whole width of a node (block), or as much of it as the set has.
inline constexpr std::size_t vector_bytes = HWY_TARGET == HWY_SCALAR ? 0 : HWY_MAX_BYTES;
inline constexpr std::size_t box_lanes =
    std::clamp<std::size_t>(vector_bytes / sizeof(float), 1, 8);
inline constexpr std::size_t box_parts = 8 / box_lanes;
using FloatTag = hn::Simd<float, box_lanes, 0>;
using Floats = hn::Vec<FloatTag>;

inline constexpr std::size_t triangle_lanes =
    std::clamp<std::size_t>(vector_bytes / sizeof(double), 1, 4);
inline constexpr std::size_t triangle_parts = 4 / triangle_lanes;
using DoubleTag = hn::Simd<double, triangle_lanes, 0>;
using Doubles = hn::Vec<DoubleTag>;

template <class D, class M>
HWY_INLINE std::uint32_t bits_of(D d, M mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(d, mask, bytes);
  return bytes[0];
}

// The tests of one ray against all eight children.
class NodeTest {
 public:
  HWY_INLINE explicit NodeTest(const BoxRay& ray) {
    const FloatTag d;
    for (int k = 0; k < 3; ++k) {
      reciprocal_[k] = hn::Set(d, ray.reciprocal[k]);
      near_add_[k] = hn::Set(d, ray.near_add[k]);
      far_add_[k] = hn::Set(d, ray.far_add[k]);
      near_row_[k] = ray.near_row[k];
      far_row_[k] = ray.far_row[k];
    }
  }
  // A bit for every child whose box the ray meets up to `limit`, and where it enters them (>= 0).
  HWY_INLINE std::uint32_t operator()(const WideNode* node, float limit, float* entry) const {
    const FloatTag d;
    const auto* base = reinterpret_cast<const std::uint8_t*>(node);
    std::uint32_t bits = 0;
    for (std::size_t part = 0; part < box_parts; ++part) {
      const std::size_t at = part * box_lanes * sizeof(float);
      const auto slab = [&](std::uint32_t row, int k, const Floats& add) HWY_ATTR {
        const auto* planes = reinterpret_cast<const float*>(base + row + at);
        return hn::MulAdd(hn::Load(d, planes), reciprocal_[k], add);
      };
      const Floats near_x = slab(near_row_[0], 0, near_add_[0]);
      const Floats near_y = slab(near_row_[1], 1, near_add_[1]);
      const Floats near_z = slab(near_row_[2], 2, near_add_[2]);
      const Floats far_x = slab(far_row_[0], 0, far_add_[0]);
      const Floats far_y = slab(far_row_[1], 1, far_add_[1]);
      const Floats far_z = slab(far_row_[2], 2, far_add_[2]);
      const Floats near = hn::Max(hn::Max(near_x, near_y), hn::Max(near_z, hn::Zero(d)));
      const Floats far = hn::Min(hn::Min(far_x, far_y), hn::Min(far_z, hn::Set(d, limit)));
      hn::Store(near, d, entry + part * box_lanes);
      bits |= bits_of(d, hn::Le(near, far)) << (part * box_lanes);
    }
    return bits;
  }

 private:
  Floats reciprocal_[3];
  Floats near_add_[3];
  Floats far_add_[3];
  std::uint32_t near_row_[3];
  std::uint32_t far_row_[3];
};

// What waits on the stack: entry and child in one number, ordered by entry (floats >= 0 order as
// their bits do).
HWY_INLINE std::uint64_t pending_of(float entry, TreeRef child) {
  return std::uint64_t{std::bit_cast<std::uint32_t>(entry)} << 32 | child.bits();
}
HWY_INLINE float entry_of(std::uint64_t pending) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(pending >> 32));
}
HWY_INLINE TreeRef child_of(std::uint64_t pending) {
  return TreeRef::from_bits(static_cast<std::uint32_t>(pending));
}

// Every level leaves at most seven children behind.
inline constexpr std::size_t stack_size = 7 * 100 + 8;

enum class Order : std::uint8_t { nearest_first, any };

// Sorts the few entries above `bottom` so that the nearest is on top.
HWY_INLINE void sort_pending(std::uint64_t* bottom, std::uint64_t* top) {
  for (std::uint64_t* i = bottom + 1; i < top; ++i) {
    const std::uint64_t value = *i;
    std::uint64_t* k = i;
    while (k > bottom && k[-1] < value) {
      *k = k[-1];
      --k;
    }
    *k = value;
  }
}

// Calls leaf(ref) for every leaf whose box meets the ray up to `limit`, which the callee may lower
// meanwhile. Stops, and returns true, when `leaf` returns true.
template <Order order, class Leaf>
HWY_INLINE bool walk(const WideNode* nodes, TreeRef root, const BoxRay& box_ray, float& limit,
                     Leaf&& leaf) {
  const NodeTest test(box_ray);
  std::uint64_t stack[stack_size];
  std::uint64_t* top = stack;
  alignas(32) float entry[8];
  TreeRef current = root;
  const auto* base = reinterpret_cast<const std::uint8_t*>(nodes);
  while (true) {
    while (!current.is_leaf()) {
      const auto* node = reinterpret_cast<const WideNode*>(base + current.node_offset());
      std::uint32_t bits = test(node, limit, entry);
      if (bits == 0) goto next;
      const auto first = static_cast<std::size_t>(std::countr_zero(bits));
      bits &= bits - 1;
      current = node->child[first];
      if (bits == 0) continue;
      const auto second = static_cast<std::size_t>(std::countr_zero(bits));
      bits &= bits - 1;
      if constexpr (order == Order::any) {
        *top++ = pending_of(entry[second], node->child[second]);
        while (bits != 0) {
          const auto i = static_cast<std::size_t>(std::countr_zero(bits));
          bits &= bits - 1;
          *top++ = pending_of(entry[i], node->child[i]);
        }
        continue;
      }
      const std::uint64_t a = pending_of(entry[first], current);
      const std::uint64_t b = pending_of(entry[second], node->child[second]);
      if (bits == 0) {
        const bool a_first = a < b;
        *top++ = a_first ? b : a;
        current = child_of(a_first ? a : b);
        continue;
      }
      std::uint64_t* bottom = top;
      *top++ = a;
      *top++ = b;
      while (bits != 0) {
        const auto i = static_cast<std::size_t>(std::countr_zero(bits));
        bits &= bits - 1;
        *top++ = pending_of(entry[i], node->child[i]);
      }
      sort_pending(bottom, top);
      current = child_of(*--top);
    }
    if (leaf(current)) return true;
  next:
    do {
      if (top == stack) return false;
      --top;
    } while (!(entry_of(*top) <= limit));
    current = child_of(*top);
  }
}

// One ray against triangles in tree space.
class TriangleTest {
 public:
  HWY_INLINE explicit TriangleTest(const LocalRay& ray) : t_min_(ray.t_min) {
    // As RayShear: along the largest component, the other two in the order that keeps the winding.
    const double ax = std::fabs(ray.direction[0]);
    const double ay = std::fabs(ray.direction[1]);
    const double az = std::fabs(ray.direction[2]);
    z_ = ax > ay ? (ax > az ? 0 : 2) : (ay > az ? 1 : 2);
    x_ = z_ == 2 ? 0 : z_ + 1;
    y_ = x_ == 2 ? 0 : x_ + 1;
    const double along = ray.direction[z_];
    if (along < 0) std::swap(x_, y_);
    const DoubleTag d;
    origin_x_ = hn::Set(d, ray.origin[x_]);
    origin_y_ = hn::Set(d, ray.origin[y_]);
    origin_z_ = hn::Set(d, ray.origin[z_]);
    sx_ = hn::Set(d, ray.direction[x_] / along);
    sy_ = hn::Set(d, ray.direction[y_] / along);
    sz_ = hn::Set(d, 1 / along);
  }

  // Calls hit(t, face, b1, b2) for every triangle of the block that is hit in [t_min, t_max];
  // stops, and returns true, when it returns true.
  template <class T, class F>
  HWY_INLINE bool operator()(const TriangleBlock<T>& block, double t_max, F&& hit) const {
    for (std::size_t part = 0; part < triangle_parts; ++part) {
      if (test_part(block, part * triangle_lanes, t_max, hit)) return true;
    }
    return false;
  }

 private:
  struct Sheared {
    Doubles x, y, z;  // z not yet times sz
  };

  template <class T>
  static HWY_INLINE Doubles load(const T* values) {
    const DoubleTag d;
    if constexpr (sizeof(T) == sizeof(double)) {
      return hn::Load(d, values);
    } else {
      const hn::Rebind<float, DoubleTag> half;
      return hn::PromoteTo(d, hn::Load(half, values));
    }
  }

  template <class T>
  HWY_INLINE Sheared sheared(const TriangleBlock<T>& block, int vertex, std::size_t at) const {
    const Doubles z = hn::Sub(load(block.vertex[vertex][z_] + at), origin_z_);
    const Doubles x = hn::Sub(load(block.vertex[vertex][x_] + at), origin_x_);
    const Doubles y = hn::Sub(load(block.vertex[vertex][y_] + at), origin_y_);
    return {hn::Sub(x, hn::Mul(sx_, z)), hn::Sub(y, hn::Mul(sy_, z)), z};
  }

  static HWY_INLINE Doubles edge(const Doubles& a, const Doubles& b, const Doubles& c,
                                 const Doubles& d) {
    return hn::Sub(hn::Mul(a, b), hn::Mul(c, d));
  }

  template <class T, class F>
  HWY_INLINE bool test_part(const TriangleBlock<T>& block, std::size_t at, double t_max,
                            F& hit) const {
    const DoubleTag d;
    const Doubles zero = hn::Zero(d);
    const Sheared a = sheared(block, 0, at);
    const Sheared b = sheared(block, 1, at);
    const Sheared c = sheared(block, 2, at);
    const Doubles u = edge(c.x, b.y, c.y, b.x);
    const Doubles v = edge(a.x, c.y, a.y, c.x);
    const Doubles w = edge(b.x, a.y, b.y, a.x);
    const auto low = hn::Min(hn::Min(u, v), w);
    const auto high = hn::Max(hn::Max(u, v), w);
    const Doubles det = hn::Add(hn::Add(u, v), w);
    const auto inside = hn::And(hn::Or(hn::Ge(low, zero), hn::Le(high, zero)), hn::Ne(det, zero));
    if (hn::AllFalse(d, inside)) return false;
    const Doubles inverse = hn::Div(hn::Set(d, 1.0), det);
    const Doubles z = hn::Add(hn::Add(hn::Mul(u, hn::Mul(sz_, a.z)), hn::Mul(v, hn::Mul(sz_, b.z))),
                              hn::Mul(w, hn::Mul(sz_, c.z)));
    const Doubles t = hn::Mul(z, inverse);
    const auto in_range = hn::And(hn::Ge(t, hn::Set(d, t_min_)), hn::Le(t, hn::Set(d, t_max)));
    std::uint32_t bits = bits_of(d, hn::And(inside, in_range));
    if (bits == 0) return false;
    alignas(32) double ts[4];
    alignas(32) double b1[4];
    alignas(32) double b2[4];
    hn::Store(t, d, ts);
    hn::Store(hn::Mul(v, inverse), d, b1);
    hn::Store(hn::Mul(w, inverse), d, b2);
    while (bits != 0) {
      const auto i = static_cast<std::size_t>(std::countr_zero(bits));
      bits &= bits - 1;
      if (!(ts[i] <= std::numeric_limits<double>::max())) continue;
      if (hit(ts[i], block.face[at + i], b1[i], b2[i])) return true;
    }
    return false;
  }

  Doubles origin_x_, origin_y_, origin_z_, sx_, sy_, sz_;
  int x_, y_, z_;
  double t_min_;
};

}  // namespace HWY_NAMESPACE
}  // namespace scenec::backend
HWY_AFTER_NAMESPACE();

#endif
