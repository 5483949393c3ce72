// The lexical path functions of file_system.hpp.
#include "base/file_system.hpp"

namespace scenec {

namespace {

std::vector<std::string_view> parts_of(std::string_view path) {
  std::vector<std::string_view> parts;
  while (!path.empty()) {
    const std::size_t slash = path.find('/');
    const std::string_view part = path.substr(0, slash);
    path.remove_prefix(slash == std::string_view::npos ? path.size() : slash + 1);
    if (!part.empty()) parts.push_back(part);
  }
  return parts;
}

// Of a normalised path; "." names nothing.
std::vector<std::string_view> named_parts_of(std::string_view path) {
  return path == "." ? std::vector<std::string_view>{} : parts_of(path);
}

std::string joined_parts(const std::vector<std::string_view>& parts, bool absolute) {
  std::string path = absolute ? "/" : "";
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i > 0) path += '/';
    path += parts[i];
  }
  return path.empty() ? "." : path;
}

}  // namespace

std::string normalized_path(std::string_view path) {
  const bool absolute = path.starts_with('/');
  std::vector<std::string_view> kept;
  for (const std::string_view part : parts_of(path)) {
    if (part == ".") continue;
    if (part != "..") {
      kept.push_back(part);
    } else if (!kept.empty() && kept.back() != "..") {
      kept.pop_back();
    } else if (!absolute) {
      kept.push_back(part);
    }
  }
  return joined_parts(kept, absolute);
}

std::string directory_of(std::string_view path) {
  const std::size_t slash = path.rfind('/');
  if (slash == std::string_view::npos) return "";
  return normalized_path(slash == 0 ? "/" : path.substr(0, slash));
}

std::string joined_path(std::string_view directory, std::string_view path) {
  if (directory.empty() || path.starts_with('/')) return normalized_path(path);
  return normalized_path(std::string(directory) + '/' + std::string(path));
}

std::string relative_path(std::string_view path, std::string_view directory) {
  const std::string target = normalized_path(path);
  const std::string start = normalized_path(directory);
  if (target.starts_with('/') != start.starts_with('/')) return target;
  const auto target_parts = named_parts_of(target);
  const auto start_parts = named_parts_of(start);
  std::size_t common = 0;
  while (common < target_parts.size() && common < start_parts.size() &&
         target_parts[common] == start_parts[common]) {
    ++common;
  }
  std::vector<std::string_view> parts;
  for (std::size_t i = common; i < start_parts.size(); ++i) {
    if (start_parts[i] == "..") return target;  // the name of that directory is not known
    parts.emplace_back("..");
  }
  for (std::size_t i = common; i < target_parts.size(); ++i) parts.push_back(target_parts[i]);
  return joined_parts(parts, false);
}

std::string extension_of(std::string_view path) {
  const std::size_t slash = path.rfind('/');
  const std::string_view name = slash == std::string_view::npos ? path : path.substr(slash + 1);
  const std::size_t dot = name.rfind('.');
  if (dot == std::string_view::npos || dot == 0) return "";  // `.profile` has none
  std::string extension(name.substr(dot));
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return extension;
}

}  // namespace scenec
