// Builds wide trees over boxes: of triangles, in blocks of four, or of single items.
//
// Domain:     any number of boxes of finite floats, at most 2^28 blocks.
// Method:     binned surface area heuristic (Wald 2007) counting blocks, not triangles, down to one
//             block; then the cheapest way to make nodes of eight out of the binary tree, by
//             dynamic programming over its subtrees (Ylitie, Karras, Laine 2017). Subtrees of a
//             fixed size are built in parallel, so the tree is the same for any pool.
// Error:      boxes are unions of those given: nothing is rounded.
// Degenerate: lists that the heuristic cannot split are halved, so the binary depth is at most 96.
// Proof:      tests/unit/backend/accel/tree_build_test.cpp (G26).
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "backend/accel/wide_tree.hpp"
#include "base/parallel.hpp"

namespace scenec::backend {

// The floats next to f; for finite f.
[[nodiscard]] inline float float_before(float f) {
  const auto bits = std::bit_cast<std::uint32_t>(f);
  return f == 0 ? -0x1p-149F : std::bit_cast<float>(f > 0 ? bits - 1 : bits + 1);
}
[[nodiscard]] inline float float_after(float f) {
  return -float_before(-f);
}
// Box planes keep off the subnormal floats: many processors take a hundred cycles to multiply by
// one, and what stands on the ground has its plane at 0.
inline constexpr float least_plane = 0x1p-100F;
// The nearest floats that are not above (below) x, or 0 or `least_plane` round 0.
[[nodiscard]] inline float float_below(double x) {
  if (std::fabs(x) < static_cast<double>(least_plane)) return x < 0 ? -least_plane : 0.0F;
  const auto f = static_cast<float>(x);
  return static_cast<double>(f) <= x ? f : float_before(f);
}
[[nodiscard]] inline float float_above(double x) {
  return -float_below(-x);
}

// A box to be placed in the tree, and its number.
struct alignas(32) BuildRef {
  float min[3];
  std::uint32_t id;
  float max[3];
  std::uint32_t unused;
};

// Cuts what a box stands for.
class RefSplitter {
 public:
  RefSplitter() = default;
  RefSplitter(const RefSplitter&) = delete;
  RefSplitter& operator=(const RefSplitter&) = delete;
  virtual ~RefSplitter() = default;
  // The boxes, within `ref`'s, of what lies below and above `plane`, which cuts the box.
  virtual void split(const BuildRef& ref, int axis, float plane, BuildRef& low,
                     BuildRef& high) const = 0;
};

enum class Splits : std::uint8_t { where_they_pay, never };

struct BuildSettings {
  std::uint32_t block_width = 1;
  std::uint32_t max_blocks = TreeRef::max_blocks;  // of a leaf
  float node_cost = 1;                             // of the tests of a node, in tests of a block
  const RefSplitter* splitter = nullptr;           // null: no spatial splits
  Splits splits = Splits::where_they_pay;
  float extra_refs = 0.3F;  // that spatial splits may add, for each one given
};

struct BuiltTree {
  static constexpr std::uint32_t no_id = 0xffffffff;
  TreeRef root;
  bool empty = true;
  bool splits_would_pay = false;  // they were not to be made
  HugeVector<WideNode> nodes;
  // Numbers of the boxes a block at a time, `no_id` where a block is not full.
  std::vector<std::uint32_t> ids;
};

// Takes `refs` and frees them when they are no longer needed.
[[nodiscard]] BuiltTree build_tree(std::vector<BuildRef> refs, const BuildSettings& settings,
                                   ThreadPool& pool);

}  // namespace scenec::backend
