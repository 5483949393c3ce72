// A directory of results that are cheaper to read than to make again, each under the hash of what
// it was made from. Whatever is wrong with an entry (cut off, damaged, foreign, of another
// version), it counts as absent: nothing here can fail a run. Entries are replaced whole and the
// least recently used ones go when the budget is reached, so any number of processes may share it.
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/file_system.hpp"
#include "base/hash.hpp"

namespace scenec {

struct ContentCacheOptions {
  std::string directory;
  std::uint64_t budget = std::uint64_t{2} << 30;  // bytes of all entries
};

struct ContentCacheCounts {
  std::uint64_t hits = 0;
  std::uint64_t misses = 0;
  std::uint64_t stored = 0;
  std::string note;  // why the last entry was not kept; empty: nothing went wrong
};

class ContentCache {
 public:
  explicit ContentCache(ContentCacheOptions options) : options_(std::move(options)) {}

  // The bytes stored under `key`; the entry then counts as used now. Thread-safe, as all of it.
  [[nodiscard]] std::optional<FileContent> find(const Hash128& key);
  // Keeps the pieces, one after the other, as the bytes of `key`.
  void store(const Hash128& key, std::span<const std::string_view> pieces);
  // What find() gave could not be used after all: counts as a miss.
  void refuse();
  [[nodiscard]] ContentCacheCounts counts() const;
  [[nodiscard]] std::string path_of(const Hash128& key) const;

 private:
  void evict(const std::string& newest);
  void remember(std::string note);

  ContentCacheOptions options_;
  mutable std::mutex mutex_;
  ContentCacheCounts counts_;
};

}  // namespace scenec
