// Trees over triangles: the bits of triangle.hpp on every target, by tree and by brute force; no
// leaks far away or at any scale; vertices in float where that is faithful (G14, G19-G22, G25).
#include "backend/accel/mesh_accel.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "backend/accel/box_ray.hpp"
#include "backend/accel/scene_accel.hpp"
#include "tests/unit/backend/geometry/random_rays.hpp"
#include "tests/unit/backend/geometry/test_meshes.hpp"

namespace scenec::backend {
namespace {

using testing_support::Draw;

ThreadPool& pool() {
  static ThreadPool two(2);
  return two;
}

// Triangles of sizes from 10^-spread to 10^spread times `size` about the origin.
TriangleMesh soup(Draw& draw, std::uint32_t count, double spread) {
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Point3 at = draw.point(1);
    const double size = draw.power_of_ten(-spread, spread) * 0.3;
    for (int k = 0; k < 3; ++k) mesh.positions.push_back(at + size * as_vector(draw.point(1)));
    mesh.faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return mesh;
}

SceneAccel world_of(const std::shared_ptr<const MeshAccel>& mesh, Target target) {
  SceneAccel accel;
  accel.add_mesh(0, mesh);
  accel.build(pool(), target);
  return accel;
}

// The nearest hit by triangle.hpp over the faces as they are traced, in tree space.
bool nearest(const MeshAccel& accel, const Ray& ray, ShapeHit& best) {
  const LocalRay local = make_local(accel.tree().tree.space, ray);
  const Ray in_tree{{local.origin[0], local.origin[1], local.origin[2]},
                    {local.direction[0], local.direction[1], local.direction[2]},
                    local.t_min,
                    local.t_max};
  const RayShear shear(in_tree);
  const TreeSpace& space = accel.tree().tree.space;
  bool found = false;
  double limit = local.t_max;
  for (std::uint32_t f = 0; f < accel.mesh().faces.size(); ++f) {
    const Triangle t = triangle_of(accel.mesh(), f);
    ShapeHit hit;
    if (!intersect_triangle(shear, space.to_local(t.a), space.to_local(t.b), space.to_local(t.c),
                            local.t_min, limit, hit))
      continue;
    if (found && hit.t == limit) continue;  // the smaller face has it
    found = true;
    limit = hit.t;
    best = hit;
    best.part = f;
  }
  best.t = local.times.to_world(best.t);
  return found;
}

Ray random_ray(Draw& draw) {
  const double u = draw.unit();
  if (u < 0.6) return {draw.point(1.5), draw.direction()};
  if (u < 0.8) return {draw.point(1e5), as_vector(draw.point(1)), 0, 3};
  const Point3 from = draw.point(1e4);
  return {from, (draw.point(1) - from) * draw.power_of_ten(-20, 20)};
}

TEST(MeshAccel, EveryTargetHasTheBitsOfTheScalarFormula) {
  for (const Precision precision : {Precision::mixed, Precision::full}) {
    Draw draw(1);
    const auto mesh = std::make_shared<const MeshAccel>(soup(draw, 500, 1), pool(), precision);
    EXPECT_EQ(mesh->tree().full(), precision == Precision::full);
    for (const Target target : available_targets()) {
      const SceneAccel accel = world_of(mesh, target);
      Draw rays(2);
      int hits = 0;
      for (int i = 0; i < 4000; ++i) {
        const Ray ray = random_ray(rays);
        ShapeHit expected;
        Hit tree;
        Hit brute;
        const bool hit = nearest(*mesh, ray, expected);
        ASSERT_EQ(hit, accel.intersect(ray, tree)) << i << " " << name_of(target);
        ASSERT_EQ(hit, accel.intersect_brute_force(ray, brute));
        ASSERT_EQ(hit, accel.occluded(ray));
        if (!hit) continue;
        ++hits;
        EXPECT_EQ(tree.t, expected.t);
        EXPECT_EQ(tree.primitive, expected.part);
        EXPECT_EQ(tree.b1, expected.a);
        EXPECT_EQ(tree.b2, expected.b);
        EXPECT_EQ(brute.t, expected.t);
        EXPECT_EQ(brute.primitive, expected.part);
      }
      EXPECT_GT(hits, 1000);
    }
  }
}

// Long thin triangles across each other: the builder cuts them.
TriangleMesh needles(Draw& draw, std::uint32_t count) {
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Point3 at = draw.point(1);
    mesh.positions.push_back(at);
    mesh.positions.push_back(at + 0.7 * draw.direction().vector());
    mesh.positions.push_back(at + 0.01 * draw.direction().vector());
    mesh.faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return mesh;
}

TEST(MeshAccel, CutTrianglesAreNeitherLostNorFoundTwice) {
  Draw draw(12);
  const auto built = std::make_shared<const MeshAccel>(needles(draw, 3000), pool());
  std::size_t references = 0;
  for (const auto& block : built->tree().blocks)
    for (const std::uint32_t face : block.face) references += face != TriangleBlock<float>::no_face;
  EXPECT_GT(references, 3000U);
  const SceneAccel accel = world_of(built, best_target());
  for (int i = 0; i < 6000; ++i) {
    const Ray ray = random_ray(draw);
    Hit tree;
    Hit brute;
    ASSERT_EQ(accel.intersect(ray, tree), accel.intersect_brute_force(ray, brute)) << i;
    ASSERT_EQ(tree.t, brute.t);
    ASSERT_EQ(tree.primitive, brute.primitive);
  }
  ThreadPool seven(7);
  const MeshAccel again(built->shared_mesh(), seven);
  ASSERT_EQ(again.tree().tree.nodes.size(), built->tree().tree.nodes.size());
  EXPECT_EQ(std::memcmp(again.tree().tree.nodes.data(), built->tree().tree.nodes.data(),
                        again.tree().tree.nodes.size() * sizeof(WideNode)),
            0);
}

// G21. A million rays where SCENEC_SLOW_TESTS is set.
TEST(MeshAccel, SoupOfAllScalesAgreesWithBruteForce) {
  const int rays = std::getenv("SCENEC_SLOW_TESTS") != nullptr ? 10000 : 400;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Draw draw(100 + seed);
    const double scale = draw.power_of_ten(-6, 6);
    TriangleMesh mesh = soup(draw, 200, seed % 2 == 0 ? 0.5 : 3);
    for (Point3& p : mesh.positions) p = as_point(scale * as_vector(p));
    const auto built = std::make_shared<const MeshAccel>(std::move(mesh), pool());
    const auto targets = available_targets();
    const SceneAccel accel = world_of(built, targets[seed % targets.size()]);
    for (int i = 0; i < rays; ++i) {
      Ray ray = random_ray(draw);
      ray.origin = as_point(scale * as_vector(ray.origin));
      Hit tree;
      Hit brute;
      ASSERT_EQ(accel.intersect(ray, tree), accel.intersect_brute_force(ray, brute))
          << seed << " " << i;
      ASSERT_EQ(tree.t, brute.t) << seed << " " << i;
      ASSERT_EQ(tree.primitive, brute.primitive) << seed << " " << i;
    }
  }
}

TEST(MeshAccel, AwkwardDirectionsAgreeWithBruteForce) {
  Draw draw(3);
  const auto mesh =
      std::make_shared<const MeshAccel>(testing_support::displaced_sphere(8, 0), pool());
  const double parts[] = {0, -0.0, 1e-310, -1e-310, 1, -1, 1e300};
  for (const Target target : available_targets()) {
    const SceneAccel accel = world_of(mesh, target);
    for (const double x : parts)
      for (const double y : parts)
        for (const double z : parts)
          for (int i = 0; i < 4 && !(x == 0 && y == 0 && z == 0); ++i) {
            const Point3 on_vertex =
                mesh->mesh().positions[static_cast<std::size_t>(draw.unit() * 50)];
            const Ray ray{i % 2 == 0 ? on_vertex : draw.point(1.2), {x, y, z}};
            Hit tree;
            Hit brute;
            ASSERT_EQ(accel.intersect(ray, tree), accel.intersect_brute_force(ray, brute));
            ASSERT_EQ(tree.t, brute.t);
            ASSERT_EQ(tree.primitive, brute.primitive);
          }
  }
}

TEST(MeshAccel, NoLeaksAtAnyScaleOrOffset) {
  const double scales[] = {1, 1e-30, 1e30, 1e-200, 1e200};
  for (const Target target : available_targets()) {
    for (const double scale : scales) {
      TriangleMesh mesh = testing_support::displaced_sphere(24, scale == 1 ? 1000 : 0);
      for (Point3& p : mesh.positions) p = as_point(scale * as_vector(p));
      const auto built = std::make_shared<const MeshAccel>(std::move(mesh), pool());
      const SceneAccel accel = world_of(built, target);
      const Point3 middle = built->bounds().centroid();
      Draw draw(6);
      for (int i = 0; i < 4000; ++i) {
        const TriangleMesh& m = built->mesh();
        const Face& f =
            m.faces[static_cast<std::size_t>(draw.unit() * static_cast<double>(m.faces.size()))];
        const double along = i % 2 == 0 ? draw.unit() : 0;
        const Point3 aim = m.positions[f[0]] + along * (m.positions[f[1]] - m.positions[f[0]]);
        const Point3 from = middle + (0.3 * scale) * as_vector(draw.point(1));
        ASSERT_TRUE(accel.occluded(Ray{from, aim - from})) << scale << " " << i;
      }
    }
  }
}

TEST(MeshAccel, EqualDistancesGoToTheSmallestFace) {
  TriangleMesh mesh;
  mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
  for (int i = 0; i < 50; ++i) mesh.faces.push_back({0, 1, 2});
  const auto built = std::make_shared<const MeshAccel>(std::move(mesh), pool());
  for (const Target target : available_targets()) {
    Hit hit;
    ASSERT_TRUE(world_of(built, target).intersect(Ray{{0, 0, -1}, {0, 0, 1}}, hit));
    EXPECT_EQ(hit.primitive, 0U);
  }
}

TEST(MeshAccel, FloatsAreKeptAndOthersMoveLittle) {
  TriangleMesh exact;
  exact.positions = {{0.1F, 0, 1}, {2, 0.3F, 1}, {0, 1e-20F, 0}};
  exact.faces = {{0, 1, 2}};
  const auto shared = std::make_shared<const TriangleMesh>(exact);
  EXPECT_EQ(MeshAccel(shared, pool()).shared_mesh(), shared);
  TriangleMesh moved = exact;
  moved.positions[0].x = 0.1;
  const MeshAccel accel(moved, pool());
  EXPECT_FALSE(accel.tree().full());
  EXPECT_EQ(accel.mesh().positions[0].x, static_cast<double>(0.1F));
  // A thousand kilometres away the tree has an origin of its own.
  TriangleMesh far = exact;
  for (Point3& p : far.positions) p = p + Vector3{1e9, 0, 0};
  const MeshAccel far_accel(far, pool());
  EXPECT_GT(far_accel.tree().tree.space.center.x, 9e8);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(far_accel.mesh().positions[i].x, far.positions[i].x, 1e-6);
}

TEST(MeshAccel, DetailBelowFloatKeepsItsDoubles) {
  TriangleMesh mesh;
  mesh.positions = {{-1, -1, 0},           {1, -1, 0},           {0, 1, 0}, {0.5, 0.5, 1},
                    {0.5 + 1e-12, 0.5, 1}, {0.5, 0.5 + 1e-12, 1}};
  mesh.faces = {{0, 1, 2}, {3, 4, 5}};
  const auto built = std::make_shared<const MeshAccel>(mesh, pool());
  EXPECT_TRUE(built->tree().full());
  Hit hit;
  ASSERT_TRUE(world_of(built, best_target())
                  .intersect(Ray{{0.5 + 2e-13, 0.5 + 2e-13, 5}, {0, 0, -1}}, hit));
  EXPECT_EQ(hit.primitive, 1U);
}

TEST(MeshAccel, StoredArraysGiveTheSameHits) {
  Draw draw(9);
  const MeshAccel first(soup(draw, 1000, 1), pool());
  MeshTree copy = first.tree();
  const auto second = std::make_shared<const MeshAccel>(first.shared_mesh(), std::move(copy));
  const SceneAccel a = world_of(std::make_shared<const MeshAccel>(first), best_target());
  const SceneAccel b = world_of(second, best_target());
  for (int i = 0; i < 1000; ++i) {
    const Ray ray = random_ray(draw);
    Hit hit_a;
    Hit hit_b;
    ASSERT_EQ(a.intersect(ray, hit_a), b.intersect(ray, hit_b));
    ASSERT_EQ(hit_a.t, hit_b.t);
  }
}

}  // namespace
}  // namespace scenec::backend
