// A triangle mesh as its file gives it: positions in double (they are rebased before they become
// float), indices in 32 bits, index tables for normals and texture coordinates only where the file
// has them. Every index is in range and every coordinate finite; no triangle has zero area.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "backend/math/vec.hpp"
#include "base/limits.hpp"

namespace scenec::backend {

using TriangleIndices = std::array<std::uint32_t, 3>;

// In `normal_triangles` and `uv_triangles`: the face names none. In a part: no group or material.
inline constexpr std::uint32_t no_index = 0xFFFF'FFFF;

// Consecutive triangles with the same group and material.
struct MeshPart {
  std::uint32_t first_triangle = 0;
  std::uint32_t triangle_count = 0;
  std::uint32_t group = no_index;     // into `group_names`
  std::uint32_t material = no_index;  // into `material_names`
};

enum class DropReason : std::uint8_t {
  repeated_vertex,  // fewer than three different vertices
  zero_area,        // its corners lie on one line
};

// A face of the file that covers no area and is therefore not in the mesh.
struct DroppedFace {
  std::uint32_t line = 0;  // 0 in a binary file
  std::uint32_t face = 0;  // 0-based, in file order
  DropReason reason = DropReason::zero_area;
};

struct MeshData {
  std::vector<Point3> positions;
  std::vector<std::array<float, 3>> normals;  // as written: not normalised, may be zero
  std::vector<std::array<float, 2>> uvs;

  std::vector<TriangleIndices> triangles;  // into `positions`
  // Into `normals` and `uvs`. Empty, with `normals` (`uvs`) not empty: they go with the positions
  // one to one. Otherwise as long as `triangles`; a triangle has three indices or `no_index`
  // thrice.
  std::vector<TriangleIndices> normal_triangles;
  std::vector<TriangleIndices> uv_triangles;

  std::vector<MeshPart> parts;  // cover all triangles, ascending
  std::vector<std::string> group_names;
  std::vector<std::string> material_names;

  std::uint64_t dropped_face_count = 0;
  std::vector<DroppedFace> dropped_faces;  // the first of them
};

// What of the limits concerns one mesh, and what no option sets.
struct MeshLimits {
  MeshLimits() : MeshLimits(Limits{}) {}
  explicit MeshLimits(const Limits& limits)
      : file_bytes(limits.mesh_bytes),
        line_bytes(limits.line_bytes),
        polygon_vertices(static_cast<std::uint32_t>(limits.polygon_corners)),
        triangles(limits.mesh_triangles) {}

  std::uint64_t file_bytes;
  std::size_t line_bytes;
  std::uint32_t polygon_vertices;
  std::uint64_t triangles;
  // Point-in-triangle tests spent on concave polygons, over the whole file.
  std::uint64_t ear_tests = 200'000'000;
  std::size_t reported_dropped_faces = 1'024;
};

[[nodiscard]] inline TriangleIndices normal_indices_of(const MeshData& mesh, std::size_t triangle) {
  if (mesh.normals.empty()) return {no_index, no_index, no_index};
  return mesh.normal_triangles.empty() ? mesh.triangles[triangle] : mesh.normal_triangles[triangle];
}

[[nodiscard]] inline TriangleIndices uv_indices_of(const MeshData& mesh, std::size_t triangle) {
  if (mesh.uvs.empty()) return {no_index, no_index, no_index};
  return mesh.uv_triangles.empty() ? mesh.triangles[triangle] : mesh.uv_triangles[triangle];
}

}  // namespace scenec::backend
