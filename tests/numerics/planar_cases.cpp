// Flat things seen from the side, huge, tiny and thin: G10 - G13, G17, G18.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "backend/accel/scene_accel.hpp"
#include "backend/geometry/disk.hpp"
#include "backend/geometry/plane.hpp"
#include "backend/geometry/quad.hpp"
#include "backend/geometry/triangle.hpp"
#include "tests/numerics/finding.hpp"
#include "tests/numerics/meshes.hpp"
#include "tests/numerics/textbook.hpp"

namespace scenec::numerics {
namespace {

using namespace backend;
using backend::testing_support::Draw;

// Twice 3 products, a sum each, a difference and a quotient: what the closed form may differ by.
constexpr double plane_roundings = 4;

class G10Slope : public testing::TestWithParam<double> {};
TEST_P(G10Slope, NearlyParallelPlanes) {
  constexpr std::uint64_t rays = 100'000;
  const double slope = GetParam();
  Draw draw(10);
  double worst = 0;
  std::uint64_t wrong = 0;
  std::uint64_t naive_missed = 0;
  std::uint64_t hits = 0;
  for (std::uint64_t i = 0; i < rays; ++i) {
    const double scale = draw.power_of_ten(-9, 9);
    const double height = draw.power_of_ten(-3, 3);
    const Plane plane{{0, scale, 0}, -height * scale};
    const Ray ray{{draw.between(-1, 1), 0, 0}, {1, -slope, draw.between(-1, 1)}};
    const Wide n = scale;
    const Wide want = slope == 0 ? 0 : Wide(-height * scale) / (n * Wide(-slope));
    const bool finite = slope != 0 && want < Wide(std::numeric_limits<double>::max());
    ShapeHit hit;
    const bool got = intersect(plane, ray, hit);
    // n d underflows for slopes near the end of the range; what is left of it then decides.
    const bool normal = std::fabs(scale * slope) > 0x1p-1000;
    if (got != finite && (normal || slope == 0)) ++wrong;
    if (got && normal) {
      ++hits;
      worst = std::fmax(worst,
                        static_cast<double>(magnitude(Wide(hit.t) - want) / want) / unit_roundoff);
    }
    double t = 0;
    if (finite && !textbook::plane<double>(as<double>(plane.normal), plane.offset,
                                           as<double>(ray.origin), as<double>(ray.direction), t))
      ++naive_missed;
  }
  EXPECT_EQ(wrong, 0U);
  EXPECT_LE(worst, plane_roundings);
  record({"G10", fmt::format("n.d = {:g} |n|", slope), rays,
          fmt::format("{} wrong; t {} u off", wrong, short_number(worst)),
          fmt::format("misses {}", percent(naive_missed, rays))});
}
INSTANTIATE_TEST_SUITE_P(G10, G10Slope, testing::Values(1e-9, 1e-16, 1e-300, 0.0));

TEST(G11, RaysWithinAPlaneMiss) {
  constexpr int rays = 100'000;
  Draw draw(11);
  int hits = 0;
  for (int i = 0; i < rays; ++i) {
    const Vector3 d{draw.between(-1, 1), i % 2 == 0 ? 0.0 : -0.0, draw.between(-1, 1)};
    const Ray ray{{draw.between(-3, 3), 0, draw.between(-3, 3)}, d};
    ShapeHit hit;
    hits += intersect(Plane{{0, 2, 0}, 0}, ray, hit) ? 1 : 0;
    hits += intersect(Triangle{{-1, 0, -1}, {2, 0, 0}, {0, 0, 2}}, ray, hit) ? 1 : 0;
    hits += intersect(Quad{{-1, 0, -1}, {2, 0, 0}, {0, 0, 2}}, ray, hit) ? 1 : 0;
    hits += intersect(Disk{{0, 0, 0}, UnitVector3::assume_unit({0, 1, 0}), 1}, ray, hit) ? 1 : 0;
    // Along an edge of a triangle whose plane is any: d runs from corner to corner exactly.
    const Point3 a{std::floor(draw.between(-9, 9)), std::floor(draw.between(-9, 9)),
                   std::floor(draw.between(-9, 9))};
    const Vector3 e{std::floor(draw.between(1, 9)), std::floor(draw.between(1, 9)), 1};
    const Triangle t{a, a + e, a + Vector3{e.z, -e.x, e.y + 3}};
    if (intersect(t, Ray{a - 2 * e, e}, hit)) {
      ++hits;
      EXPECT_TRUE(std::isfinite(hit.t));
    }
  }
  EXPECT_EQ(hits, 0);
  record({"G11", "plane, triangle, quad, disk, edge", rays, fmt::format("{} hits", hits), ""});
}

TEST(G12, TinyTrianglesAreHit) {
  constexpr std::uint64_t rays = 100'000;
  Series ours{"tiny-triangles", "scenec", {}, {}};
  Series naive{"tiny-triangles", "Möller–Trumbore, 1e-8", {}, {}};
  std::uint64_t total_missed = 0;
  std::uint64_t naive_total = 0;
  for (int k = 0; k <= 18; ++k) {
    Draw draw(12);
    const double leg = pow(10.0, -k);
    const Triangle t{{0, 0, 0}, {leg, 0, 0}, {0, leg, 0}};
    std::uint64_t missed = 0;
    std::uint64_t naive_missed = 0;
    for (std::uint64_t i = 0; i < rays; ++i) {
      const double u = draw.between(0.001, 0.998);
      const double v = draw.between(0.0005, 0.9995 - u);
      const Point3 target{u * leg, v * leg, 0};
      const Point3 origin = target + leg * draw.between(0.5, 2) *
                                         Vector3{draw.between(-1, 1), draw.between(-1, 1), 1};
      const Ray ray{origin, normalized(target - origin)};
      ShapeHit hit;
      if (!intersect(t, ray, hit)) ++missed;
      double s = 0;
      if (!textbook::triangle<double>(as<double>(t.a), as<double>(t.b), as<double>(t.c),
                                      as<double>(ray.origin), as<double>(ray.direction), s))
        ++naive_missed;
    }
    EXPECT_EQ(missed, 0U) << k;
    total_missed += missed;
    naive_total += naive_missed;
    for (Series* s : {&ours, &naive}) s->x.push_back(leg);
    ours.y.push_back(100.0 - 100.0 * double(missed) / double(rays));
    naive.y.push_back(100.0 - 100.0 * double(naive_missed) / double(rays));
  }
  record(ours);
  record(naive);
  record({"G12", "legs 10^-k, k = 0..18", 19 * rays, fmt::format("{} missed", total_missed),
          fmt::format("misses {}: every one below legs of 1e-4", percent(naive_total, 19 * rays))});
}

TEST(G13, GrazingAHugeTriangle) {
  constexpr std::uint64_t rays = 100'000;
  Draw draw(13);
  const Triangle t{{-1e7, 0, -1e7}, {1e7, 0, -1e7}, {0, 0, 1e7}};
  double worst = 0;
  double naive_worst = 0;
  std::uint64_t missed = 0;
  std::uint64_t naive_missed = 0;
  for (std::uint64_t i = 0; i < rays; ++i) {
    const Point3 origin{draw.between(-1e3, 1e3), draw.between(1e-3, 1), draw.between(-1e3, 1e3)};
    const Ray ray{origin, {1, -1e-6, draw.between(-0.1, 0.1)}};
    const Wide want = Wide(origin.y) / Wide(1e-6);
    ShapeHit hit;
    if (!intersect(t, ray, hit)) {
      ++missed;
    } else {
      worst = std::fmax(worst, static_cast<double>(magnitude(Wide(hit.t) - want) / want));
    }
    float s = 0;
    if (!textbook::triangle<float>(as<float>(t.a), as<float>(t.b), as<float>(t.c),
                                   as<float>(ray.origin), as<float>(ray.direction), s))
      ++naive_missed;
    else
      naive_worst = std::fmax(naive_worst, static_cast<double>(magnitude(Wide(s) - want) / want));
  }
  EXPECT_EQ(missed, 0U);
  EXPECT_LE(worst, 1e-9);
  record({"G13", "edges of 2e7, incidence 1e-6", rays,
          fmt::format("{} missed; t {} relative", missed, short_number(worst)),
          fmt::format("float: misses {}, t {} relative", percent(naive_missed, rays),
                      short_number(naive_worst))});
}

// The edge functions of the exact input along the ray, in quadruple precision.
std::array<Wide, 3> true_edges(const Triangle& t, const Ray& ray) {
  const V3<Wide> d = as<Wide>(ray.direction);
  const V3<Wide> a = as<Wide>(t.a) - as<Wide>(ray.origin);
  const V3<Wide> b = as<Wide>(t.b) - as<Wide>(ray.origin);
  const V3<Wide> c = as<Wide>(t.c) - as<Wide>(ray.origin);
  return {dot(d, cross(b, c)), dot(d, cross(c, a)), dot(d, cross(a, b))};
}

class G17Aspect : public testing::TestWithParam<double> {};
TEST_P(G17Aspect, SliversAreJudgedToAnUlp) {
  constexpr std::uint64_t rays = 100'000;
  const double aspect = GetParam();
  Draw draw(17);
  double worst = 0;  // of an edge function whose sign came out wrong, in ulps of its products
  std::uint64_t differ = 0;
  std::uint64_t naive_differ = 0;
  double outside = 0;
  for (std::uint64_t i = 0; i < rays; ++i) {
    const Point3 a = draw.point(1);
    const Vector3 along = draw.direction();
    const Vector3 side = cross(along, draw.direction().vector());
    const Triangle t{a, a + along, a + 0.5 * along + (1 / aspect) * side};
    const double v = draw.between(-0.1, 1.1);
    const Point3 target = a + draw.between(-0.1, 1.1) * along * (1 - 0.5 * v) + v * (t.c - a);
    const Point3 origin = target + draw.between(1, 5) * draw.direction().vector();
    const Ray ray{origin, target - origin};
    const std::array<Wide, 3> e = true_edges(t, ray);
    const bool inside =
        (e[0] >= 0 && e[1] >= 0 && e[2] >= 0) || (e[0] <= 0 && e[1] <= 0 && e[2] <= 0);
    ShapeHit hit;
    const bool got = intersect(t, ray, hit);
    if (got) outside = std::fmax(outside, std::fmax(-hit.a, std::fmax(-hit.b, hit.a + hit.b - 1)));
    double s = 0;
    if (textbook::triangle<double>(as<double>(t.a), as<double>(t.b), as<double>(t.c),
                                   as<double>(origin), as<double>(ray.direction), s) != inside)
      ++naive_differ;
    if (got == inside) continue;
    ++differ;
    const std::array<double, 3> r{distance(t.a, origin), distance(t.b, origin),
                                  distance(t.c, origin)};
    const double d = length(ray.direction);
    // Inside or outside hangs on the smallest edge function.
    double off = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 3; ++k)
      off = std::fmin(off, static_cast<double>(magnitude(e[k])) /
                               (2 * unit_roundoff * d * r[(k + 1) % 3] * r[(k + 2) % 3]));
    worst = std::fmax(worst, off);
  }
  EXPECT_LE(worst, 1);
  EXPECT_LE(outside, 4 * unit_roundoff);
  record({"G17", fmt::format("aspect {:.0e}", aspect), rays,
          fmt::format("{} judged otherwise, by {} ulp; weights outside by {} u", differ,
                      short_number(worst), short_number(outside / unit_roundoff)),
          fmt::format("{} judged otherwise", naive_differ)});
}
INSTANTIATE_TEST_SUITE_P(G17, G17Aspect, testing::Values(1e6, 1e8, 1e10, 1e12));

// Faces that are none among those of a closed mesh.
TriangleMesh spoilt(TriangleMesh mesh) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  const auto first_bad = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.push_back({nan, 0, 0});
  mesh.positions.push_back({0, inf, 0});
  std::vector<Face> bad;
  for (std::size_t i = 0; i < mesh.faces.size(); i += 7) {
    const Face f = mesh.faces[i];
    bad.push_back({f[0], f[1], f[1]});           // an edge
    bad.push_back({f[2], f[2], f[2]});           // a point
    bad.push_back({f[0], f[1], first_bad});      // nothing
    bad.push_back({f[0], first_bad + 1, f[2]});  // without end
  }
  mesh.faces.insert(mesh.faces.end(), bad.begin(), bad.end());
  return mesh;
}

TEST(G18, FacesThatAreNoneDisturbNobody) {
  constexpr std::uint64_t rays = 100'000;
  ThreadPool pool(2);
  const TriangleMesh clean = icosphere(4, 0);
  const auto good = std::make_shared<const MeshAccel>(clean, pool);
  const auto bad = std::make_shared<const MeshAccel>(spoilt(clean), pool);
  SceneAccel a;
  SceneAccel b;
  a.add_mesh(0, good);
  b.add_mesh(0, bad);
  a.build(pool);
  b.build(pool);
  LeakRays source(clean, 0, 18);
  std::uint64_t leaks = 0;
  std::uint64_t different = 0;
  for (std::uint64_t i = 0; i < rays; ++i) {
    const Ray ray = source.next();
    Hit x;
    Hit y;
    if (!a.intersect(ray, x) || !b.intersect(ray, y)) {
      ++leaks;
    } else if (x.t != y.t || x.primitive != y.primitive) {
      ++different;
    }
  }
  EXPECT_EQ(leaks, 0U);
  EXPECT_EQ(different, 0U);
  record({"G18", "5120 faces, 2928 more that are none", rays,
          fmt::format("{} leaks, {} other hits", leaks, different), ""});
}

}  // namespace
}  // namespace scenec::numerics
