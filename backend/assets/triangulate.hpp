// Faces as a file lists them become triangles: convex polygons as fans, concave ones by ear
// clipping, faces without area left out and listed.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "backend/assets/mesh_data.hpp"
#include "base/asset_problem.hpp"

namespace scenec::backend {

// Consecutive faces with the same group and material.
struct FacePart {
  std::uint32_t first_face = 0;
  std::uint32_t group = no_index;
  std::uint32_t material = no_index;
};

// Corners of all faces one after the other, checked against the tables they index.
struct FaceList {
  // Faces before all others, when they are triangles that name positions only (of a PLY file).
  std::vector<TriangleIndices> triangles;
  std::vector<std::uint32_t> corner_positions;
  std::vector<std::uint32_t> corner_normals;  // empty, or as long as corner_positions
  std::vector<std::uint32_t> corner_uvs;      // likewise
  std::vector<std::uint32_t> sizes;           // corners of each face, at least 3
  std::vector<std::uint32_t> lines;           // of each face, `triangles` included, or empty
  std::vector<FacePart> parts;                // ascending; empty: one part with no names
};

// Numerics.
// Domain: finite positions. Method: polygon normal by Newell's sum; a fan is taken when each of its
// triangles turns the same way as that normal, else ears are clipped in the projection along the
// largest component of the normal (Meisters 1975). Error: signs are those of double arithmetic;
// polygons that are not simple get some triangulation of their corners. Degenerate: a triangle is
// left out when its cross product is zero after exact rescaling of its edges by a power of two (so
// tiny meshes do not vanish by underflow); collinear corners whose rounded cross product is not
// zero stay in. Proof: triangulate_test.
//
// Fills triangles, index tables, parts and dropped faces of `mesh` from `faces`; positions,
// normals, uvs and names are already there.
[[nodiscard]] std::optional<AssetProblem> triangulate(FaceList faces, const MeshLimits& limits,
                                                      MeshData& mesh);

}  // namespace scenec::backend
