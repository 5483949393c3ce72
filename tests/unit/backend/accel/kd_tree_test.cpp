// The kd-tree that ours are compared with is itself right: the bits of brute force.
#include "tests/unit/backend/accel/kd_tree.hpp"

#include <gtest/gtest.h>

#include "tests/unit/backend/geometry/random_rays.hpp"

namespace scenec::test {
namespace {

using namespace backend;
using backend::testing_support::Draw;

TriangleMesh soup(Draw& draw, std::uint32_t count) {
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Point3 at = draw.point(1);
    for (int k = 0; k < 3; ++k) mesh.positions.push_back(at + 0.1 * as_vector(draw.point(1)));
    mesh.faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return mesh;
}

void expect_same(const TriangleMesh& mesh, const KdTree& tree, const Ray& ray) {
  ShapeHit a;
  ShapeHit b;
  const bool hit = tree.find(ray, a);
  ASSERT_EQ(hit, find_by_brute_force(mesh, ray, b));
  if (!hit) return;
  ASSERT_EQ(a.t, b.t);
  ASSERT_EQ(a.part, b.part);
}

TEST(KdTree, GivesTheBitsOfBruteForceInRandomSoup) {
  Draw draw(11);
  const TriangleMesh mesh = soup(draw, 2000);
  const KdTree tree(mesh);
  for (int i = 0; i < 5000; ++i)
    expect_same(mesh, tree, {draw.point(2), as_vector(draw.point(1)), 0, 100});
}

// Walls on the planes of a grid, rays along and across them: where such trees lose walls.
TEST(KdTree, LosesNoWallsThatLieInItsPlanes) {
  TriangleMesh mesh;
  for (int k = 0; k <= 16; ++k) {
    const double x = k / 16.0;
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {{x, 0, 0}, {x, 1, 0}, {x, 1, 1}, {x, 0, 1}});
    mesh.faces.push_back({first, first + 1, first + 2});
    mesh.faces.push_back({first, first + 2, first + 3});
  }
  const KdTree tree(mesh);
  Draw draw(12);
  for (int k = 0; k <= 32; ++k) {
    for (int i = 0; i < 50; ++i) {
      const Point3 at{k / 32.0, draw.point(0.5).y + 0.5, draw.point(0.5).z + 0.5};
      for (const Vector3 d : {Vector3{1, 0, 0}, Vector3{-1, 0, 0}, Vector3{0, 1, 0}})
        expect_same(mesh, tree, {at, d, 0, 100});
    }
  }
}

}  // namespace
}  // namespace scenec::test
