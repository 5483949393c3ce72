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

// Not std::fmax, which is a call. NaN may come out as anything.
HWY_INLINE double largest(double a, double b, double c) {
  const double ab = a > b ? a : b;
  return ab > c ? ab : c;
}

// x, y, z, z from `at` on. From registers or broadcasts: what has just been stored a number at a
// time cannot be loaded as a vector without waiting for it.
HWY_INLINE Doubles triple(double x, double y, double z, std::size_t at) {
  const DoubleTag d;
#if HWY_TARGET == HWY_SCALAR
  return hn::Set(d, at == 0 ? x : at == 1 ? y : z);
#else
  if (at != 0) return hn::Set(d, z);
  const Doubles xy = hn::OddEven(hn::Set(d, y), hn::Set(d, x));
  return triangle_lanes == 2 ? xy : hn::ConcatUpperLower(d, hn::Set(d, z), xy);
#endif
}

// The ray of one query in tree space, made ready for boxes and (later, if it comes to that) for
// triangles. False from `prepare`: it meets nothing.
struct TreeRay {
  alignas(32) double origin[4];
  alignas(32) double direction[4];
  LocalTimes times;
  double t_min;
  double t_max;
  BoxRay box;

  HWY_INLINE bool prepare(const WideTree& tree, const Ray& ray, double until) {
    const DoubleTag d;
    const hn::Rebind<float, DoubleTag> f;
    const double size =
        largest(std::fabs(ray.direction.x), std::fabs(ray.direction.y), std::fabs(ray.direction.z));
    if (HWY_UNLIKELY(!(size >= LocalRay::least && size <= LocalRay::most)))
      return prepare_slowly(tree.space, ray, until);
    times = LocalTimes{{tree.space.inverse_scale, 1, 1}, {tree.space.scale, 1}};
    t_min = ray.t_min * tree.space.scale;
    t_max = until * tree.space.scale;
    const double* center = &tree.space.center.x;
    std::uint32_t negative = 0;
    for (std::size_t at = 0; at < 4; at += triangle_lanes) {
      const Doubles o = hn::Mul(
          hn::Sub(triple(ray.origin.x, ray.origin.y, ray.origin.z, at), hn::LoadU(d, center + at)),
          hn::Set(d, tree.space.scale));
      const Doubles v = triple(ray.direction.x, ray.direction.y, ray.direction.z, at);
      hn::Store(o, d, origin + at);
      hn::Store(v, d, direction + at);
      const auto vf = hn::DemoteTo(f, v);
      const auto of = hn::DemoteTo(f, o);
      // Never zero, but of the sign of a zero: the sign decides which plane is near.
      const auto along = hn::CopySign(hn::Max(hn::Abs(vf), hn::Set(f, BoxRay::smallest)), vf);
      const auto r = hn::Div(hn::Set(f, 1.0F), along);
      const auto product = hn::Mul(of, r);
      const auto slack = hn::Set(f, BoxRay::slack);
      const auto margin = hn::Mul(hn::MulAdd(slack, hn::Abs(of), slack), hn::Abs(r));
      hn::Store(r, f, box.reciprocal + at);
      hn::Store(hn::Neg(hn::Add(product, margin)), f, box.near_add + at);
      hn::Store(hn::Sub(margin, product), f, box.far_add + at);
      negative |= bits_of(f, hn::Lt(along, hn::Zero(f))) << at;
    }
    const double reach = largest(std::fabs(origin[0]), std::fabs(origin[1]), std::fabs(origin[2]));
    box.negative = negative;
    box.shift = 0;
    if (HWY_LIKELY(reach <= BoxRay::reach && t_min == 0)) return true;
    return make_box_ray(local(), box);
  }

  [[nodiscard]] LocalRay local() const {
    return {{origin[0], origin[1], origin[2]},
            {direction[0], direction[1], direction[2]},
            t_min,
            t_max,
            times};
  }

 private:
  HWY_NOINLINE bool prepare_slowly(const TreeSpace& space, const Ray& ray, double until) {
    const LocalRay r = make_local(space, {ray.origin, ray.direction, ray.t_min, until});
    for (std::size_t k = 0; k < 3; ++k) {
      origin[k] = r.origin[k];
      direction[k] = r.direction[k];
    }
    times = r.times;
    t_min = r.t_min;
    t_max = r.t_max;
    return make_box_ray(r, box);
  }
};

// One axis of a ray against the planes of eight children.
struct SlabTest {
  Floats reciprocal;
  Floats near_add;
  Floats far_add;
  std::size_t near_row;
  std::size_t far_row;

  HWY_INLINE SlabTest(const BoxRay& ray, std::uint32_t k)
      : reciprocal(hn::Set(FloatTag(), ray.reciprocal[k])),
        near_add(hn::Set(FloatTag(), ray.near_add[k])),
        far_add(hn::Set(FloatTag(), ray.far_add[k])),
        near_row(ray.near_row(k)),
        far_row(ray.far_row(k)) {}
  HWY_INLINE Floats near(const std::uint8_t* node) const {
    return hn::MulAdd(hn::Load(FloatTag(), reinterpret_cast<const float*>(node + near_row)),
                      reciprocal, near_add);
  }
  HWY_INLINE Floats far(const std::uint8_t* node) const {
    return hn::MulAdd(hn::Load(FloatTag(), reinterpret_cast<const float*>(node + far_row)),
                      reciprocal, far_add);
  }
};

// The tests of one ray against all eight children.
struct NodeTest {
  SlabTest x, y, z;

  HWY_INLINE explicit NodeTest(const BoxRay& ray) : x(ray, 0), y(ray, 1), z(ray, 2) {}
  // A bit for every child whose box the ray meets up to `limit`, and where it enters them (>= 0).
  HWY_INLINE std::uint32_t operator()(const std::uint8_t* node, const Floats& limit,
                                      Floats (&entry)[box_parts]) const {
    const FloatTag d;
    std::uint32_t bits = 0;
    for (std::size_t part = 0; part < box_parts; ++part) {
      const std::uint8_t* at = node + part * box_lanes * sizeof(float);
      entry[part] = hn::Max(hn::Max(x.near(at), y.near(at)), hn::Max(z.near(at), hn::Zero(d)));
      const Floats exit = hn::Min(hn::Min(x.far(at), y.far(at)), hn::Min(z.far(at), limit));
      bits |= bits_of(d, hn::Le(entry[part], exit)) << (part * box_lanes);
    }
    return bits;
  }
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

// Calls leaf(ref, limit) for every leaf whose box meets the ray up to `limit`, which the callee may
// lower. Stops, and returns true, when `leaf` returns true. `visit` is called for every node.
struct VisitNothing {
  HWY_INLINE void operator()() const {}
};
template <Order order, class Leaf, class Visit = VisitNothing>
HWY_INLINE bool walk(const WideNode* nodes, TreeRef root, const BoxRay& box_ray, float limit,
                     Leaf&& leaf, const Visit& visit = {}) {
  const FloatTag d;
  const NodeTest test(box_ray);
  Floats limits = hn::Set(d, limit);
  std::uint64_t stack[stack_size];
  std::uint64_t* top = stack;
  TreeRef current = root;
  const auto* base = reinterpret_cast<const std::uint8_t*>(nodes);
  while (true) {
    while (!current.is_leaf()) {
      visit();
      const std::uint8_t* node = base + current.node_offset();
      const auto* child = reinterpret_cast<const TreeRef*>(node + WideNode::child_offset);
      Floats entries[box_parts];
      std::uint32_t bits = test(node, limits, entries);
      if (bits == 0) goto next;
      const auto first = static_cast<std::size_t>(std::countr_zero(bits));
      bits &= bits - 1;
      current = child[first];
      if (bits == 0) continue;
      alignas(32) float entry[8];
      for (std::size_t part = 0; part < box_parts; ++part)
        hn::Store(entries[part], d, entry + part * box_lanes);
      const auto second = static_cast<std::size_t>(std::countr_zero(bits));
      bits &= bits - 1;
      const std::uint64_t a = pending_of(entry[first], current);
      const std::uint64_t b = pending_of(entry[second], child[second]);
      if (bits == 0) {
        *top++ = a < b ? b : a;
        current = child_of(a < b ? a : b);
        continue;
      }
      std::uint64_t* bottom = top;
      *top++ = a;
      *top++ = b;
      do {
        const auto i = static_cast<std::size_t>(std::countr_zero(bits));
        bits &= bits - 1;
        *top++ = pending_of(entry[i], child[i]);
      } while (bits != 0);
      if constexpr (order == Order::nearest_first) sort_pending(bottom, top);
      current = child_of(*--top);
    }
    {
      const float before = limit;
      if (leaf(current, limit)) return true;
      if (limit != before) limits = hn::Set(d, limit);
    }
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
  // As RayShear: along the largest component, the other two in the order that keeps the winding.
  HWY_INLINE void prepare(const TreeRay& ray) {
    const double ax = std::fabs(ray.direction[0]);
    const double ay = std::fabs(ray.direction[1]);
    const double az = std::fabs(ray.direction[2]);
    // Without branches, which no processor could predict.
    const std::uint32_t x_or_y = ax > ay ? 0 : 1;
    const double larger = ax > ay ? ax : ay;
    const std::uint32_t z = larger > az ? x_or_y : 2;
    const double along = ray.direction[z];
    const std::uint32_t row =
        2 * z + static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(along) >> 63);
    static constexpr std::uint8_t first[6] = {1, 2, 2, 0, 0, 1};
    static constexpr std::uint8_t second[6] = {2, 1, 0, 2, 1, 0};
    const std::uint32_t x = first[row];
    const std::uint32_t y = second[row];
    x_ = x;
    y_ = y;
    z_ = z;
    t_min_ = ray.t_min;
    const DoubleTag d;
    origin_x_ = hn::Set(d, ray.origin[x]);
    origin_y_ = hn::Set(d, ray.origin[y]);
    origin_z_ = hn::Set(d, ray.origin[z]);
    alignas(32) double quotient[4] = {ray.direction[x], ray.direction[y], 1, 1};
    for (std::size_t at = 0; at < 4; at += triangle_lanes)
      hn::Store(hn::Div(hn::Load(d, quotient + at), hn::Set(d, along)), d, quotient + at);
    sx_ = hn::Set(d, quotient[0]);
    sy_ = hn::Set(d, quotient[1]);
    sz_ = hn::Set(d, quotient[2]);
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
    // No branch on it: rays that start on a surface lie inside a triangle behind them half the
    // time.
    const auto inside = hn::And(hn::Or(hn::Ge(low, zero), hn::Le(high, zero)), hn::Ne(det, zero));
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
  std::size_t x_, y_, z_;
  double t_min_;
};

}  // namespace HWY_NAMESPACE
}  // namespace scenec::backend
HWY_AFTER_NAMESPACE();

#endif
