// The binary tree that a wide tree is made of.
#pragma once

#include <span>
#include <vector>

#include "backend/accel/float_box.hpp"

namespace scenec::backend {

// In depth-first order: the first child of an inner node is the next one.
struct BinaryNode {
  FloatBox box;
  std::uint32_t first = 0;   // of its references
  std::uint32_t count = 0;   // of its references, those of inner nodes too
  std::uint32_t second = 0;  // inner: the second child; leaf: 0
  [[nodiscard]] bool is_leaf() const { return second == 0; }
};

inline constexpr int max_binary_depth = 96;

// A run of references with what is known of it.
struct BuildRange {
  std::size_t first = 0;
  std::size_t count = 0;
  int depth = 0;
  FloatBox box;
  FloatBox centers;  // of the doubled centres
};

// A way to divide a run by the centres of its boxes.
struct ObjectSplit {
  int axis = -1;  // -1: there is none
  int bins = 0;
  int bin = 0;  // the last of the left side
  float cost = FloatBox::infinity;
  FloatBox left;
  FloatBox right;
};
[[nodiscard]] ObjectSplit best_object_split(std::span<const BuildRef> refs, const BuildRange& range,
                                            std::uint32_t block_width);
// Reorders the run; the number of references on the left.
std::size_t partition_run(std::span<BuildRef> refs, const BuildRange& range,
                          const ObjectSplit& split, FloatBox& left_centers,
                          FloatBox& right_centers);
// From here on runs are halved: 32 further levels hold any 32-bit count.
inline constexpr int depth_of_heuristic = max_binary_depth - 33;

[[nodiscard]] BuildRange whole_range(std::span<const BuildRef> refs);

// Splits the run in two and reorders it; false when it is to be a leaf.
bool split_range(std::span<BuildRef> refs, const BuildRange& range, const BuildSettings& settings,
                 BuildRange& left, BuildRange& right);

// The tree below a run, down to leaves of one block.
[[nodiscard]] std::vector<BinaryNode> build_binary(std::span<BuildRef> refs,
                                                   const BuildRange& range,
                                                   const BuildSettings& settings);

// Appends the wide tree made of it to `out`; the numbers come from `refs`.
[[nodiscard]] TreeRef collapse(std::span<const BinaryNode> tree, std::span<const BuildRef> refs,
                               const BuildSettings& settings, HugeVector<WideNode>& nodes,
                               std::vector<std::uint32_t>& ids);

void set_child(WideNode& node, int place, const FloatBox& box, TreeRef child);
void clear_children(WideNode& node);

}  // namespace scenec::backend
