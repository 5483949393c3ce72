// The faces a mesh takes of its file.
#include <algorithm>
#include <string_view>

#include "backend/prepare.hpp"
#include "base/text.hpp"

namespace scenec::backend {
namespace {

constexpr std::size_t listed_names = 8;

// Keeps of `values` what `faces` use, in the order of first use, and renumbers the faces. `scratch`
// holds no_index at every entry before and after.
template <class T>
std::vector<T> compacted(const std::vector<T>& values, std::vector<Face>& faces,
                         std::vector<std::uint32_t>& scratch) {
  if (scratch.size() < values.size()) scratch.resize(values.size(), no_index);
  std::vector<std::uint32_t> used;
  for (Face& face : faces) {
    for (std::uint32_t& index : face) {
      std::uint32_t& number = scratch[index];
      if (number == no_index) {
        number = static_cast<std::uint32_t>(used.size());
        used.push_back(index);
      }
      index = number;
    }
  }
  std::vector<T> kept;
  kept.reserve(used.size());
  for (const std::uint32_t index : used) {
    kept.push_back(values[index]);
    scratch[index] = no_index;
  }
  return kept;
}

std::vector<Face> picked(const std::vector<Face>& faces, const std::vector<std::uint32_t>& which) {
  std::vector<Face> result;
  result.reserve(which.size());
  for (const std::uint32_t i : which) result.push_back(faces[i]);
  return result;
}

// The numbers of a name in a table of names without repeats: at most one, and that of no name.
std::vector<std::uint32_t> numbers_of(const std::vector<std::string>& names,
                                      const std::string& name) {
  std::vector<std::uint32_t> numbers;
  if (name.empty()) numbers.push_back(no_index);
  const auto found = std::ranges::find(names, name);
  if (found != names.end()) numbers.push_back(static_cast<std::uint32_t>(found - names.begin()));
  return numbers;
}

}  // namespace

std::optional<std::vector<std::uint32_t>> MeshPartTaker::find_faces(const std::string& part) const {
  std::uint32_t MeshPart::* member = &MeshPart::material;
  std::vector<std::uint32_t> numbers = numbers_of(data_.material_names, part);
  if (numbers.empty()) {
    member = &MeshPart::group;
    numbers = numbers_of(data_.group_names, part);
  }
  if (numbers.empty()) return std::nullopt;
  std::vector<std::uint32_t> faces;
  for (const MeshPart& run : data_.parts) {
    if (std::ranges::find(numbers, run.*member) == numbers.end()) continue;
    for (std::uint32_t i = 0; i < run.triangle_count; ++i) faces.push_back(run.first_triangle + i);
  }
  return faces;
}

void MeshPartTaker::report_unknown(const std::string& part, Span where, MeshReport& report) const {
  std::vector<std::string_view> names(data_.material_names.begin(), data_.material_names.end());
  names.insert(names.end(), data_.group_names.begin(), data_.group_names.end());
  std::erase(names, std::string_view{});
  Diagnostic diagnostic(DiagnosticKind::mesh_part_unknown, where,
                        path_ + " has no part `" + printable(part) + "`");
  if (const auto nearest = nearest_name(part, names))
    diagnostic.hints.push_back("did you mean `" + printable(*nearest) + "`?");
  if (names.empty()) {
    diagnostic.hints.emplace_back("the file names no material and no group: leave `part` out");
  } else {
    const std::size_t shown = std::min(names.size(), listed_names);
    std::string list;
    for (std::size_t i = 0; i < shown; ++i)
      list += (i == 0 ? "`" : ", `") + printable(names[i]) + "`";
    if (shown < names.size()) list += " and " + std::to_string(names.size() - shown) + " more";
    diagnostic.hints.push_back("parts: " + list);
  }
  report.error = std::move(diagnostic);
}

TriangleMesh MeshPartTaker::take(const TriangleMesh& whole, const std::string& part, Span where,
                                 MeshReport& report) {
  const auto which = find_faces(part);
  if (!which) {
    report_unknown(part, where, report);
    return {};
  }
  TriangleMesh mesh;
  mesh.faces = picked(whole.faces, *which);
  // Attributes that go with the positions one to one get faces of their own first.
  if (!whole.normals.empty()) {
    mesh.normal_faces =
        whole.normal_faces.empty() ? mesh.faces : picked(whole.normal_faces, *which);
    mesh.normals = compacted(whole.normals, mesh.normal_faces, renumbered_);
  }
  if (!whole.uvs.empty()) {
    mesh.uv_faces = whole.uv_faces.empty() ? mesh.faces : picked(whole.uv_faces, *which);
    mesh.uvs = compacted(whole.uvs, mesh.uv_faces, renumbered_);
  }
  mesh.positions = compacted(whole.positions, mesh.faces, renumbered_);
  if (mesh.normal_faces == mesh.faces) mesh.normal_faces.clear();
  if (mesh.uv_faces == mesh.faces) mesh.uv_faces.clear();
  return mesh;
}

}  // namespace scenec::backend
