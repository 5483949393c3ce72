#include "backend/geometry/mesh.hpp"

#include <cmath>
#include <cstddef>

namespace scenec::backend {
namespace {

// The three attributes of a face, or false when the face names none (an index out of range).
template <class T>
bool attributes_of(const std::vector<T>& values, const std::vector<Face>& own_faces,
                   const TriangleMesh& mesh, std::uint32_t face, std::array<T, 3>& out) {
  if (values.empty()) return false;
  const Face& f = own_faces.empty() ? mesh.faces[face] : own_faces[face];
  for (std::size_t i = 0; i < 3; ++i) {
    if (f[i] >= values.size()) return false;
    out[i] = values[f[i]];
  }
  return true;
}

// Tangents along which u and v grow; false when the texture triangle has no area.
bool texture_tangents(const std::array<Sample2, 3>& uv, Surface& s) {
  const double du1 = uv[1].u - uv[0].u;
  const double dv1 = uv[1].v - uv[0].v;
  const double du2 = uv[2].u - uv[0].u;
  const double dv2 = uv[2].v - uv[0].v;
  const double determinant = du1 * dv2 - dv1 * du2;
  if (!(determinant != 0) || !std::isfinite(1 / determinant)) return false;
  const Vector3 e1 = s.dp_du;
  const Vector3 e2 = s.dp_dv;
  s.dp_du = (e1 * dv2 - e2 * dv1) / determinant;
  s.dp_dv = (e2 * du1 - e1 * du2) / determinant;
  return true;
}

}  // namespace

std::uint64_t memory_of(const TriangleMesh& mesh) {
  const auto bytes = [](const auto& list) { return std::uint64_t{sizeof(list[0])} * list.size(); };
  return bytes(mesh.positions) + bytes(mesh.faces) + bytes(mesh.normals) +
         bytes(mesh.normal_faces) + bytes(mesh.uvs) + bytes(mesh.uv_faces);
}

Triangle triangle_of(const TriangleMesh& mesh, std::uint32_t face) {
  const Face& f = mesh.faces[face];
  return {mesh.positions[f[0]], mesh.positions[f[1]], mesh.positions[f[2]]};
}

Bounds3 bounds(const TriangleMesh& mesh) {
  Bounds3 b;
  for (std::uint32_t i = 0; i < mesh.faces.size(); ++i) b.grow(bounds(triangle_of(mesh, i)));
  return b;
}

Surface surface(const TriangleMesh& mesh, const ShapeHit& hit) {
  Surface s = surface(triangle_of(mesh, hit.part), Ray{}, hit);
  const double b1 = hit.a;
  const double b2 = hit.b;
  const double b0 = 1 - b1 - b2;
  std::array<Normal3, 3> n{};
  if (attributes_of(mesh.normals, mesh.normal_faces, mesh, hit.part, n)) {
    const Vector3 sum = b0 * as_vector(n[0]) + b1 * as_vector(n[1]) + b2 * as_vector(n[2]);
    if (is_finite(sum) && !(sum == Vector3{0, 0, 0})) s.shading_normal = as_normal(sum);
  }
  std::array<Sample2, 3> uv{};
  if (attributes_of(mesh.uvs, mesh.uv_faces, mesh, hit.part, uv)) {
    s.u = b0 * uv[0].u + b1 * uv[1].u + b2 * uv[2].u;
    s.v = b0 * uv[0].v + b1 * uv[1].v + b2 * uv[2].v;
    texture_tangents(uv, s);
  }
  return s;
}

}  // namespace scenec::backend
