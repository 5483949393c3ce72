// The only way the compiler reads files. Results are values; exceptions do not leave. The recording
// layer remembers reads and misses: that list is the watch set, the -MD list and the test double.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "base/hash.hpp"
#include "base/result.hpp"
#include "base/work_clock.hpp"

namespace scenec {

enum class FileError : std::uint8_t {
  not_found,
  is_directory,
  not_regular,  // device, FIFO, socket
  no_permission,
  too_large,
  read_failed,
  outside_root,  // see base/rooted_file_system.hpp
};
[[nodiscard]] std::string_view text_of(FileError error);  // "no such file", "is a directory", ...

// Which file it is, by whatever name it was opened. Not set where files have no such thing.
struct FileIdentity {
  std::uint64_t device = 0;
  std::uint64_t inode = 0;
  [[nodiscard]] bool valid() const { return inode != 0; }
  friend bool operator==(const FileIdentity&, const FileIdentity&) = default;
};

// The bytes of one file at the time it was read; `owner` keeps them alive.
struct FileContent {
  std::string_view bytes;
  std::shared_ptr<const void> owner;
  FileIdentity identity = {};
};

class FileSystem {
 public:
  virtual ~FileSystem() = default;
  // Reads a regular file of at most `size_limit` bytes. Never blocks on FIFOs or devices (opened
  // non-blocking, then the descriptor is checked).
  [[nodiscard]] virtual Result<FileContent, FileError> read(const std::string& path,
                                                            std::uint64_t size_limit) = 0;
  [[nodiscard]] virtual bool is_file(const std::string& path) = 0;
  // Why a read failed, for a message; says more than `text_of` where the file system knows more.
  [[nodiscard]] virtual std::string reason_of(FileError error) const {
    return std::string(text_of(error));
  }
};

class RealFileSystem final : public FileSystem {
 public:
  Result<FileContent, FileError> read(const std::string& path, std::uint64_t size_limit) override;
  bool is_file(const std::string& path) override;
};

class MemoryFileSystem final : public FileSystem {
 public:
  void put(std::string path, std::string bytes);
  Result<FileContent, FileError> read(const std::string& path, std::uint64_t size_limit) override;
  bool is_file(const std::string& path) override;

 private:
  std::map<std::string, std::shared_ptr<const std::string>> files_;
};

struct FileRecord {
  std::string path;
  bool found = false;
  Hash128 hash;  // of the bytes, when they were read
};

// Forwards to another file system and records. Thread-safe.
class RecordingFileSystem final : public FileSystem {
 public:
  explicit RecordingFileSystem(FileSystem& inner) : inner_(inner) {}
  Result<FileContent, FileError> read(const std::string& path, std::uint64_t size_limit) override;
  bool is_file(const std::string& path) override;
  std::string reason_of(FileError error) const override { return inner_.reason_of(error); }
  [[nodiscard]] std::vector<FileRecord> records() const;               // sorted by path, one a path
  [[nodiscard]] double seconds() const { return reading_.seconds(); }  // of reading and hashing

 private:
  FileSystem& inner_;
  WorkClock reading_;
  mutable std::mutex mutex_;
  std::map<std::string, FileRecord> records_;
};

// Lexical path work (no access to the disk). `/` separates; the results are normalised.
[[nodiscard]] std::string normalized_path(std::string_view path);
[[nodiscard]] std::string directory_of(std::string_view path);  // "" for a bare name
[[nodiscard]] std::string joined_path(std::string_view directory,
                                      std::string_view path);  // absolute `path` wins
[[nodiscard]] std::string relative_path(std::string_view path, std::string_view directory);
[[nodiscard]] std::string extension_of(std::string_view path);  // lower case, with the dot

}  // namespace scenec
