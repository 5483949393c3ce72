// The memory of a tree: nodes of eight children, and leaves that name runs of what they hold. Plain
// arrays without pointers, so that a tree may be stored and read back byte for byte.
//
// A tree lies in a space of its own (TreeSpace) in which everything bounded fits into [-1, 1]:
// scenes of 1e300 or 1e-30 are like any other, and floats are as fine as they can be.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "backend/accel/huge_vector.hpp"
#include "backend/math/bounds.hpp"

namespace scenec::backend {

// local = (world - center) * scale, scale a power of two.
struct TreeSpace {
  Point3 center;
  double scale = 1;
  double inverse_scale = 1;

  [[nodiscard]] Point3 to_local(const Point3& p) const {
    return {(p.x - center.x) * scale, (p.y - center.y) * scale, (p.z - center.z) * scale};
  }
  [[nodiscard]] Point3 to_world(const Point3& p) const {
    return {p.x * inverse_scale + center.x, p.y * inverse_scale + center.y,
            p.z * inverse_scale + center.z};
  }
  friend bool operator==(const TreeSpace&, const TreeSpace&) = default;
};

// The space in which `bounds` fits into [-1, 1]. The origin stays where it is unless the box lies
// farther from it than `far_off` times its size: what a file says in float then stays exact.
[[nodiscard]] TreeSpace space_of(const Bounds3& bounds);

// What a parent says of a child: the place of a node, in units of 32 bytes, or a leaf, a run of
// `count` blocks (triangles by four, or single items).
class TreeRef {
 public:
  static constexpr std::uint32_t max_blocks = 8;
  static constexpr std::uint32_t max_first = 1U << 28;

  TreeRef() = default;
  [[nodiscard]] static TreeRef node(std::uint32_t index) { return TreeRef(index * node_units); }
  [[nodiscard]] static TreeRef leaf(std::uint32_t first, std::uint32_t count) {
    return TreeRef(leaf_bit | (count - 1) << 28 | first);
  }
  [[nodiscard]] static TreeRef from_bits(std::uint32_t bits) { return TreeRef(bits); }

  [[nodiscard]] std::uint32_t bits() const { return bits_; }
  [[nodiscard]] bool is_leaf() const { return (bits_ & leaf_bit) != 0; }
  [[nodiscard]] std::uint32_t node_index() const { return bits_ / node_units; }
  // From the first node, in bytes.
  [[nodiscard]] std::uint64_t node_offset() const { return std::uint64_t{bits_} * 32; }
  [[nodiscard]] std::uint32_t first() const { return bits_ & (max_first - 1); }
  [[nodiscard]] std::uint32_t count() const { return (bits_ >> 28 & 7) + 1; }
  friend bool operator==(const TreeRef&, const TreeRef&) = default;

 private:
  static constexpr std::uint32_t leaf_bit = 1U << 31;
  static constexpr std::uint32_t node_units = 7;
  explicit TreeRef(std::uint32_t bits) : bits_(bits) {}
  std::uint32_t bits_;
};

// Children beside each other, an axis at a time. A place without a child has an empty box (from
// +infinity to -infinity), which no ray meets.
struct alignas(32) WideNode {
  static constexpr int width = 8;
  static constexpr std::size_t child_offset = 6 * width * sizeof(float);
  float bounds[6][width];  // min x, max x, min y, max y, min z, max z
  TreeRef child[width];
};
static_assert(offsetof(WideNode, child) == WideNode::child_offset);
static_assert(sizeof(WideNode) == 224 && std::is_trivially_copyable_v<WideNode>);

// Four triangles in tree space, a coordinate at a time. Places without a triangle have all their
// vertices in one point, which no ray hits.
template <class T>
struct alignas(32) TriangleBlock {
  static constexpr int width = 4;
  static constexpr std::uint32_t no_face = 0xffffffff;
  T vertex[3][3][width];  // vertex, axis, triangle
  std::uint32_t face[width];
};
static_assert(sizeof(TriangleBlock<float>) == 160 && sizeof(TriangleBlock<double>) == 320);

struct WideTree {
  TreeSpace space;
  Bounds3 bounds;  // world, of everything in it
  TreeRef root;    // of no meaning when `empty`
  bool empty = true;
  HugeVector<WideNode> nodes;
};

}  // namespace scenec::backend
