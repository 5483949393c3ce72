// Triangles and meshes: watertight, tiny, grazing, degenerate (G11-G14), and what meshes add.
#include "backend/geometry/triangle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "backend/geometry/mesh.hpp"
#include "tests/unit/backend/geometry/random_rays.hpp"
#include "tests/unit/backend/geometry/test_meshes.hpp"

namespace scenec::backend {
namespace {

using testing_support::Draw;

bool brute_force(const TriangleMesh& mesh, const Ray& ray) {
  const RayShear shear(ray);
  ShapeHit hit;
  for (const Face& f : mesh.faces)
    if (intersect_triangle(shear, mesh.positions[f[0]], mesh.positions[f[1]], mesh.positions[f[2]],
                           ray.t_min, ray.t_max, hit))
      return true;
  return false;
}

TEST(Triangle, ClosedMeshesDoNotLeak) {
  for (const double offset : {0.0, 1e3, 1e6}) {
    const TriangleMesh mesh = testing_support::displaced_sphere(24, offset);
    Draw draw(1);
    for (int i = 0; i < 3000; ++i) {
      const Face& f = mesh.faces[static_cast<std::size_t>(draw.unit() *
                                                          static_cast<double>(mesh.faces.size()))];
      const double b = i % 3 == 0 ? draw.unit() : i % 3 == 1 ? 0.0 : 0.5 * draw.unit();
      const double c = i % 3 == 2 ? draw.unit() * 0.5 : 0.0;  // along an edge, at a vertex, inside
      const Point3 target = mesh.positions[f[0]] +
                            b * (mesh.positions[f[1]] - mesh.positions[f[0]]) +
                            c * (mesh.positions[f[2]] - mesh.positions[f[0]]);
      const Point3 origin = Point3{offset, offset, offset} + as_vector(draw.point(0.3));
      ASSERT_TRUE(brute_force(mesh, Ray{origin, target - origin})) << i << " " << offset;
    }
  }
}

TEST(Triangle, TinyTrianglesAreHit) {
  Draw draw(2);
  for (int k = 0; k <= 18; ++k) {
    const double leg = std::pow(10.0, -k);
    const Triangle t{{0, 0, 0}, {leg, 0, 0}, {0, leg, 0}};
    for (int i = 0; i < 1000; ++i) {
      const double u = draw.between(0.01, 0.98);
      const double v = draw.between(0.01, 0.99 - u);
      const Point3 target{u * leg, v * leg, 0};
      const Point3 origin = target + leg * draw.between(0.5, 2) *
                                         Vector3{draw.between(-1, 1), draw.between(-1, 1), 1};
      ShapeHit hit;
      ASSERT_TRUE(intersect(t, Ray{origin, target - origin}, hit)) << k;
      EXPECT_NEAR(hit.a + hit.b, u + v, 1e-12);
    }
  }
}

TEST(Triangle, GrazingAHugeOne) {
  Draw draw(3);
  const Triangle t{{-1e7, 0, -1e7}, {1e7, 0, -1e7}, {0, 0, 1e7}};
  for (int i = 0; i < 10000; ++i) {
    const Point3 origin{draw.between(-1e3, 1e3), draw.between(1e-3, 1), draw.between(-1e3, 1e3)};
    const Vector3 d{1, -1e-6, draw.between(-0.1, 0.1)};
    ShapeHit hit;
    ASSERT_TRUE(intersect(t, Ray{origin, d}, hit));
    EXPECT_NEAR(hit.t / (origin.y / 1e-6), 1, 1e-9);
  }
}

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
