#include "frontend/course/assets.hpp"

#include <filesystem>
#include <map>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"

namespace scenec::frontend::course {

namespace {

constexpr std::uint64_t size_limit = 512ull << 20;

std::string absolute_path(const std::string& path) {
  std::error_code error;
  const std::filesystem::path absolute = std::filesystem::absolute(path, error);
  return error ? path : normalized_path(absolute.string());
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\r'))
    text.remove_suffix(1);
  return text;
}

// Calls take(key, rest) for every line that is not empty.
template <class Take>
void for_each_line(std::string_view text, Take&& take) {
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view line = trimmed(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (line.empty() || line.front() == '#') continue;
    const std::size_t blank = line.find_first_of(" \t");
    take(line.substr(0, blank),
         blank == std::string_view::npos ? std::string_view{} : trimmed(line.substr(blank)));
  }
}

std::vector<double> numbers_in(std::string_view text) {
  std::vector<double> numbers;
  while (!text.empty()) {
    const std::size_t end = text.find_first_of(" \t");
    const auto value = parse_double(text.substr(0, end));
    if (!value) break;
    numbers.push_back(*value);
    text = end == std::string_view::npos ? std::string_view{} : trimmed(text.substr(end));
  }
  return numbers;
}

struct ObjSummary {
  std::vector<std::string> libraries;
  std::string main_material;
  std::size_t material_count = 0;
  std::size_t main_faces = 0;
  std::size_t faces = 0;
};

ObjSummary summary_of(std::string_view text) {
  ObjSummary summary;
  std::map<std::string, std::size_t, std::less<>> faces;
  std::size_t* current = nullptr;
  for_each_line(text, [&](std::string_view key, std::string_view rest) {
    if (key == "mtllib") {
      summary.libraries.emplace_back(rest);
    } else if (key == "usemtl") {
      current = &faces[std::string(rest)];
    } else if (key == "f") {
      ++summary.faces;
      if (current != nullptr) ++*current;
    }
  });
  for (const auto& [name, count] : faces) {
    if (count == 0) continue;
    ++summary.material_count;
    if (count > summary.main_faces) {
      summary.main_faces = count;
      summary.main_material = name;
    }
  }
  return summary;
}

// `map_Kd -o 1 1 1 file.png`: the file is what is behind the last option.
std::string_view file_of_map(std::string_view rest) {
  if (!rest.starts_with('-')) return rest;
  const std::size_t blank = rest.find_last_of(" \t");
  return blank == std::string_view::npos ? rest : rest.substr(blank + 1);
}

void take_color(std::string_view rest, std::array<double, 3>& color) {
  const std::vector<double> numbers = numbers_in(rest);
  if (numbers.size() == 1) color = {numbers[0], numbers[0], numbers[0]};
  if (numbers.size() >= 3) color = {numbers[0], numbers[1], numbers[2]};
}

}  // namespace

std::string find_asset(Context& context, std::string_view name, Span where) {
  const std::string scene_directory = directory_of(context.options.scene_path);
  const std::string parent = joined_path(scene_directory.empty() ? "." : scene_directory, "..");
  const std::string places[] = {normalized_path(name), joined_path(scene_directory, name),
                                joined_path(parent, name)};
  for (const std::string& place : places) {
    if (context.files.is_file(place)) return place;
  }
  Diagnostic diagnostic(DiagnosticKind::course_missing_file, where,
                        fmt::format("there is no file `{}`", printable(name)));
  std::string tried;
  std::string refused;
  for (std::size_t i = 0; i < std::size(places); ++i) {
    if (i > 0 && (places[i] == places[i - 1] || places[i] == places[0])) continue;
    const auto content = context.files.read(places[i], 0);
    const bool outside = !content && content.error() == FileError::outside_root;
    std::string& list = outside ? refused : tried;
    list += fmt::format("{}`{}`", list.empty() ? "" : ", ", printable(places[i]));
  }
  if (!tried.empty()) diagnostic.notes.push_back({"tried " + tried, {}});
  if (!refused.empty()) {
    diagnostic.notes.push_back(
        {fmt::format("not tried: {} {}", refused, context.files.reason_of(FileError::outside_root)),
         {}});
  }
  context.sink.report(std::move(diagnostic));
  return places[0];
}

Text path_text(const Context& context, const std::string& path, Span origin) {
  const std::string directory = normalized_path(context.options.output_directory);
  const bool lexical =
      path.starts_with('/') == directory.starts_with('/') && !directory.starts_with("..");
  const std::string written = lexical
                                  ? relative_path(path, directory)
                                  : relative_path(absolute_path(path), absolute_path(directory));
  return {quoted_string(written), origin};
}

std::optional<ObjMaterial> read_obj_material(Context& context, const std::string& obj_path,
                                             Span where) {
  const auto obj = context.files.read(obj_path, size_limit);
  if (!obj) return std::nullopt;  // the mesh itself is reported where it is read
  const ObjSummary summary = summary_of(obj.value().bytes);
  if (summary.main_material.empty()) return std::nullopt;
  if (summary.material_count > 1) {
    context.error(
        DiagnosticKind::course_single_material, where,
        fmt::format(
            "the mesh has {} materials; all of it is drawn with `{}`, which {} of its {} faces use",
            summary.material_count, printable(summary.main_material), summary.main_faces,
            summary.faces));
  }
  for (const std::string& library : summary.libraries) {
    const std::string path = joined_path(directory_of(obj_path), library);
    const auto mtl = context.files.read(path, size_limit);
    if (!mtl) continue;
    ObjMaterial material;
    bool inside = false;
    bool found = false;
    std::string map;
    for_each_line(mtl.value().bytes, [&](std::string_view key, std::string_view rest) {
      if (key == "newmtl") {
        inside = rest == summary.main_material;
        found = found || inside;
      }
      if (!inside) return;
      if (key == "Kd") take_color(rest, material.diffuse);
      if (key == "Ks") take_color(rest, material.specular);
      if (key == "Ns" && !numbers_in(rest).empty()) material.shininess = numbers_in(rest).front();
      if (key == "map_Kd") map = file_of_map(rest);
    });
    if (!found) continue;
    if (!map.empty()) {
      const std::string texture = joined_path(directory_of(obj_path), map);
      if (context.files.is_file(texture)) {
        material.texture = texture;
      } else {
        context.error(
            DiagnosticKind::course_missing_file, where,
            fmt::format("there is no file `{}`, a texture of this mesh", printable(texture)));
      }
    }
    return material;
  }
  return std::nullopt;
}

}  // namespace scenec::frontend::course
