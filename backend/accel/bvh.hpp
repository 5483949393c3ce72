// A bounding volume hierarchy over boxes: what it is built from is the caller's business.
//
// Domain:     any number of non-empty finite boxes (empty and non-finite ones are left out).
// Method:     binned surface area heuristic (Wald 2007), 32 bins an axis, ties to the first; flat
//             nodes in depth-first order. The same input gives the same tree for any pool.
// Error:      boxes are doubles copied, never rounded inward.
// Degenerate: equal centroids are split in the middle of the list, so depth never exceeds
//             `max_depth`; nodes <= 2 n.
// Proof:      tests/unit/backend/accel/bvh_test.cpp (G19-G22, G26).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "backend/math/bounds.hpp"
#include "base/parallel.hpp"

namespace scenec::backend {

struct alignas(64) BvhNode {
  Bounds3 box;
  std::uint32_t first =
      0;  // leaf: first entry of `order`; inner: the second child (the first is next)
  std::uint32_t count = 0;  // leaf: entries; inner: 0
  std::uint32_t axis = 0;   // inner: axis of the split
};

class Bvh {
 public:
  static constexpr int max_depth = 96;
  static constexpr std::uint32_t max_leaf = 4;

  Bvh() = default;
  Bvh(std::span<const Bounds3> boxes, ThreadPool& pool);

  [[nodiscard]] bool empty() const { return nodes_.empty(); }
  [[nodiscard]] const std::vector<BvhNode>& nodes() const { return nodes_; }
  // Indices of the boxes in leaf order.
  [[nodiscard]] const std::vector<std::uint32_t>& order() const { return order_; }
  [[nodiscard]] Bounds3 bounds() const { return nodes_.empty() ? Bounds3{} : nodes_.front().box; }
  [[nodiscard]] int depth() const { return depth_; }

 private:
  std::vector<BvhNode> nodes_;
  std::vector<std::uint32_t> order_;
  int depth_ = 0;
};

}  // namespace scenec::backend
