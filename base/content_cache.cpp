#include "base/content_cache.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <memory>
#include <system_error>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/atomic_file.hpp"
#include "base/file_descriptor.hpp"

namespace scenec {

namespace {

constexpr std::string_view suffix = ".entry";
constexpr std::array<char, 8> magic{'s', 'c', 'e', 'n', 'e', 'c', 'C', '1'};
// Temporary files older than this belong to no living writer.
constexpr std::time_t abandoned_after = 3600;

// The first bytes of an entry. Written as it lies in memory: entries stay on their machine, and
// `magic` read back in another byte order is no magic.
struct EntryHeader {
  std::array<char, 8> magic{};
  std::uint64_t payload_size = 0;
  Hash128 key;
  Hash128 checksum;  // of the payload
  Hash128 seal;      // of everything above
};
static_assert(sizeof(EntryHeader) == 64 && std::is_trivially_copyable_v<EntryHeader>);

Hash128 seal_of(const EntryHeader& header) {
  std::array<char, sizeof(EntryHeader)> bytes;
  std::memcpy(bytes.data(), &header, bytes.size());
  return hash_bytes({bytes.data(), offsetof(EntryHeader, seal)});
}

// The payload of an entry's bytes, or nullopt when they are not an entry of this key.
std::optional<std::string_view> payload_of(std::string_view bytes, const Hash128& key) {
  EntryHeader header;
  if (bytes.size() < sizeof header) return std::nullopt;
  std::memcpy(&header, bytes.data(), sizeof header);
  const std::string_view payload = bytes.substr(sizeof header);
  if (header.magic != magic || header.key != key || header.seal != seal_of(header) ||
      header.payload_size != payload.size() || header.checksum != hash_bytes(payload)) {
    return std::nullopt;
  }
  return payload;
}

struct DirectoryCloser {
  void operator()(DIR* directory) const { ::closedir(directory); }
};

struct Listed {
  std::string path;
  std::uint64_t size = 0;
  timespec used{};
};

bool older(const Listed& a, const Listed& b) {
  if (a.used.tv_sec != b.used.tv_sec) return a.used.tv_sec < b.used.tv_sec;
  if (a.used.tv_nsec != b.used.tv_nsec) return a.used.tv_nsec < b.used.tv_nsec;
  return a.path < b.path;
}

// The entries of the directory; removes temporary files nobody will rename any more.
std::vector<Listed> entries_in(const std::string& directory) {
  std::vector<Listed> entries;
  const std::unique_ptr<DIR, DirectoryCloser> open(::opendir(directory.c_str()));
  if (open == nullptr) return entries;
  const std::time_t now = std::time(nullptr);
  while (const dirent* const found = ::readdir(open.get())) {
    const std::string_view name = found->d_name;
    const bool temporary =
        name.starts_with('.') && name.find(std::string(suffix) + ".tmp-") != std::string_view::npos;
    if (!temporary && !name.ends_with(suffix)) continue;
    std::string path = directory + '/' + found->d_name;
    struct stat info{};
    if (::lstat(path.c_str(), &info) != 0 || !S_ISREG(info.st_mode)) continue;
    if (!temporary) {
      entries.push_back({std::move(path), static_cast<std::uint64_t>(info.st_size), info.st_mtim});
    } else if (now - info.st_mtim.tv_sec > abandoned_after) {
      ::unlink(path.c_str());
    }
  }
  return entries;
}

}  // namespace

std::string ContentCache::path_of(const Hash128& key) const {
  return options_.directory + '/' + key.hex() + std::string(suffix);
}

std::optional<FileContent> ContentCache::find(const Hash128& key) {
  const Descriptor file(
      ::open(path_of(key).c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC | O_NOCTTY));
  std::optional<FileContent> found;
  struct stat info{};
  // What another user put there is not ours to trust.
  if (file.valid() && ::fstat(file.number(), &info) == 0 && info.st_uid == ::geteuid()) {
    auto content = read_descriptor(file, options_.budget);
    if (content) {
      if (const auto payload = payload_of(content.value().bytes, key)) {
        found = FileContent{*payload, std::move(content.value().owner)};
        const std::array<timespec, 2> now{timespec{0, UTIME_OMIT}, timespec{0, UTIME_NOW}};
        static_cast<void>(::futimens(file.number(), now.data()));
      }
    }
  }
  const std::lock_guard lock(mutex_);
  ++(found ? counts_.hits : counts_.misses);
  return found;
}

void ContentCache::refuse() {
  const std::lock_guard lock(mutex_);
  --counts_.hits;
  ++counts_.misses;
}

void ContentCache::store(const Hash128& key, std::span<const std::string_view> pieces) {
  EntryHeader header{.magic = magic, .payload_size = 0, .key = key, .checksum = {}, .seal = {}};
  Hasher hasher;
  for (const std::string_view piece : pieces) {
    hasher.raw(piece.data(), piece.size());
    header.payload_size += piece.size();
  }
  header.checksum = hasher.result();
  header.seal = seal_of(header);
  if (header.payload_size + sizeof header > options_.budget)
    return remember("an entry is larger than the budget");
  std::error_code error;
  std::filesystem::create_directories(options_.directory, error);
  if (error) return remember("the directory cannot be made: " + error.message());
  std::array<char, sizeof header> head;
  std::memcpy(head.data(), &header, head.size());
  std::vector<std::string_view> all{{head.data(), head.size()}};
  all.insert(all.end(), pieces.begin(), pieces.end());
  const std::string path = path_of(key);
  // Lost in a power cut, an entry is made again: no need to wait for the disk.
  if (auto problem = write_file_atomically(path, all, Durability::eventual))
    return remember(std::move(*problem));
  {
    const std::lock_guard lock(mutex_);
    ++counts_.stored;
  }
  evict(path);
}

void ContentCache::evict(const std::string& newest) {
  std::vector<Listed> entries = entries_in(options_.directory);
  std::uint64_t total = 0;
  for (const Listed& entry : entries) total += entry.size;
  if (total <= options_.budget) return;
  std::ranges::sort(entries, older);
  for (const Listed& entry : entries) {
    if (total <= options_.budget) break;
    if (entry.path == newest) continue;
    // Another process may have been first; the bytes are gone either way.
    ::unlink(entry.path.c_str());
    total -= entry.size;
  }
}

void ContentCache::remember(std::string note) {
  const std::lock_guard lock(mutex_);
  counts_.note = std::move(note);
}

ContentCacheCounts ContentCache::counts() const {
  const std::lock_guard lock(mutex_);
  return counts_;
}

}  // namespace scenec
