// A built mesh tree as bytes and back, for the cache. The tree of a mesh depends on the mesh alone,
// not on threads or instruction set, so what was stored is what would be built.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "backend/accel/mesh_accel.hpp"
#include "base/hash.hpp"

namespace scenec::backend {

// `mesh`: the key of the mesh the tree is over, with all that was made of its file.
[[nodiscard]] Hash128 tree_key(const Hash128& mesh, Precision precision);

// The bytes of an accelerator in pieces, most of which lie in it: it must stay. `built_from`: the
// mesh it was made of, whose vertices the tree may have moved (`mesh()`).
class EncodedTree {
 public:
  EncodedTree(const MeshAccel& accel, const TriangleMesh& built_from);
  EncodedTree(const EncodedTree&) = delete;
  EncodedTree& operator=(const EncodedTree&) = delete;
  [[nodiscard]] std::span<const std::string_view> pieces() const& { return pieces_; }
  void pieces() && = delete;

 private:
  std::string head_;
  std::vector<std::string_view> pieces_;
};

// The accelerator over `mesh`; null when the bytes are no sound tree for it: every reference to a
// node, a block or a face is examined.
[[nodiscard]] std::shared_ptr<const MeshAccel> decode_tree(
    std::string_view bytes, std::shared_ptr<const TriangleMesh> mesh);

}  // namespace scenec::backend
