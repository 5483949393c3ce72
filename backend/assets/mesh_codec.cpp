#include "backend/assets/mesh_codec.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/packed_bytes.hpp"

namespace scenec::backend {
namespace {

constexpr std::uint64_t codec_version = 1;
constexpr std::uint64_t most_names = 1'000'000;

void append_names(std::string& out, const std::vector<std::string>& names) {
  append_packed(out, std::uint64_t{names.size()});
  for (const std::string& name : names) {
    append_packed(out, std::uint64_t{name.size()});
    out += name;
  }
}

std::vector<std::string> names_in(PackedReader& reader) {
  std::vector<std::string> names;
  const auto count = reader.value<std::uint64_t>();
  if (count > most_names) reader.refuse();
  for (std::uint64_t i = 0; reader.ok() && i < count; ++i)
    names.emplace_back(reader.take(reader.value<std::uint64_t>()));
  return names;
}

struct Counts {
  std::uint64_t positions = 0;
  std::uint64_t normals = 0;
  std::uint64_t uvs = 0;
  std::uint64_t triangles = 0;
  std::uint64_t normal_triangles = 0;
  std::uint64_t uv_triangles = 0;
  std::uint64_t parts = 0;
  std::uint64_t dropped = 0;
  std::uint64_t all_dropped = 0;
};

Counts counts_of(const MeshData& mesh) {
  return {mesh.positions.size(), mesh.normals.size(),          mesh.uvs.size(),
          mesh.triangles.size(), mesh.normal_triangles.size(), mesh.uv_triangles.size(),
          mesh.parts.size(),     mesh.dropped_faces.size(),    mesh.dropped_face_count};
}

// How a part and a dropped face are stored: without padding.
using StoredPart = std::array<std::uint32_t, 4>;
using StoredDrop = std::array<std::uint32_t, 3>;

bool all_finite(const std::vector<Point3>& points) {
  bool finite = true;
  for (const Point3& p : points)
    finite = finite && std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
  return finite;
}

template <class T>
bool all_finite(const std::vector<T>& values) {
  bool finite = true;
  for (const T& value : values) {
    for (const auto component : value) finite = finite && std::isfinite(component);
  }
  return finite;
}

// `absent`: whether a triangle may have no_index thrice instead.
bool indices_fit(const std::vector<TriangleIndices>& triangles, std::uint64_t count, bool absent) {
  bool fit = true;
  for (const TriangleIndices& t : triangles) {
    const bool none = absent && t[0] == no_index && t[1] == no_index && t[2] == no_index;
    fit = fit && (none || (t[0] < count && t[1] < count && t[2] < count));
  }
  return fit;
}

bool attribute_fits(const std::vector<TriangleIndices>& own, std::uint64_t values,
                    const MeshData& mesh) {
  if (own.empty()) return values == 0 || values == mesh.positions.size();
  return own.size() == mesh.triangles.size() && indices_fit(own, values, true);
}

bool parts_fit(const MeshData& mesh) {
  std::uint64_t next = 0;
  for (const MeshPart& part : mesh.parts) {
    const bool group = part.group == no_index || part.group < mesh.group_names.size();
    const bool material = part.material == no_index || part.material < mesh.material_names.size();
    if (part.first_triangle != next || !group || !material) return false;
    next += part.triangle_count;
  }
  return next == mesh.triangles.size();
}

bool is_sound(const MeshData& mesh) {
  return all_finite(mesh.positions) && all_finite(mesh.normals) && all_finite(mesh.uvs) &&
         indices_fit(mesh.triangles, mesh.positions.size(), false) &&
         attribute_fits(mesh.normal_triangles, mesh.normals.size(), mesh) &&
         attribute_fits(mesh.uv_triangles, mesh.uvs.size(), mesh) && parts_fit(mesh) &&
         mesh.dropped_faces.size() <= mesh.dropped_face_count;
}

}  // namespace

Hash128 mesh_key(const Hash128& content, std::string_view extension, const MeshLimits& limits) {
  Hasher hasher;
  hasher.add(std::string_view("scenec-mesh"));
  hasher.add(codec_version);
  hasher.add(content);
  hasher.add(extension);
  hasher.add(limits.line_bytes);
  hasher.add(limits.polygon_vertices);
  hasher.add(limits.triangles);
  hasher.add(limits.ear_tests);
  hasher.add(limits.reported_dropped_faces);
  return hasher.result();
}

EncodedMesh::EncodedMesh(const MeshData& mesh) {
  append_packed(head_, counts_of(mesh));
  for (const MeshPart& part : mesh.parts)
    append_packed(head_,
                  StoredPart{part.first_triangle, part.triangle_count, part.group, part.material});
  for (const DroppedFace& face : mesh.dropped_faces)
    append_packed(head_, StoredDrop{face.line, face.face, static_cast<std::uint32_t>(face.reason)});
  append_names(head_, mesh.group_names);
  append_names(head_, mesh.material_names);
  pieces_ = {head_,
             packed_bytes_of(mesh.positions),
             packed_bytes_of(mesh.normals),
             packed_bytes_of(mesh.uvs),
             packed_bytes_of(mesh.triangles),
             packed_bytes_of(mesh.normal_triangles),
             packed_bytes_of(mesh.uv_triangles)};
}

std::optional<MeshData> decode_mesh(std::string_view bytes) {
  PackedReader reader(bytes);
  const auto counts = reader.value<Counts>();
  MeshData mesh;
  for (const StoredPart& part : reader.list<std::vector<StoredPart>>(counts.parts))
    mesh.parts.push_back({part[0], part[1], part[2], part[3]});
  for (const StoredDrop& drop : reader.list<std::vector<StoredDrop>>(counts.dropped)) {
    if (drop[2] > static_cast<std::uint32_t>(DropReason::zero_area)) reader.refuse();
    mesh.dropped_faces.push_back({drop[0], drop[1], static_cast<DropReason>(drop[2])});
  }
  mesh.dropped_face_count = counts.all_dropped;
  mesh.group_names = names_in(reader);
  mesh.material_names = names_in(reader);
  mesh.positions = reader.list<std::vector<Point3>>(counts.positions);
  mesh.normals = reader.list<std::vector<std::array<float, 3>>>(counts.normals);
  mesh.uvs = reader.list<std::vector<std::array<float, 2>>>(counts.uvs);
  mesh.triangles = reader.list<std::vector<TriangleIndices>>(counts.triangles);
  mesh.normal_triangles = reader.list<std::vector<TriangleIndices>>(counts.normal_triangles);
  mesh.uv_triangles = reader.list<std::vector<TriangleIndices>>(counts.uv_triangles);
  if (!reader.at_end() || !is_sound(mesh)) return std::nullopt;
  return mesh;
}

}  // namespace scenec::backend
