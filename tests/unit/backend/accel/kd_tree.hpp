// A kd-tree over triangles: what renderers of this family usually start with. Kept for comparison
// only, in time (tests/bench/scaling.cpp) and in hits (kd_tree_test.cpp).
//
// Domain:     any mesh; rays with finite origin and direction.
// Method:     planes by the surface area heuristic over 32 bins (Wald and Havran 2006, without
//             clipping), faces that touch a plane on both sides of it; triangles by the product's
//             own kernel.
// Error:      a plane's distance carries 3 unit round-offs; both sides are visited within 4.
// Degenerate: planes a ray runs along are visited on both sides.
// Proof:      tests/unit/backend/accel/kd_tree_test.cpp: the bits of brute force.
#pragma once

#include <cstdint>
#include <vector>

#include "backend/geometry/mesh.hpp"

namespace scenec::test {

class KdTree {
 public:
  explicit KdTree(const backend::TriangleMesh& mesh);  // `mesh` must outlive it

  // The nearest hit, of equal ones that of the smallest face. `hit.part` is the face.
  [[nodiscard]] bool find(const backend::Ray& ray, backend::ShapeHit& hit) const;

  [[nodiscard]] std::uint64_t bytes() const;

 private:
  struct Node {
    static constexpr std::uint32_t leaf = 3;
    double plane = 0;
    std::uint32_t axis = leaf;
    std::uint32_t first = 0;  // of a leaf's faces; else the child below, the other one follows it
    std::uint32_t count = 0;
  };
  struct Builder;

  const backend::TriangleMesh& mesh_;
  backend::Bounds3 bounds_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> faces_;
};

// Every triangle asked, with the same rule for ties.
[[nodiscard]] bool find_by_brute_force(const backend::TriangleMesh& mesh, const backend::Ray& ray,
                                       backend::ShapeHit& hit);

}  // namespace scenec::test
