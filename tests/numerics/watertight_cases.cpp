// Closed meshes do not leak: G14, its negative controls (G15 and the textbook), and G16.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "backend/accel/scene_accel.hpp"
#include "backend/geometry/triangle.hpp"
#include "tests/numerics/contracted.hpp"
#include "tests/numerics/finding.hpp"
#include "tests/numerics/meshes.hpp"
#include "tests/numerics/textbook.hpp"

namespace scenec::numerics {
namespace {

using namespace backend;

constexpr std::uint32_t quads_round = 24;

template <class Hits>
std::uint64_t leaks(const TriangleMesh& mesh, double offset, std::uint64_t rays, Hits&& hits) {
  LeakRays source(mesh, offset, 14);
  std::uint64_t count = 0;
  for (std::uint64_t i = 0; i < rays; ++i)
    if (!hits(source.next())) ++count;
  return count;
}

// The same, edges and vertices only.
template <class Hits>
std::uint64_t aimed_leaks(const TriangleMesh& mesh, double offset, std::uint64_t rays,
                          Hits&& hits) {
  LeakRays source(mesh, offset, 15);
  std::uint64_t count = 0;
  for (std::uint64_t i = 0; i < rays;) {
    const Ray ray = source.next();
    if (!source.aimed()) continue;
    ++i;
    if (!hits(ray)) ++count;
  }
  return count;
}

bool brute_force(const TriangleMesh& mesh, const Ray& ray) {
  const RayShear shear(ray);
  ShapeHit hit;
  for (const Face& f : mesh.faces)
    if (intersect_triangle(shear, mesh.positions[f[0]], mesh.positions[f[1]], mesh.positions[f[2]],
                           ray.t_min, ray.t_max, hit))
      return true;
  return false;
}

template <class T>
bool moller_trumbore(const TriangleMesh& mesh, const Ray& ray) {
  const V3<T> o = as<T>(ray.origin);
  const V3<T> d = as<T>(ray.direction);
  T t{};
  for (const Face& f : mesh.faces)
    // Without the threshold, which would leak for small faces by itself.
    if (textbook::triangle<T>(as<T>(mesh.positions[f[0]]), as<T>(mesh.positions[f[1]]),
                              as<T>(mesh.positions[f[2]]), o, d, t, 1e-300))
      return true;
  return false;
}

class TreeOf {
 public:
  TreeOf(TriangleMesh mesh) : mesh_(std::make_shared<const MeshAccel>(std::move(mesh), pool_)) {
    accel_.add_mesh(0, mesh_);
    accel_.build(pool_);
  }
  [[nodiscard]] const TriangleMesh& mesh() const { return mesh_->mesh(); }
  [[nodiscard]] bool hits(const Ray& ray) const {
    Hit hit;
    return accel_.occluded(ray) && accel_.intersect(ray, hit);
  }

 private:
  ThreadPool pool_{2};
  std::shared_ptr<const MeshAccel> mesh_;
  SceneAccel accel_;
};

class G14Watertight : public testing::TestWithParam<double> {
 protected:
  void brute(std::uint64_t rays) {
    const double offset = GetParam();
    const TriangleMesh mesh = testing_support::displaced_sphere(quads_round, offset);
    const std::uint64_t lost =
        leaks(mesh, offset, rays, [&](const Ray& ray) { return brute_force(mesh, ray); });
    EXPECT_EQ(lost, 0U);
    constexpr std::uint64_t few = 20'000;
    const auto naive = [&]<class T>(T) {
      return percent(aimed_leaks(mesh, offset, few,
                                 [&](const Ray& ray) { return moller_trumbore<T>(mesh, ray); }),
                     few);
    };
    record({"G14", fmt::format("bumpy sphere, 1104 faces, offset {:g}, every face", offset), rays,
            fmt::format("{} leaks", lost),
            fmt::format("of those at edges and vertices {} leak", naive(1.0))});
  }
  void tree(std::uint64_t rays) {
    const double offset = GetParam();
    const TreeOf tree(icosphere(6, offset));
    const std::uint64_t lost =
        leaks(tree.mesh(), offset, rays, [&](const Ray& ray) { return tree.hits(ray); });
    EXPECT_EQ(lost, 0U);
    record({"G14", fmt::format("icosphere, 81920 faces, offset {:g}, tree", offset), rays,
            fmt::format("{} leaks", lost), ""});
  }
};
TEST_P(G14Watertight, EveryFace) {
  brute(1'000'000);
}
TEST_P(G14Watertight, Tree) {
  tree(1'000'000);
}
TEST_P(G14Watertight, SlowEveryFace) {
  brute(10'000'000);
}
TEST_P(G14Watertight, SlowTree) {
  tree(10'000'000);
}
INSTANTIATE_TEST_SUITE_P(G14, G14Watertight, testing::Values(0.0, 1e3, 1e6));

// The tests above must be able to fail.
TEST(G15, ControlsLeak) {
  constexpr std::uint64_t rays = 60'000;
  const TriangleMesh mesh = testing_support::displaced_sphere(quads_round, 0);
  const std::uint64_t ours =
      aimed_leaks(mesh, 0, rays, [&](const Ray& ray) { return brute_force(mesh, ray); });
  const std::uint64_t in_double = aimed_leaks(
      mesh, 0, rays, [&](const Ray& ray) { return moller_trumbore<double>(mesh, ray); });
  const std::uint64_t in_float =
      aimed_leaks(mesh, 0, rays, [&](const Ray& ray) { return moller_trumbore<float>(mesh, ray); });
  EXPECT_EQ(ours, 0U);
  EXPECT_GT(in_double, rays / 100);
  EXPECT_GT(in_float, rays / 100);
  Series bars{"leaks", "", {1, 2, 4}, {double(in_float), double(in_double), double(ours)}};
  record({"G15", "our kernel as built", rays, fmt::format("{} leaks", ours), ""});
  record(
      {"G15", "Moller-Trumbore, float", rays, fmt::format("{} leaks (must leak)", in_float), ""});
  record(
      {"G15", "Moller-Trumbore, double", rays, fmt::format("{} leaks (must leak)", in_double), ""});
  if (can_contract()) {
    std::vector<double> positions;
    for (const Point3& p : mesh.positions) positions.insert(positions.end(), {p.x, p.y, p.z});
    std::vector<std::array<std::uint32_t, 3>> faces(mesh.faces.begin(), mesh.faces.end());
    const std::uint64_t fused = aimed_leaks(mesh, 0, rays, [&](const Ray& ray) {
      return contracted_hit(positions.data(),
                            reinterpret_cast<const std::uint32_t(*)[3]>(faces.data()), faces.size(),
                            &ray.origin.x, &ray.direction.x);
    });
    EXPECT_GT(fused, 0U);
    record({"G15", "our kernel with -mfma -ffp-contract=fast", rays,
            fmt::format("{} leaks (must leak)", fused), ""});
    bars.x.push_back(3);
    bars.y.push_back(static_cast<double>(fused));
  }
  record(bars);
}

// The side a face shows to the ray, by the very numbers the kernel decides with.
double winding(const RayShear& shear, const Point3& pa, const Point3& pb, const Point3& pc) {
  const auto a = shear.of(pa);
  const auto b = shear.of(pb);
  const auto c = shear.of(pc);
  return (c.x * b.y - c.y * b.x) + (a.x * c.y - a.y * c.x) + (b.x * a.y - b.y * a.x);
}

// What goes in comes out: the crossings of a ray through a closed mesh, counted by side, cancel.
TEST(G16, CrossingsCancel) {
  constexpr std::uint64_t rays = 100'000;
  constexpr std::uint64_t few = 20'000;
  for (const double offset : {0.0, 1e3, 1e6}) {
    const TriangleMesh mesh = testing_support::displaced_sphere(quads_round, offset);
    testing_support::Draw draw(16);
    std::uint64_t odd = 0;
    std::uint64_t on_edges = 0;
    std::uint64_t naive_odd = 0;
    for (std::uint64_t i = 0; i < rays; ++i) {
      const Point3 origin = Point3{offset, offset, offset} + 4 * draw.direction().vector();
      const Point3 target = Point3{offset, offset, offset} + as_vector(draw.point(1));
      const Ray ray{origin, target - origin};
      const RayShear shear(ray);
      int sum = 0;
      int naive = 0;
      bool edge = false;
      for (const Face& f : mesh.faces) {
        const Point3& a = mesh.positions[f[0]];
        const Point3& b = mesh.positions[f[1]];
        const Point3& c = mesh.positions[f[2]];
        const bool inward = winding(shear, a, b, c) < 0;
        ShapeHit hit;
        if (intersect_triangle(shear, a, b, c, ray.t_min, ray.t_max, hit)) {
          edge = edge || hit.a == 0 || hit.b == 0 || hit.a + hit.b == 1;
          sum += inward ? 1 : -1;
        }
        float t = 0;
        if (offset == 0 && i < few &&
            textbook::triangle<float>(as<float>(a), as<float>(b), as<float>(c), as<float>(origin),
                                      as<float>(ray.direction), t))
          naive += inward ? 1 : -1;
      }
      if (edge)
        ++on_edges;
      else if (sum != 0)
        ++odd;
      if (naive != 0) ++naive_odd;
    }
    EXPECT_EQ(odd, 0U) << offset;
    record(
        {"G16", fmt::format("offset {:g}", offset), rays,
         fmt::format("{} unbalanced ({} on an edge left out)", odd, on_edges),
         offset == 0 ? fmt::format("float: {} of {} unbalanced", naive_odd, few) : std::string()});
  }
}

}  // namespace
}  // namespace scenec::numerics
