// A mesh with its tree, immutable, shared by every item that places it.
//
// Domain:     as mesh.hpp; faces with vertices that are not finite are left out.
// Method:     vertices in float, in the tree's own space: those of a file written in float, or of a
//             mesh built from such, stay exactly what they are; others move by at most 2^-25 of the
//             mesh's size, and `mesh()` says where they lie now, so that hits, normals and lights
//             all speak of the same surface. A mesh that this would spoil (a face would lose its
//             area or turn over), or that is asked for in double, keeps its vertices in double.
// Error:      triangle.hpp for rays of the tree's space; `mesh()` differs from what is traced by
// the
//             rounding of one addition a coordinate.
// Degenerate: no faces: an empty tree.
// Proof:      tests/unit/backend/accel/mesh_accel_test.cpp.
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "backend/accel/precision.hpp"
#include "backend/accel/wide_tree.hpp"
#include "backend/geometry/mesh.hpp"
#include "base/parallel.hpp"

namespace scenec::backend {

// A tree over triangles: plain arrays, one of the two kinds of blocks.
struct MeshTree {
  WideTree tree;
  HugeVector<TriangleBlock<float>> blocks;
  HugeVector<TriangleBlock<double>> full_blocks;
  [[nodiscard]] bool full() const { return !full_blocks.empty(); }
  [[nodiscard]] std::size_t bytes() const;
};

class MeshAccel {
 public:
  MeshAccel(std::shared_ptr<const TriangleMesh> mesh, ThreadPool& pool,
            Precision precision = Precision::mixed);
  MeshAccel(TriangleMesh mesh, ThreadPool& pool, Precision precision = Precision::mixed)
      : MeshAccel(std::make_shared<const TriangleMesh>(std::move(mesh)), pool, precision) {}
  // From a stored tree: `mesh` must be what `mesh()` gave with it.
  MeshAccel(std::shared_ptr<const TriangleMesh> mesh, MeshTree tree)
      : mesh_(std::move(mesh)), tree_(std::move(tree)) {}

  // As traced.
  [[nodiscard]] const TriangleMesh& mesh() const { return *mesh_; }
  [[nodiscard]] const std::shared_ptr<const TriangleMesh>& shared_mesh() const { return mesh_; }
  [[nodiscard]] const MeshTree& tree() const { return tree_; }
  [[nodiscard]] Bounds3 bounds() const { return tree_.tree.bounds; }

 private:
  std::shared_ptr<const TriangleMesh> mesh_;
  MeshTree tree_;
};

}  // namespace scenec::backend
