#include "backend/accel/tree_store.hpp"

#include <utility>
#include <vector>

namespace scenec::backend {
namespace {

template <class T>
void add_list(Hasher& hasher, const std::vector<T>& values) {
  hasher.add(values.size());
  hasher.raw(values.data(), values.size() * sizeof(T));
}

}  // namespace

Hash128 TreeStore::key_of(const TriangleMesh& mesh, Precision precision) {
  Hasher hasher;
  hasher.add(precision);
  add_list(hasher, mesh.positions);
  add_list(hasher, mesh.faces);
  add_list(hasher, mesh.normals);
  add_list(hasher, mesh.normal_faces);
  add_list(hasher, mesh.uvs);
  add_list(hasher, mesh.uv_faces);
  return hasher.result();
}

std::shared_ptr<const MeshAccel> TreeStore::find(const Hash128& key) {
  const auto found = meshes_.find(key);
  if (found == meshes_.end()) return nullptr;
  found->second.used = true;
  ++mesh_counts_.reused;
  return found->second.kept;
}

void TreeStore::keep(const Hash128& key, std::shared_ptr<const MeshAccel> accel) {
  meshes_[key] = {std::move(accel), true};
  ++mesh_counts_.made;
}

std::shared_ptr<const Revolve> TreeStore::find_revolve(const Hash128& key) {
  const auto found = revolves_.find(key);
  if (found == revolves_.end()) return nullptr;
  found->second.used = true;
  return found->second.kept;
}

void TreeStore::keep_revolve(const Hash128& key, std::shared_ptr<const Revolve> revolve) {
  revolves_[key] = {std::move(revolve), true};
}

void TreeStore::build(SceneAccel& world, ThreadPool& pool, Target target) {
  const Hash128 key = world.content_key(target);
  if (const auto found = worlds_.find(key); found != worlds_.end()) {
    found->second.used = true;
    ++world_counts_.reused;
    world = found->second.kept.share();
    return;
  }
  world.build(pool, target);
  worlds_[key] = {world.share(), true};
  ++world_counts_.made;
}

void TreeStore::drop_unused() {
  const auto drop = [](auto& entries) {
    std::erase_if(entries, [](const auto& entry) { return !entry.second.used; });
    for (auto& [key, entry] : entries) entry.used = false;
  };
  drop(worlds_);
  drop(meshes_);
  drop(revolves_);
}

}  // namespace scenec::backend
