// What one process keeps of the scenes it has made (a watch daemon makes the same one again and
// again): meshes and images, each under the hash of what it was made from. Thread-safe.
// What was used longest ago goes first when the budget is reached; who still uses it keeps it.
#pragma once

#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <typeindex>
#include <unordered_map>

#include "backend/backend.hpp"
#include "base/hash.hpp"

namespace scenec::backend {

class SceneMemory {
 public:
  explicit SceneMemory(std::uint64_t byte_budget = std::uint64_t{1} << 30)
      : byte_budget_(byte_budget) {}

  struct Counts {
    std::uint64_t reused = 0;
    std::uint64_t made = 0;
  };

  template <class T>
  [[nodiscard]] std::shared_ptr<const T> find(const Hash128& key) {
    return std::static_pointer_cast<const T>(find_any(key, typeid(T)));
  }
  template <class T>
  void keep(const Hash128& key, std::shared_ptr<const T> value, std::uint64_t bytes) {
    keep_any(key, typeid(T), std::move(value), bytes);
  }

  [[nodiscard]] Counts counts() const;
  [[nodiscard]] std::uint64_t bytes() const;

 private:
  struct Entry {
    Hash128 key;
    std::type_index type;
    std::shared_ptr<const void> value;
    std::uint64_t bytes = 0;
  };
  std::shared_ptr<const void> find_any(const Hash128& key, std::type_index type);
  void keep_any(const Hash128& key, std::type_index type, std::shared_ptr<const void> value,
                std::uint64_t bytes);

  std::uint64_t byte_budget_;
  mutable std::mutex mutex_;
  std::uint64_t bytes_ = 0;
  Counts counts_;
  std::list<Entry> entries_;  // the one used last first
  std::unordered_map<Hash128, std::list<Entry>::iterator> index_;
};

// As in backend.hpp, with what the process has kept; what it then has to make it keeps. Only what
// gave no diagnostic is kept, so that every run says the same.
[[nodiscard]] PreparedPtr prepare(const ir::Scene& scene, FileSystem& files, ThreadPool& pool,
                                  DiagnosticSink& sink, ContentCache* cache, const Limits& limits,
                                  SceneMemory& memory);

}  // namespace scenec::backend
