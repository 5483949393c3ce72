// The disk with one more file that exists only in memory.
#pragma once

#include <string>
#include <utility>

#include "base/file_system.hpp"

namespace scenec::test {

class OverlayFileSystem final : public FileSystem {
 public:
  OverlayFileSystem(std::string path, std::string text) : path_(path) {
    added_.put(std::move(path), std::move(text));
  }
  Result<FileContent, FileError> read(const std::string& path, std::uint64_t limit) override {
    return path == path_ ? added_.read(path, limit) : disk_.read(path, limit);
  }
  bool is_file(const std::string& path) override { return path == path_ || disk_.is_file(path); }

 private:
  std::string path_;
  MemoryFileSystem added_;
  RealFileSystem disk_;
};

}  // namespace scenec::test
