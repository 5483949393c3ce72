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
  const auto found = entries_.find(key);
  if (found == entries_.end()) return nullptr;
  found->second.used = true;
  return found->second.accel;
}

void TreeStore::keep(const Hash128& key, std::shared_ptr<const MeshAccel> accel) {
  entries_[key] = {std::move(accel), true};
}

void TreeStore::drop_unused() {
  std::erase_if(entries_, [](const auto& entry) { return !entry.second.used; });
  for (auto& [key, entry] : entries_) entry.used = false;
}

}  // namespace scenec::backend
