// Trees kept in memory from one build of a scene to the next, by content: those of meshes and
// those over the items of the world and of its groups. What has not changed is not built again: an
// edit of a camera, a light or a material builds none. For whoever builds the same scene again and
// again; not for several threads at once.
#pragma once

#include <cstddef>
#include <map>
#include <memory>

#include "backend/accel/mesh_accel.hpp"
#include "backend/accel/scene_accel.hpp"
#include "base/hash.hpp"

namespace scenec::backend {

class TreeStore {
 public:
  // Of everything a tree and its hits depend on, attributes included.
  [[nodiscard]] static Hash128 key_of(const TriangleMesh& mesh, Precision precision);

  [[nodiscard]] std::shared_ptr<const MeshAccel> find(const Hash128& key);
  void keep(const Hash128& key, std::shared_ptr<const MeshAccel> accel);
  [[nodiscard]] std::shared_ptr<const Revolve> find_revolve(const Hash128& key);
  void keep_revolve(const Hash128& key, std::shared_ptr<const Revolve> revolve);
  // Builds a world that has been filled, or makes it the one that was built of the same.
  void build(SceneAccel& world, ThreadPool& pool, Target target);

  struct Counts {
    std::uint64_t reused = 0;
    std::uint64_t made = 0;
  };
  // Since the beginning: trees of meshes, and trees over items.
  [[nodiscard]] const Counts& mesh_counts() const { return mesh_counts_; }
  [[nodiscard]] const Counts& world_counts() const { return world_counts_; }

  // Lets go of what was neither found nor kept since the last call: after each build.
  void drop_unused();
  [[nodiscard]] std::size_t size() const { return meshes_.size(); }  // trees of meshes

 private:
  template <class T>
  struct Entry {
    T kept;
    bool used = true;
  };
  template <class T>
  using Entries = std::map<Hash128, Entry<T>>;
  Entries<std::shared_ptr<const MeshAccel>> meshes_;
  Entries<std::shared_ptr<const Revolve>> revolves_;
  Entries<SceneAccel> worlds_;
  Counts mesh_counts_;
  Counts world_counts_;
};

}  // namespace scenec::backend
