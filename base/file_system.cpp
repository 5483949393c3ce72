#include "base/file_system.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include "base/file_descriptor.hpp"

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
    case FileError::outside_root:
      return "lies outside the root";
  }
  return "reading failed";
}

// ---- the disk -----------------------------------------------------------------------------------

namespace {

Result<FileContent, FileError> read_regular(const std::string& path, std::uint64_t size_limit) {
  // Opened non-blocking: a FIFO without a writer must not hold us, a terminal must not become ours.
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY));
  if (!file.valid()) return Failure{file_error_of(errno)};
  return read_descriptor(file, size_limit);
}

bool has_nul(const std::string& path) {
  return path.find('\0') != std::string::npos;
}

}  // namespace

Result<FileContent, FileError> RealFileSystem::read(const std::string& path,
                                                    std::uint64_t size_limit) {
  if (has_nul(path)) return Failure{FileError::not_found};  // the system would read a shorter name
  return read_regular(path, size_limit);
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
  const WorkClock::Running reading(&reading_);
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
