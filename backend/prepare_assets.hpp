// Assets to memory: meshes and pictures read within their limits, one problem one diagnostic.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "backend/assets/mesh_data.hpp"
#include "backend/image/image.hpp"
#include "base/content_cache.hpp"
#include "base/diagnostic.hpp"
#include "base/file_system.hpp"
#include "base/limits.hpp"
#include "ir/scene.hpp"

namespace scenec::backend {

class SceneMemory;

// Counts what decoded assets take. Whether they take too much does not depend on the order in which
// they come: as long as they do not, none is left out.
class MemoryBudget {
 public:
  explicit MemoryBudget(std::uint64_t limit) : limit_(limit) {}
  void take(std::uint64_t bytes) { taken_.fetch_add(bytes, std::memory_order_relaxed); }
  [[nodiscard]] bool exceeded() const { return taken_.load(std::memory_order_relaxed) > limit_; }

 private:
  std::uint64_t limit_;
  std::atomic<std::uint64_t> taken_{0};
};

// Where assets come from, and what is too much of them.
struct AssetSource {
  FileSystem& files;
  ContentCache* cache;  // null: none
  const Limits& limits;
  MemoryBudget& budget;
  SceneMemory* memory = nullptr;
};

// Diagnostics of one task; reported afterwards in the order of the tasks.
struct TaskReport {
  std::vector<Diagnostic> diagnostics;
};

// Whatever the format: the key of what a reader makes of the file, zero without a hash of it.
[[nodiscard]] Hash128 file_key_of(const ir::Asset& asset, const Limits& limits);

// Nothing: it cannot be read (reported).
[[nodiscard]] std::optional<MeshData> read_mesh(const ir::Asset& asset, const AssetSource& source,
                                                TaskReport& report);
[[nodiscard]] std::shared_ptr<const DecodedImage> read_picture(const ir::Asset& asset,
                                                               const AssetSource& source,
                                                               TaskReport& report);

}  // namespace scenec::backend
