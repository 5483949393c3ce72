// Degenerate triangles, and what meshes add; hits are the matter of tests/numerics (G11 - G18).
#include "backend/geometry/triangle.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "backend/geometry/mesh.hpp"

namespace scenec::backend {
namespace {

TEST(Triangle, DegenerateOnesMiss) {
  ShapeHit hit;
  const Ray ray{{0.2, 0.2, -1}, {0, 0, 1}};
  EXPECT_FALSE(intersect(Triangle{{0, 0, 0}, {1, 1, 0}, {2, 2, 0}}, ray, hit));
  EXPECT_FALSE(intersect(Triangle{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, ray, hit));
  EXPECT_FALSE(intersect(Triangle{{0, 0, 0}, {1, 0, 0}, {0, std::nan(""), 0}}, ray, hit));
  EXPECT_FALSE(
      intersect(Triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, Ray{{-1, 0.2, 0}, {1, 0, 0}}, hit));
  EXPECT_TRUE(
      intersect(Triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, Ray{{0, 0, -1}, {0, 0, 1}}, hit));
}

TEST(Mesh, AttributesAndTheirAbsence) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  mesh.faces = {{0, 1, 2}, {1, 3, 2}};
  mesh.normals = {{0, 0, 1}, {1, 0, 0}, {-1, 0, 0}};
  mesh.normal_faces = {{0, 0, 1}, {1, 2, 0xFFFFFFFF}};
  mesh.uvs = {{0, 0}, {2, 0}, {0, 2}, {2, 2}};
  const Surface s = surface(mesh, {1, 0, 0.25, 0.5});
  EXPECT_EQ(s.point, (Point3{0.25, 0.5, 0}));
  EXPECT_EQ(s.u, 0.5);
  EXPECT_EQ(s.v, 1.0);
  EXPECT_EQ(s.dp_du, (Vector3{0.5, 0, 0}));
  EXPECT_EQ(s.shading_normal, (Normal3{0.5, 0, 0.5}));
  EXPECT_EQ(s.geometric_normal, (Normal3{0, 0, 1}));
  // The second face names no normal for one corner: flat.
  EXPECT_EQ(surface(mesh, {1, 1, 0.25, 0.5}).shading_normal, (Normal3{0, 0, 1}));
  mesh.normal_faces = {{1, 2, 1}, {0, 0, 0}};
  EXPECT_EQ(surface(mesh, {1, 0, 0.5, 0}).shading_normal,
            (Normal3{0, 0, 1}));  // opposite ones cancel
}

}  // namespace
}  // namespace scenec::backend
