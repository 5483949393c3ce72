#include "base/file_system.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>
#include <optional>
#include <utility>

namespace scenec {

std::string_view text_of(FileError error) {
  switch (error) {
    case FileError::not_found:
      return "no such file";
    case FileError::is_directory:
      return "is a directory";
    case FileError::not_regular:
      return "is not a regular file";
    case FileError::no_permission:
      return "permission denied";
    case FileError::too_large:
      return "is too large";
    case FileError::read_failed:
      return "reading failed";
  }
  return "reading failed";
}

// ---- the disk -----------------------------------------------------------------------------------

namespace {

FileError error_of(int error_number) {
  switch (error_number) {
    case ENOENT:
    case ENOTDIR:
    case ENAMETOOLONG:
    case ELOOP:
      return FileError::not_found;
    case EISDIR:
      return FileError::is_directory;
    case ENXIO:
    case ENODEV:
      return FileError::not_regular;
    case EACCES:
    case EPERM:
      return FileError::no_permission;
    case EFBIG:
    case EOVERFLOW:
    case ENOMEM:
      return FileError::too_large;
    default:
      return FileError::read_failed;
  }
}

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  [[nodiscard]] int number() const { return number_; }

 private:
  int number_;
};

std::optional<FileError> find_kind_problem(const struct stat& info) {
  if (S_ISREG(info.st_mode)) return std::nullopt;
  return S_ISDIR(info.st_mode) ? FileError::is_directory : FileError::not_regular;
}

bool changed(const struct stat& before, const struct stat& after) {
  return before.st_size != after.st_size || before.st_mtim.tv_sec != after.st_mtim.tv_sec ||
         before.st_mtim.tv_nsec != after.st_mtim.tv_nsec;
}

// Reads until the end of the file. The buffer is one byte larger than the file is said to be: when
// that byte is filled, the file has grown and the buffer grows with it, up to the limit.
Result<FileContent, FileError> read_all(int descriptor, std::uint64_t expected_size,
                                        std::uint64_t size_limit) {
  std::uint64_t capacity = expected_size + 1;
  auto buffer = std::make_shared_for_overwrite<char[]>(capacity);
  std::uint64_t size = 0;
  while (true) {
    const ssize_t count =
        ::pread(descriptor, buffer.get() + size, capacity - size, static_cast<off_t>(size));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return Failure{error_of(errno)};
    if (count == 0) break;
    size += static_cast<std::uint64_t>(count);
    if (size > size_limit) return Failure{FileError::too_large};
    if (size == capacity) {
      capacity = std::max<std::uint64_t>(2 * capacity, 4096);
      auto larger = std::make_shared_for_overwrite<char[]>(capacity);
      std::memcpy(larger.get(), buffer.get(), size);
      buffer = std::move(larger);
    }
  }
  return FileContent{{buffer.get(), size}, buffer};
}

Result<FileContent, FileError> read_regular(const std::string& path, std::uint64_t size_limit) {
  // Opened non-blocking: a FIFO without a writer must not hold us, a terminal must not become ours.
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY));
  if (file.number() < 0) return Failure{error_of(errno)};
  struct stat before{};
  if (::fstat(file.number(), &before) != 0) return Failure{error_of(errno)};
  for (int attempt = 0;; ++attempt) {
    if (const auto problem = find_kind_problem(before)) return Failure{*problem};
    const auto stated_size = static_cast<std::uint64_t>(before.st_size);
    if (stated_size > size_limit) return Failure{FileError::too_large};
    auto content = read_all(file.number(), stated_size, size_limit);
    struct stat after{};
    if (::fstat(file.number(), &after) != 0) return Failure{error_of(errno)};
    // Somebody wrote while we read: a second look mends the common case of an editor that saves.
    if (attempt > 0 || !changed(before, after)) return content;
    before = after;
  }
}

bool has_nul(const std::string& path) {
  return path.find('\0') != std::string::npos;
}

}  // namespace

Result<FileContent, FileError> RealFileSystem::read(const std::string& path,
                                                    std::uint64_t size_limit) {
  if (has_nul(path)) return Failure{FileError::not_found};  // the system would read a shorter name
  try {
    return read_regular(path, size_limit);
  } catch (const std::bad_alloc&) {
    return Failure{FileError::too_large};
  }
}

bool RealFileSystem::is_file(const std::string& path) {
  struct stat info{};
  return !has_nul(path) && ::stat(path.c_str(), &info) == 0 && S_ISREG(info.st_mode);
}

// ---- memory -------------------------------------------------------------------------------------

void MemoryFileSystem::put(std::string path, std::string bytes) {
  files_.insert_or_assign(std::move(path), std::make_shared<const std::string>(std::move(bytes)));
}

Result<FileContent, FileError> MemoryFileSystem::read(const std::string& path,
                                                      std::uint64_t size_limit) {
  const auto found = files_.find(path);
  if (found == files_.end()) return Failure{FileError::not_found};
  if (found->second->size() > size_limit) return Failure{FileError::too_large};
  return FileContent{*found->second, found->second};
}

bool MemoryFileSystem::is_file(const std::string& path) {
  return files_.contains(path);
}

// ---- recording ----------------------------------------------------------------------------------

Result<FileContent, FileError> RecordingFileSystem::read(const std::string& path,
                                                         std::uint64_t size_limit) {
  auto content = inner_.read(path, size_limit);
  const Hash128 hash = content.ok() ? hash_bytes(content.value().bytes) : Hash128{};
  const std::lock_guard lock(mutex_);
  FileRecord& record = records_.try_emplace(path, FileRecord{path, false, {}}).first->second;
  // The first content stays: when a later read differs, the record no longer matches the disk and a
  // watcher sees that.
  if (content.ok() && record.hash == Hash128{}) record = {path, true, hash};
  return content;
}

bool RecordingFileSystem::is_file(const std::string& path) {
  const bool found = inner_.is_file(path);
  const std::lock_guard lock(mutex_);
  FileRecord& record = records_.try_emplace(path, FileRecord{path, false, {}}).first->second;
  record.found = record.found || found;
  return found;
}

std::vector<FileRecord> RecordingFileSystem::records() const {
  const std::lock_guard lock(mutex_);
  std::vector<FileRecord> result;
  result.reserve(records_.size());
  for (const auto& [path, record] : records_) result.push_back(record);
  return result;
}

}  // namespace scenec
