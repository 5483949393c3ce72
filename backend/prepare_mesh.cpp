// From what a mesh file or an inline mesh says to the triangles of the renderer.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <unordered_map>

#include "backend/prepare.hpp"
#include "base/assert.hpp"
#include "base/elementary.hpp"
#include "base/hash.hpp"
#include "base/text.hpp"

namespace scenec::backend {
namespace {

std::string place_of(const std::string& path, std::uint64_t line) {
  return line == 0 ? path : path + ":" + std::to_string(line);
}

std::string count_of(std::uint64_t count, const char* one, const char* many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

constexpr std::size_t shown_dropped_faces = 3;

// "a.obj:918: a face without area is left out: a vertex is repeated" for one; for more, their count
// and the places of the first ones.
void report_dropped(const MeshData& data, const std::string& path, Span where, MeshReport& report) {
  if (data.dropped_face_count == 0 || data.dropped_faces.empty()) return;
  const auto place = [&](const DroppedFace& face) {
    return face.line != 0 ? place_of(path, face.line)
                          : path + ", face " + std::to_string(face.face + 1);
  };
  const auto reason = [](const DroppedFace& face) {
    return face.reason == DropReason::repeated_vertex ? "a vertex is repeated"
                                                      : "its corners lie on one line";
  };
  const DroppedFace& first = data.dropped_faces.front();
  const std::string message = data.dropped_face_count == 1
                                  ? std::string("a face without area is left out: ")
                                  : std::to_string(data.dropped_face_count) +
                                        " faces without area are left out; of the first, ";
  Diagnostic diagnostic(DiagnosticKind::degenerate_faces, where,
                        place(first) + ": " + message + reason(first));
  const std::size_t shown = std::min(data.dropped_faces.size(), shown_dropped_faces);
  for (std::size_t i = 1; i < shown; ++i) {
    const DroppedFace& face = data.dropped_faces[i];
    diagnostic.notes.push_back({place(face) + ": " + reason(face), {}});
  }
  if (data.dropped_face_count > shown && shown > 1)
    diagnostic.notes.push_back(
        {"and " + std::to_string(data.dropped_face_count - shown) + " more", {}});
  report.warnings.push_back(std::move(diagnostic));
}

struct PositionKey {
  std::uint64_t x, y, z;
  friend bool operator==(const PositionKey&, const PositionKey&) = default;
};
struct PositionKeyHash {
  std::size_t operator()(const PositionKey& k) const {
    std::uint64_t h = k.x * 0x9e3779b97f4a7c15ULL;
    h = (h ^ (h >> 29) ^ k.y) * 0xbf58476d1ce4e5b9ULL;
    h = (h ^ (h >> 32) ^ k.z) * 0x94d049bb133111ebULL;
    return static_cast<std::size_t>(h ^ (h >> 31));
  }
};
PositionKey key_of(const Point3& p) {
  // Adding 0 makes -0 and 0 one place.
  return {std::bit_cast<std::uint64_t>(p.x + 0.0), std::bit_cast<std::uint64_t>(p.y + 0.0),
          std::bit_cast<std::uint64_t>(p.z + 0.0)};
}

double angle_between(const Vector3& a, const Vector3& b) {
  return atan2(length(cross(a, b)), dot(a, b));
}

std::vector<Normal3> normals_of_data(const MeshData& data) {
  std::vector<Normal3> normals;
  normals.reserve(data.normals.size());
  for (const auto& n : data.normals) {
    normals.push_back(
        {static_cast<double>(n[0]), static_cast<double>(n[1]), static_cast<double>(n[2])});
  }
  return normals;
}

bool every_corner_has_normal(const MeshData& data) {
  if (data.normals.empty()) return false;
  for (const TriangleIndices& t : data.normal_triangles) {
    if (t[0] == no_index) return false;
  }
  return true;
}

void take_normals_of_file(const MeshData& data, TriangleMesh& mesh) {
  mesh.normals = normals_of_data(data);
  mesh.normal_faces = data.normal_triangles;
  // A face that names none keeps its own flat normal.
  for (std::size_t i = 0; i < mesh.normal_faces.size(); ++i) {
    if (mesh.normal_faces[i][0] != no_index) continue;
    const auto index = static_cast<std::uint32_t>(mesh.normals.size());
    const Triangle t = triangle_of(mesh, static_cast<std::uint32_t>(i));
    mesh.normals.push_back(as_normal(normalized(cross(t.b - t.a, t.c - t.a)).vector()));
    mesh.normal_faces[i] = {index, index, index};
  }
}

void take_uvs_of_file(const MeshData& data, TriangleMesh& mesh) {
  mesh.uvs.reserve(data.uvs.size() + 1);
  for (const auto& uv : data.uvs)
    mesh.uvs.push_back({static_cast<double>(uv[0]), static_cast<double>(uv[1])});
  mesh.uv_faces = data.uv_triangles;
  std::uint32_t origin = no_index;
  for (Face& face : mesh.uv_faces) {
    if (face[0] != no_index) continue;
    if (origin == no_index) {
      origin = static_cast<std::uint32_t>(mesh.uvs.size());
      mesh.uvs.push_back({});
    }
    face = {origin, origin, origin};
  }
}

void choose_normals(const ir::Mesh& source, const MeshData& data, const std::string& path,
                    Span where, TriangleMesh& mesh, MeshReport& report) {
  switch (source.normals.mode) {
    case ir::NormalMode::flat:
      return;
    case ir::NormalMode::smooth:
      mesh.normals = smooth_normals_of(mesh.positions, mesh.faces);
      return;
    case ir::NormalMode::automatic:
      if (!data.normals.empty()) take_normals_of_file(data, mesh);
      return;
    case ir::NormalMode::file:
      if (!every_corner_has_normal(data) && !mesh.faces.empty()) {
        report.error = Diagnostic(DiagnosticKind::mesh_lacks_normals, where,
                                  "`normals = .file`, but " + path +
                                      (data.normals.empty() ? " has no normals"
                                                            : " has faces without normals"))
                           .hint("`.smooth` computes them from the faces, `.flat` uses none");
        return;
      }
      take_normals_of_file(data, mesh);
  }
}

bool has_area(const Point3& a, const Point3& b, const Point3& c) {
  const Vector3 u = b - a;
  const Vector3 v = c - a;
  return length_squared(cross(u * safe_scale(u), v * safe_scale(v))) > 0;
}

}  // namespace

Diagnostic without_faces(const std::string& name, Span where) {
  return {DiagnosticKind::mesh_without_faces, where, name + " has no face to be seen"};
}

std::vector<Normal3> smooth_normals_of(const std::vector<Point3>& positions,
                                       const std::vector<Face>& faces) {
  std::vector<std::uint32_t> place(positions.size());
  std::unordered_map<PositionKey, std::uint32_t, PositionKeyHash> places;
  places.reserve(positions.size());
  for (std::uint32_t i = 0; i < positions.size(); ++i)
    place[i] = places.try_emplace(key_of(positions[i]), i).first->second;
  std::vector<Vector3> sums(positions.size());
  for (const Face& face : faces) {
    const Point3 p[3] = {positions[face[0]], positions[face[1]], positions[face[2]]};
    const UnitVector3 normal = normalized(cross(p[1] - p[0], p[2] - p[0]));
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Vector3 next = p[(corner + 1) % 3] - p[corner];
      const Vector3 last = p[(corner + 2) % 3] - p[corner];
      sums[place[face[corner]]] += normal.vector() * angle_between(next, last);
    }
  }
  std::vector<Normal3> normals(positions.size());
  for (std::size_t i = 0; i < normals.size(); ++i) normals[i] = as_normal(sums[place[i]]);
  return normals;
}

TriangleMesh mesh_of_file(const ir::Mesh& source, const MeshData& data, const std::string& path,
                          Span where, MeshReport& report) {
  return mesh_of_file(source, MeshData(data), path, where, report);
}

TriangleMesh mesh_of_file(const ir::Mesh& source, MeshData&& data, const std::string& path,
                          Span where, MeshReport& report) {
  TriangleMesh mesh;
  mesh.positions = std::move(data.positions);
  mesh.faces = std::move(data.triangles);
  const double unit = source.unit.value;
  if (unit != 1) {
    for (Point3& p : mesh.positions) p = {p.x * unit, p.y * unit, p.z * unit};
  }
  if (!data.uvs.empty()) take_uvs_of_file(data, mesh);
  choose_normals(source, data, path, where, mesh, report);
  return mesh;
}

void report_file(const MeshData& data, const std::string& path, Span where, MeshReport& report) {
  report_dropped(data, path, where, report);
  if (data.triangles.empty()) report.warnings.push_back(without_faces(path, where));
}

TriangleMesh mesh_of_lists(const ir::Mesh& source, Span where, MeshReport& report) {
  TriangleMesh mesh;
  // The IR's invariants: lists fit together, indices name vertices.
  const std::size_t count = source.vertices.size();
  SCENEC_ASSERT(source.uvs.empty() || source.uvs.size() == count);
  SCENEC_ASSERT(source.normals.list.empty() || source.normals.list.size() == count);
  const double unit = source.unit.value;
  for (const ir::Point3& p : source.vertices)
    mesh.positions.push_back({p.x * unit, p.y * unit, p.z * unit});
  std::uint64_t dropped = 0;
  std::size_t first_dropped = 0;
  for (std::size_t f = 0; f < source.faces.size(); ++f) {
    const ir::Face& face = source.faces[f];
    for (const std::uint32_t index : face) SCENEC_ASSERT(index < count);
    for (std::size_t i = 2; i < face.size(); ++i) {
      if (has_area(mesh.positions[face[0]], mesh.positions[face[i - 1]], mesh.positions[face[i]])) {
        mesh.faces.push_back({face[0], face[i - 1], face[i]});
      } else if (dropped++ == 0) {
        first_dropped = f;
      }
    }
  }
  if (dropped > 0) {
    report.warnings.push_back(
        Diagnostic(DiagnosticKind::degenerate_faces, where,
                   count_of(dropped, "triangle without area is", "triangles without area are") +
                       " left out, the first of face " + std::to_string(first_dropped)));
  }
  for (const ir::Vec2& uv : source.uvs) mesh.uvs.push_back({uv.x, uv.y});
  for (const ir::Direction& n : source.normals.list) mesh.normals.push_back({n.x, n.y, n.z});
  if (source.normals.mode == ir::NormalMode::smooth)
    mesh.normals = smooth_normals_of(mesh.positions, mesh.faces);
  if (mesh.faces.empty()) report.warnings.push_back(without_faces("the mesh", where));
  return mesh;
}

}  // namespace scenec::backend
