#include "base/file_descriptor.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>
#include <new>
#include <optional>

#include "base/huge_pages.hpp"

namespace scenec {

FileError file_error_of(int error_number) {
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

namespace {

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
  advise_huge_pages(buffer.get(), capacity);
  std::uint64_t size = 0;
  while (true) {
    const ssize_t count =
        ::pread(descriptor, buffer.get() + size, capacity - size, static_cast<off_t>(size));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return Failure{file_error_of(errno)};
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

Result<FileContent, FileError> read_regular(int file, std::uint64_t size_limit) {
  struct stat before{};
  if (::fstat(file, &before) != 0) return Failure{file_error_of(errno)};
  for (int attempt = 0;; ++attempt) {
    if (const auto problem = find_kind_problem(before)) return Failure{*problem};
    const auto stated_size = static_cast<std::uint64_t>(before.st_size);
    if (stated_size > size_limit) return Failure{FileError::too_large};
    auto content = read_all(file, stated_size, size_limit);
    if (content) content.value().identity = {before.st_dev, before.st_ino};
    struct stat after{};
    if (::fstat(file, &after) != 0) return Failure{file_error_of(errno)};
    // Somebody wrote while we read: a second look mends the common case of an editor that saves.
    if (attempt > 0 || !changed(before, after)) return content;
    before = after;
  }
}

}  // namespace

Result<FileContent, FileError> read_descriptor(const Descriptor& file, std::uint64_t size_limit) {
  try {
    return read_regular(file.number(), size_limit);
  } catch (const std::bad_alloc&) {
    return Failure{FileError::too_large};
  }
}

}  // namespace scenec
