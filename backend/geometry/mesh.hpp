// Triangles over shared vertices, with optional shading normals and texture coordinates. Faces and
// intersection are those of triangle.hpp; this adds what the attributes say at a hit.
//
// Domain:     indices within their arrays, finite positions; attributes may be anything finite.
// Method:     attributes by barycentric weights.
// Error:      as triangle.hpp.
// Degenerate: zero, opposite or non-finite interpolated normals give way to the geometric normal;
//             texture coordinates without area leave dp_du to the edges.
// Proof:      tests/numerics/derivative_cases.cpp (G29), tests/unit/backend/geometry/triangle_test.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "backend/geometry/kernel.hpp"
#include "backend/geometry/triangle.hpp"
#include "backend/math/sampling.hpp"

namespace scenec::backend {

using Face = std::array<std::uint32_t, 3>;

struct TriangleMesh {
  std::vector<Point3> positions;
  std::vector<Face> faces;
  std::vector<Normal3> normals;    // empty: flat
  std::vector<Face> normal_faces;  // empty: as `faces`
  std::vector<Sample2> uvs;        // empty: barycentric weights
  std::vector<Face> uv_faces;      // empty: as `faces`
};

[[nodiscard]] std::uint64_t memory_of(const TriangleMesh& mesh);  // bytes
[[nodiscard]] Triangle triangle_of(const TriangleMesh& mesh, std::uint32_t face);
[[nodiscard]] Bounds3 bounds(const TriangleMesh& mesh);
// `hit.part` is the face.
[[nodiscard]] Surface surface(const TriangleMesh& mesh, const ShapeHit& hit);

}  // namespace scenec::backend
