#include "frontend/lower/std_library.hpp"

#include <algorithm>

namespace scenec::frontend {

std::optional<std::string_view> find_library(std::string_view path) {
  if (!path.starts_with(library_prefix) || !path.ends_with(library_extension)) return std::nullopt;
  path.remove_prefix(library_prefix.size());
  path.remove_suffix(library_extension.size());
  const std::span<const LibraryFile> files = library_files();
  const auto found = std::find_if(files.begin(), files.end(),
                                  [&](const LibraryFile& file) { return file.name == path; });
  if (found == files.end()) return std::nullopt;
  return found->text;
}

std::vector<std::string> library_names() {
  std::vector<std::string> names;
  for (const LibraryFile& file : library_files()) {
    names.push_back(std::string(library_prefix) + std::string(file.name));
  }
  return names;
}

}  // namespace scenec::frontend
