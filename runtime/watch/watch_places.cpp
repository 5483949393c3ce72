#include "runtime/watch/watch_places.hpp"

#include <sys/stat.h>

#include <deque>
#include <filesystem>

namespace scenec::runtime {

namespace {

constexpr int most_links = 40;  // as many as the system follows

// Puts the names of `path` before the others.
void put_before(std::deque<std::string>& names, std::string_view path) {
  std::deque<std::string> first;
  while (!path.empty()) {
    const std::size_t slash = path.find('/');
    const std::string_view name = path.substr(0, slash);
    if (!name.empty() && name != ".") first.emplace_back(name);
    path = slash == std::string_view::npos ? std::string_view{} : path.substr(slash + 1);
  }
  names.insert(names.begin(), first.begin(), first.end());
}

std::string in_directory(const std::string& directory, const std::string& name) {
  return directory == "/" ? "/" + name : directory + "/" + name;
}

std::string parent_of(const std::string& directory) {
  const std::size_t slash = directory.rfind('/');
  return slash == 0 || slash == std::string::npos ? "/" : directory.substr(0, slash);
}

}  // namespace

std::vector<Place> places_of(std::string_view path) {
  std::vector<Place> places;
  std::deque<std::string> names;
  put_before(names, path);
  std::error_code error;
  if (!path.starts_with('/')) put_before(names, std::filesystem::current_path(error).string());
  std::string directory = "/";
  int links = 0;
  while (!names.empty()) {
    const std::string name = names.front();
    names.pop_front();
    if (name == "..") {
      directory = parent_of(directory);
      continue;
    }
    places.push_back({directory, name});
    const std::string here = in_directory(directory, name);
    struct stat status{};
    if (::lstat(here.c_str(), &status) != 0) break;
    if (S_ISLNK(status.st_mode)) {
      if (++links > most_links) break;
      const std::filesystem::path target = std::filesystem::read_symlink(here, error);
      if (error) break;
      put_before(names, target.string());
      if (target.is_absolute()) directory = "/";
    } else if (S_ISDIR(status.st_mode)) {
      directory = here;
    } else {
      break;
    }
  }
  return places;
}

}  // namespace scenec::runtime
