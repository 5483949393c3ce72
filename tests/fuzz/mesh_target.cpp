// Mesh files: whatever the bytes are, a mesh that was read keeps the promises of MeshData.
#include <cmath>
#include <string>
#include <string_view>

#include "backend/assets/obj.hpp"
#include "backend/assets/ply.hpp"
#include "frontend/course/mtl.hpp"
#include "tests/fuzz/require.hpp"
#include "tests/fuzz/targets.hpp"

namespace scenec::fuzz {

namespace {

using backend::MeshData;
using backend::TriangleIndices;

backend::MeshLimits small_limits() {
  backend::MeshLimits limits;
  limits.triangles = 20'000;
  limits.ear_tests = 200'000;
  limits.polygon_vertices = 2'000;
  return limits;
}

void require_indices(const std::vector<TriangleIndices>& triangles, std::size_t count,
                     bool may_have_none) {
  for (const TriangleIndices& one : triangles) {
    const bool has_none = one[0] == backend::no_index;
    for (const std::uint32_t index : one) {
      require((index == backend::no_index) == has_none, "a face has all indices or none");
      require(has_none ? may_have_none : index < count, "an index is in range");
    }
  }
}

void require_attribute(const MeshData& mesh, std::size_t count,
                       const std::vector<TriangleIndices>& triangles) {
  if (count == 0) return;
  if (triangles.empty()) {
    require(count == mesh.positions.size(), "one value a position");
    return;
  }
  require(triangles.size() == mesh.triangles.size(), "indices for every triangle");
  require_indices(triangles, count, true);
}

void require_parts(const MeshData& mesh) {
  std::uint64_t next = 0;
  for (const backend::MeshPart& part : mesh.parts) {
    require(part.first_triangle == next, "parts follow each other");
    next += part.triangle_count;
    require(part.group == backend::no_index || part.group < mesh.group_names.size(),
            "a part's group");
    require(part.material == backend::no_index || part.material < mesh.material_names.size(),
            "a part's material");
  }
  require(next == mesh.triangles.size(), "parts cover the mesh");
}

template <class Vector>
bool is_finite(const Vector& vector) {
  for (const auto x : vector) {
    if (!std::isfinite(x)) return false;
  }
  return true;
}

void require_sound(const MeshData& mesh) {
  require_indices(mesh.triangles, mesh.positions.size(), false);
  for (const TriangleIndices& one : mesh.triangles) {
    require(one[0] != one[1] && one[1] != one[2] && one[2] != one[0], "three different corners");
  }
  require_attribute(mesh, mesh.normals.size(), mesh.normal_triangles);
  require_attribute(mesh, mesh.uvs.size(), mesh.uv_triangles);
  require_parts(mesh);
  for (const auto& position : mesh.positions) require(is_finite(position), "a finite position");
  for (const auto& normal : mesh.normals) require(is_finite(normal), "a finite normal");
  for (const auto& uv : mesh.uvs) require(is_finite(uv), "finite texture coordinates");
  require(mesh.dropped_faces.size() <= mesh.dropped_face_count, "dropped faces are counted");
}

void require_told(const AssetProblem& problem) {
  require(!problem.message.empty() && problem.message.size() < 1000, "a message", problem.message);
}

void require_sound(const Result<MeshData, AssetProblem>& mesh) {
  if (mesh) {
    require_sound(mesh.value());
  } else {
    require_told(mesh.error());
  }
}

}  // namespace

void fuzz_mesh(std::string_view bytes) {
  require_sound(backend::read_obj(bytes, small_limits()));
  const auto library = frontend::course::read_mtl(bytes, Limits{}.line_bytes);
  if (!library) return require_told(library.error());
  for (const frontend::course::MtlMaterial& material : library.value()) {
    for (const auto& color : {material.diffuse, material.specular, material.emission}) {
      require(!color || is_finite(*color), "a finite colour");
    }
    require(!material.shininess || std::isfinite(*material.shininess), "a finite number");
  }
}

void fuzz_ply(std::string_view bytes) {
  require_sound(backend::read_ply(bytes, small_limits()));
}

}  // namespace scenec::fuzz
