#include "backend/scene_memory.hpp"

#include <utility>

namespace scenec::backend {

std::shared_ptr<const void> SceneMemory::find_any(const Hash128& key, std::type_index type) {
  const std::lock_guard lock(mutex_);
  const auto found = index_.find(key);
  if (found == index_.end() || found->second->type != type) return nullptr;
  entries_.splice(entries_.begin(), entries_, found->second);
  ++counts_.reused;
  return found->second->value;
}

void SceneMemory::keep_any(const Hash128& key, std::type_index type,
                           std::shared_ptr<const void> value, std::uint64_t bytes) {
  const std::lock_guard lock(mutex_);
  ++counts_.made;
  if (const auto old = index_.find(key); old != index_.end()) {
    bytes_ -= old->second->bytes;
    entries_.erase(old->second);
    index_.erase(old);
  }
  if (bytes > byte_budget_) return;
  entries_.push_front({key, type, std::move(value), bytes});
  index_[key] = entries_.begin();
  bytes_ += bytes;
  while (bytes_ > byte_budget_) {
    bytes_ -= entries_.back().bytes;
    index_.erase(entries_.back().key);
    entries_.pop_back();
  }
}

SceneMemory::Counts SceneMemory::counts() const {
  const std::lock_guard lock(mutex_);
  return counts_;
}

std::uint64_t SceneMemory::bytes() const {
  const std::lock_guard lock(mutex_);
  return bytes_;
}

}  // namespace scenec::backend
