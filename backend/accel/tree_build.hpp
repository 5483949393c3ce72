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

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "backend/accel/wide_tree.hpp"
#include "base/parallel.hpp"

namespace scenec::backend {

// The nearest floats that are not above (below) x, for |x| <= 2.
[[nodiscard]] inline float float_below(double x) {
  const auto f = static_cast<float>(x);
  return static_cast<double>(f) <= x ? f : std::nextafter(f, -2.0F);
}
[[nodiscard]] inline float float_above(double x) {
  const auto f = static_cast<float>(x);
  return static_cast<double>(f) >= x ? f : std::nextafter(f, 2.0F);
}

// A box to be placed in the tree, and its number.
struct alignas(32) BuildRef {
  float min[3];
  std::uint32_t id;
  float max[3];
  std::uint32_t unused;
};

struct BuildSettings {
  std::uint32_t block_width = 1;
  std::uint32_t max_blocks = TreeRef::max_blocks;  // of a leaf
  float node_cost = 1;                             // of the tests of a node, in tests of a block
};

struct BuiltTree {
  static constexpr std::uint32_t no_id = 0xffffffff;
  TreeRef root;
  bool empty = true;
  HugeVector<WideNode> nodes;
  // Numbers of the boxes a block at a time, `no_id` where a block is not full.
  std::vector<std::uint32_t> ids;
};

// Reorders `refs`.
[[nodiscard]] BuiltTree build_tree(std::span<BuildRef> refs, const BuildSettings& settings,
                                   ThreadPool& pool);

}  // namespace scenec::backend
