// The disk beneath one directory. Every path is followed from a handle of that directory and never
// leaves it: `..`, absolute paths, symbolic links and the links of /proc count by where they lead,
// and no time passes between the check and the opening. Hard links are files like any other: who
// can make one beneath the root may write there; where that is not enough, `refuse_hard_links`
// treats files with a second name as lying outside.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/file_descriptor.hpp"
#include "base/file_system.hpp"

namespace scenec {

class RootedFileSystem final : public FileSystem {
 public:
  // Who follows the path: the system in one call (openat2), or we, name by name, as where the
  // system does not offer that (before Linux 5.6, or filtered in a container).
  enum class Walk : std::uint8_t { by_system, by_name };

  // Relative paths are seen from the working directory, now. Of a root that cannot be opened
  // nothing can be read.
  explicit RootedFileSystem(const std::string& root, Walk walk = Walk::by_system);

  // A path the user gave himself, read wherever it leads.
  void permit(std::string path) { permitted_.push_back(std::move(path)); }

  void refuse_hard_links() { refuses_hard_links_ = true; }

  // As RealFileSystem; `outside_root` says nothing of whether the file exists.
  Result<FileContent, FileError> read(const std::string& path, std::uint64_t size_limit) override;
  bool is_file(const std::string& path) override;
  std::string reason_of(FileError error) const override;

 private:
  enum class Purpose : std::uint8_t { look, read };
  Result<Descriptor, FileError> open(const std::string& path, Purpose purpose) const;
  Result<Descriptor, FileError> open_by_name(std::string_view path, Purpose purpose) const;
  [[nodiscard]] bool is_permitted(const std::string& path) const;

  std::string shown_root_;
  std::string working_directory_;
  std::vector<std::string> names_;  // absolute: the root as named, and without links
  Descriptor root_;
  FileError root_error_ = FileError::not_found;
  Walk walk_;
  bool refuses_hard_links_ = false;
  RealFileSystem disk_;
  std::vector<std::string> permitted_;
};

}  // namespace scenec
