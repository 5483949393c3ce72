#include "tests/numerics/meshes.hpp"

#include <array>
#include <vector>

namespace scenec::numerics {

using namespace backend;

namespace {

std::vector<Vector3> icosahedron() {
  const double g = (1 + std::sqrt(5.0)) / 2;
  return {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
          {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
}

constexpr std::array<Face, 20> icosahedron_faces{
    {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
     {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
     {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};

}  // namespace

TriangleMesh icosphere(int level, double offset) {
  std::vector<Vector3> points = icosahedron();
  std::vector<Face> faces(icosahedron_faces.begin(), icosahedron_faces.end());
  for (Vector3& p : points) p = normalized(p);
  for (int i = 0; i < level; ++i) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [slot, added] = middles.try_emplace({a < b ? a : b, a < b ? b : a},
                                                     static_cast<std::uint32_t>(points.size()));
      if (added) points.push_back(normalized(points[a] + points[b]));
      return slot->second;
    };
    std::vector<Face> finer;
    finer.reserve(4 * faces.size());
    for (const Face& f : faces) {
      const std::uint32_t a = middle(f[0], f[1]);
      const std::uint32_t b = middle(f[1], f[2]);
      const std::uint32_t c = middle(f[2], f[0]);
      for (const Face& part : {Face{f[0], a, c}, Face{f[1], b, a}, Face{f[2], c, b}, Face{a, b, c}})
        finer.push_back(part);
    }
    faces = std::move(finer);
  }
  TriangleMesh mesh;
  mesh.faces = std::move(faces);
  for (const Vector3& p : points) {
    const double bump = 1 + 0.03 * sin(7 * p.x) * sin(5 * p.y + 1) * sin(6 * p.z + 2);
    mesh.positions.push_back({offset + bump * p.x, offset + bump * p.y, offset + bump * p.z});
  }
  return mesh;
}

Ray LeakRays::next() {
  ++count_;
  const Point3 origin = Point3{offset_, offset_, offset_} + as_vector(draw_.point(0.3));
  const auto kind = count_ % 10;
  if (kind >= 2) return {origin, draw_.direction()};
  const auto face =
      static_cast<std::size_t>(draw_.unit() * static_cast<double>(mesh_.faces.size()));
  const Face& f = mesh_.faces[face];
  const Point3& a = mesh_.positions[f[0]];
  const Point3 target = kind == 0 ? a : a + draw_.unit() * (mesh_.positions[f[1]] - a);
  return {origin, target - origin};
}

}  // namespace scenec::numerics
