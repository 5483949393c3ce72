// Trees of meshes kept in memory from one build of a scene to the next, by content: what has not
// changed is not built again, so that after an edit only the tree over the items is made anew. For
// whoever builds the same scene again and again; not for several threads at once.
#pragma once

#include <cstddef>
#include <map>
#include <memory>

#include "backend/accel/mesh_accel.hpp"
#include "base/hash.hpp"

namespace scenec::backend {

class TreeStore {
 public:
  // Of everything a tree and its hits depend on, attributes included.
  [[nodiscard]] static Hash128 key_of(const TriangleMesh& mesh, Precision precision);

  [[nodiscard]] std::shared_ptr<const MeshAccel> find(const Hash128& key);
  void keep(const Hash128& key, std::shared_ptr<const MeshAccel> accel);
  // Lets go of what was neither found nor kept since the last call: after each build.
  void drop_unused();
  [[nodiscard]] std::size_t size() const { return entries_.size(); }

 private:
  struct Entry {
    std::shared_ptr<const MeshAccel> accel;
    bool used = true;
  };
  std::map<Hash128, Entry> entries_;
};

}  // namespace scenec::backend
