#include "runtime/root.hpp"

#include <filesystem>

#include "base/file_system.hpp"
#include "grammar/parse.hpp"

namespace scenec::runtime {

namespace {

namespace fs = std::filesystem;

bool is_beneath(const std::string& path, const std::string& directory) {
  return directory == "/" || path == directory || path.starts_with(directory + "/");
}

// By its name, since paths in the scene are put behind that, and with links followed.
bool is_beneath_working_directory(const std::string& directory) {
  std::error_code error;
  const std::string working = fs::current_path(error).string();
  if (error || !is_beneath(joined_path(working, directory), working)) return false;
  const std::string real = fs::weakly_canonical(directory, error).string();
  return !error && is_beneath(real, working);
}

bool is_course(const Options& options, const std::string& scene_path) {
  if (options.dialect) return *options.dialect == grammar::Dialect::course;
  if (grammar::dialect_of(scene_path, {}) == grammar::Dialect::sdl) return false;  // by its name
  RealFileSystem disk;
  const auto content = disk.read(scene_path, grammar::ParseLimits{}.file);
  const std::string_view text = content ? content.value().bytes : std::string_view{};
  return grammar::dialect_of(scene_path, text) == grammar::Dialect::course;
}

}  // namespace

std::string root_of(const Options& options, const std::string& scene_path) {
  if (!options.root.empty()) return options.root;
  const std::string named = directory_of(scene_path);
  const std::string directory = named.empty() ? "." : named;
  if (is_beneath_working_directory(directory)) return ".";
  return is_course(options, scene_path) ? joined_path(directory, "..") : directory;
}

}  // namespace scenec::runtime
