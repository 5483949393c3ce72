#include "runtime/watch/scene_folder.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>

namespace scenec::runtime {

namespace {

namespace fs = std::filesystem;

// Nothing: the folder cannot be read.
std::optional<std::vector<std::string>> scenes_in(const std::string& folder) {
  std::error_code error;
  std::vector<std::string> found;
  fs::directory_iterator at(folder, error);
  if (error) return std::nullopt;
  for (const fs::directory_iterator end; !error && at != end; at.increment(error)) {
    std::error_code unknown;
    if (is_scene_name(at->path().filename().string()) && at->is_regular_file(unknown))
      found.push_back(at->path().string());
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

bool is_scene_name(std::string_view name) {
  return !name.starts_with('.') && extension_of(name) == ".sdl";
}

bool is_folder(const std::string& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

bool is_listing(std::string_view path) {
  return path.ends_with('/');
}

FileRecord listing_of(const std::string& folder) {
  std::string path = folder;
  if (!is_listing(path)) path += '/';
  const auto found = scenes_in(folder);
  if (!found) return {.path = path, .found = false, .hash = {}};
  std::string names;
  for (const std::string& scene : *found) names += scene + '\0';
  return {.path = path, .found = true, .hash = hash_bytes(names)};
}

std::vector<std::string> scenes_of(const std::vector<std::string>& operands) {
  std::vector<std::string> scenes;
  for (const std::string& operand : operands) {
    std::vector<std::string> some{operand};
    if (is_folder(operand)) some = scenes_in(operand).value_or(std::vector<std::string>{});
    for (std::string& scene : some) {
      if (std::find(scenes.begin(), scenes.end(), scene) == scenes.end())
        scenes.push_back(std::move(scene));
    }
  }
  return scenes;
}

}  // namespace scenec::runtime
