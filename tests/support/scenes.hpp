// The scene files of the project, for what must hold for each of them.
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/paths.hpp"

namespace scenec::test {

[[nodiscard]] inline std::string text_of_file(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// Every `.sdl` and `.txt` file beneath these folders of the project, sorted.
[[nodiscard]] inline std::vector<std::filesystem::path> scenes_beneath(
    std::initializer_list<std::string_view> folders) {
  std::vector<std::filesystem::path> paths;
  for (const std::string_view folder : folders) {
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(source_directory() / folder)) {
      const std::string extension = entry.path().extension().string();
      const bool is_scene = extension == ".sdl" || extension == ".txt";
      if (is_scene && entry.path().filename() != "CMakeLists.txt") paths.push_back(entry.path());
    }
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

}  // namespace scenec::test
