// Trees against brute force on inputs that break trees: G07, G19 - G22, G26.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "backend/accel/scene_accel.hpp"
#include "tests/numerics/finding.hpp"
#include "tests/numerics/meshes.hpp"

namespace scenec::numerics {
namespace {

using namespace backend;
using backend::testing_support::Draw;

// Differences between the tree and brute force: bits of t, item, primitive and point.
class Comparison {
 public:
  void add(const SceneAccel& accel, const Ray& ray) {
    Hit tree;
    Hit brute;
    const bool got = accel.intersect(ray, tree);
    const bool want = accel.intersect_brute_force(ray, brute);
    ++rays;
    if (want) ++hits;
    const bool same = got == want && accel.occluded(ray) == want &&
                      (!got || (tree.t == brute.t && tree.item == brute.item &&
                                tree.primitive == brute.primitive && tree.point == brute.point));
    if (!same) ++different;
  }
  std::uint64_t rays = 0;
  std::uint64_t hits = 0;
  std::uint64_t different = 0;
  [[nodiscard]] std::string text() const {
    return fmt::format("{} different of {} hits", different, hits);
  }
};

TEST(G19, AwkwardDirectionsFromSlabPlanes) {
  ThreadPool pool(2);
  SceneAccel accel;
  std::uint32_t item = 0;
  for (std::uint32_t i = 0; i < 64; ++i) {
    const double x = i % 4;
    const double y = i / 4 % 4;
    const double z = i / 16;
    if (i % 3 == 0) {
      accel.add(item++, Sphere{{x + 0.5, y + 0.5, z + 0.5}, 0.5});
    } else if (i % 3 == 1) {
      accel.add(item++, Box{{x, y, z}, {x + 1, y + 1, z + 1}});
    } else {
      accel.add(item++, Quad{{x, y, z}, {1, 0, 0}, {0, 1, 0}});
    }
  }
  accel.build(pool);
  const std::array<double, 8> parts{0, -0.0, 1e-310, -1e-310, 1, -1, 1e300, -1e300};
  Draw draw(19);
  Comparison comparison;
  for (const double dx : parts)
    for (const double dy : parts)
      for (const double dz : parts)
        for (int i = 0; i < 200; ++i) {
          const auto grid = [&] { return std::floor(draw.between(-2, 6)); };
          comparison.add(accel, Ray{{grid(), grid(), grid()}, {dx, dy, dz}});
        }
  EXPECT_EQ(comparison.different, 0U);
  record(
      {"G19", "components of 0, -0, ±1e-310, ±1, ±1e300", comparison.rays, comparison.text(), ""});
}

TEST(G20, FlatBoxes) {
  ThreadPool pool(2);
  SceneAccel accel;
  Draw draw(20);
  for (std::uint32_t i = 0; i < 300; ++i) {
    Point3 low{std::floor(draw.between(-5, 5)), std::floor(draw.between(-5, 5)),
               std::floor(draw.between(-5, 5))};
    Point3 high = low + Vector3{1, 2, 1};
    set_component(high, static_cast<int>(i % 3), component(low, static_cast<int>(i % 3)));
    accel.add(i, Box{low, high});
  }
  accel.build(pool);
  Comparison comparison;
  for (int i = 0; i < 100'000; ++i) {
    // Every second ray lies in a plane of the grid, where the flat boxes are.
    Ray ray{draw.point(8), draw.direction()};
    const int axis = i % 3;
    if (i % 2 == 0) {
      set_component(ray.origin, axis, std::floor(component(ray.origin, axis)));
      set_component(ray.direction, axis, 0);
    }
    comparison.add(accel, ray);
  }
  EXPECT_EQ(comparison.different, 0U);
  record({"G20", "300 flat boxes, half the rays within a plane of them", comparison.rays,
          comparison.text(), ""});
}

// Triangles of sizes from 1e-6 to 1e6 about the origin, and rays at points of them.
TEST(G21, RandomSoup) {
  ThreadPool pool(2);
  Comparison comparison;
  constexpr int soups = 20;
  constexpr int rays_each = 50'000;
  for (int soup = 0; soup < soups; ++soup) {
    Draw draw(static_cast<std::uint64_t>(2100 + soup));
    TriangleMesh mesh;
    // Few large soups show deep trees, many small ones show many rays.
    const std::uint32_t count = soup == 0 ? 400 : 100;
    for (std::uint32_t i = 0; i < count; ++i) {
      const double scale = draw.power_of_ten(-6, 6);
      const Point3 at = draw.point(scale);
      for (int k = 0; k < 3; ++k) mesh.positions.push_back(at + as_vector(draw.point(scale)));
      mesh.faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    const auto shared = std::make_shared<const MeshAccel>(mesh, pool);
    SceneAccel accel;
    accel.add_mesh(0, shared);
    accel.build(pool);
    for (int i = 0; i < rays_each; ++i) {
      const auto face = static_cast<std::uint32_t>(draw.unit() * count);
      const Point3& a = mesh.positions[3 * std::size_t{face}];
      const Point3 target = a + draw.unit() * (mesh.positions[3 * std::size_t{face} + 1] - a);
      const Point3 origin = draw.point(draw.power_of_ten(-6, 6));
      comparison.add(accel, Ray{origin, target - origin});
    }
  }
  EXPECT_EQ(comparison.different, 0U);
  EXPECT_EQ(comparison.rays, 1'000'000U);
  record({"G21", "20 soups of 100 to 400 triangles, sizes 10^U[-6,6]", comparison.rays,
          comparison.text(), ""});
}

TEST(G22, RaysThatAreNone) {
  ThreadPool pool(2);
  SceneAccel accel;
  accel.add_mesh(0, std::make_shared<const MeshAccel>(icosphere(4, 0), pool));
  accel.add(1, Sphere{{0, 0, 0}, 3});
  accel.add(2, Plane{{0, 1, 0}, -3});
  accel.build(pool);
  const double inf = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::uint64_t rays = 0;
  std::uint64_t hits = 0;
  std::uint64_t traced = 0;
  Hit hit;
  Draw draw(22);
  const auto run = [&](const std::function<void(Ray&, double, int)>& spoil) {
    for (int i = 0; i < 9'000; ++i) {
      Ray ray{draw.point(2), draw.direction()};
      const std::array<double, 3> bad{inf, -inf, nan};
      spoil(ray, bad[static_cast<std::size_t>(i % 3)], i % 3);
      ++rays;
      if (is_traceable(ray)) ++traced;
      if (accel.intersect(ray, hit) || accel.occluded(ray)) ++hits;
    }
  };
  const auto origins = [](Ray& r, double bad, int axis) { set_component(r.origin, axis, bad); };
  const auto directions = [](Ray& r, double bad, int axis) {
    set_component(r.direction, axis, bad);
  };
  run(origins);
  run(directions);
  run([&](Ray& r, double, int) { r.t_max = nan; });
  run([&](Ray& r, double, int) { r.t_min = nan; });
  run([](Ray& r, double, int) { r.direction = {0, -0.0, 0}; });
  run([](Ray& r, double, int) { r.t_min = 2, r.t_max = 1; });
  EXPECT_EQ(hits, 0U);
  // Queries ask this before anything else, so such a ray costs less than any other.
  EXPECT_EQ(traced, 0U);
  record({"G22", "NaN or infinity in origin, direction, interval; zero direction; empty interval",
          rays, "0 hits; 0 came to the tree", ""});
}

TriangleMesh repeated(const std::function<Triangle(std::uint32_t)>& make) {
  constexpr std::uint32_t count = 100'000;
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Triangle t = make(i);
    for (const Point3& p : {t.a, t.b, t.c}) mesh.positions.push_back(p);
    mesh.faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return mesh;
}

// Children lie behind their node.
std::size_t levels_of(const WideTree& tree) {
  std::vector<std::size_t> level(tree.nodes.size(), 1);
  std::size_t most = 0;
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    most = std::max(most, level[i]);
    for (const TreeRef child : tree.nodes[i].child)
      if (!child.is_leaf()) level[child.node_index()] = level[i] + 1;
  }
  return most;
}

// Inputs on which builders run away. Nodes and depth are the matter of tree_build_test.cpp.
TEST(G26, BuildBombs) {
  ThreadPool pool(1);
  Draw draw(26);
  const auto soup = repeated([&](std::uint32_t) {
    const Point3 at = draw.point(10);
    return Triangle{at, at + as_vector(draw.point(0.2)), at + as_vector(draw.point(0.2))};
  });
  const std::array<TriangleMesh, 3> bombs{
      repeated([](std::uint32_t) { return Triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}; }),
      repeated([](std::uint32_t i) {
        const double r = i + 1;
        return Triangle{{-r, -r, 0}, {r, -r, 0}, {0, r, 0}};
      }),
      repeated([](std::uint32_t i) {
        const double x = i;
        return Triangle{{x, 0, 0}, {x + 1, 0, 0}, {x, 1, 0}};
      })};
  // A node is made once, and each level looks at each triangle at most once: nodes and levels bound
  // the work.
  std::size_t most_nodes = 0;
  std::size_t most_levels = 0;
  const std::size_t usual = MeshAccel(soup, pool).tree().tree.nodes.size();
  for (const TriangleMesh& bomb : bombs) {
    const MeshAccel accel(bomb, pool);
    most_nodes = std::max(most_nodes, accel.tree().tree.nodes.size());
    most_levels = std::max(most_levels, levels_of(accel.tree().tree));
  }
  EXPECT_LE(most_nodes, 5 * usual);
  EXPECT_LE(most_levels, 96U);
  record({"G26", "100000 equal, nested, in line", 300'000,
          fmt::format("{} nodes, {} in a soup; {} levels", most_nodes, usual, most_levels), ""});
}

const std::vector<ProfilePoint> vase{{1, 0}, {2, 0.7}, {0.2, 1.3}, {1, 2}};

struct Leaving {
  const char* shape;
  bool convex;
  void (*add)(SceneAccel&, SceneAccel::TransformIndex, ThreadPool&);
};

const std::array<Leaving, 10>& leaving() {
  using Place = SceneAccel::TransformIndex;
  static const std::array<Leaving, 10> all{{
      {"sphere", true,
       [](SceneAccel& a, Place p, ThreadPool&) { a.add(0, Sphere{{0, 0, 0}, 1}, p); }},
      {"triangle", true,
       [](SceneAccel& a, Place p, ThreadPool&) {
         a.add(0, Triangle{{-1, 0, 0}, {1, 0, 0.5}, {0, 1, 0}}, p);
       }},
      {"quad", true,
       [](SceneAccel& a, Place p, ThreadPool&) {
         a.add(0, Quad{{-1, -1, 0}, {2, 0, 0}, {0.5, 2, 0}}, p);
       }},
      {"disk", true,
       [](SceneAccel& a, Place p, ThreadPool&) {
         a.add(0, Disk{{0, 0, 0}, normalized(Vector3{1, 2, 3}), 1}, p);
       }},
      {"box", true,
       [](SceneAccel& a, Place p, ThreadPool&) { a.add(0, Box{{-1, -1, 0}, {1, 1, 1}}, p); }},
      {"capped cylinder", true,
       [](SceneAccel& a, Place p, ThreadPool&) {
         a.add(0, Cylinder({0, 0, 0}, {1, 1, 0}, 0.5, true), p);
       }},
      {"open cylinder", false,
       [](SceneAccel& a, Place p, ThreadPool&) {
         a.add(0, Cylinder({0, 0, 0}, {0, 0, 1}, 0.5, false), p);
       }},
      {"mesh", false,
       [](SceneAccel& a, Place p, ThreadPool& pool) {
         a.add_mesh(
             0, std::make_shared<const MeshAccel>(testing_support::displaced_sphere(12, 0), pool),
             p);
       }},
      {"revolve", false,
       [](SceneAccel& a, Place p, ThreadPool&) {
         a.add_revolve(0, std::make_shared<const Revolve>(bezier_profile(vase)), p);
       }},
      {"plane", true, [](SceneAccel& a, Place p, ThreadPool&) { a.add(0, Plane{}, p); }},
  }};
  return all;
}

class G07Leaving : public testing::TestWithParam<std::size_t> {};
// From a hit, rays to the side away from it: a convex shape must not be hit at all, another not
// within a share of its size far above rounding (its other parts may truly be met again).
TEST_P(G07Leaving, NothingIsHitTwice) {
  const Leaving& kind = leaving()[GetParam()];
  constexpr int shapes = 100;
  constexpr int rays_each = 1'000;
  ThreadPool pool(1);
  Draw draw(700 + GetParam());
  std::uint64_t spawned = 0;
  std::uint64_t again = 0;
  for (int i = 0; i < shapes; ++i) {
    const double size = draw.power_of_ten(-8, 8);
    const Transform place = draw.affine(i % 3 == 0   ? 4
                                        : i % 3 == 1 ? 0.5
                                                     : 0) *
                            Transform::scaling({size, size, size});
    SceneAccel accel;
    kind.add(accel, accel.add_transform(place), pool);
    accel.build(pool);
    for (int k = 0; k < rays_each; k += 10) {
      const Point3 from = place.apply(draw.point(3));
      Hit hit;
      if (!accel.intersect(Ray{from, place.apply(draw.point(0.5)) - from}, hit)) continue;
      for (int n = 0; n < 10; ++n) {
        const Vector3 d = draw.direction();
        const bool grazing = n % 2 == 1;
        const Vector3 side =
            grazing ? d - 0.9999 * dot(d, hit.geometric_normal) * hit.geometric_normal.vector() : d;
        const Vector3 out = dot(side, hit.geometric_normal) < 0 ? -side : side;
        Ray ray = spawn_ray(hit, out);
        if (!kind.convex) {
          if (place.condition() > 100 || (place.condition() > 2 && grazing)) continue;
          ray.t_max = 1e-6 * size / (length(out) * place.condition());
        }
        ++spawned;
        if (accel.occluded(ray)) ++again;
      }
    }
  }
  EXPECT_EQ(again, 0U);
  EXPECT_GT(spawned, 5'000U);
  record({"G07", kind.shape, spawned, fmt::format("{} hit again", again), ""});
}
INSTANTIATE_TEST_SUITE_P(G07, G07Leaving, testing::Range(std::size_t{0}, std::size_t{10}));

}  // namespace
}  // namespace scenec::numerics
