// Profiles without a closed form, against certified counts of their roots (R06, R07, R10, R11, R13,
// R14, R20), degenerate ones (R12), among other shapes (R15), and as triangles (R18).
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "backend/accel/scene_accel.hpp"
#include "backend/geometry/profile_point.hpp"
#include "backend/geometry/revolve_mesh.hpp"
#include "tests/numerics/finding.hpp"
#include "tests/numerics/profile_roots.hpp"
#include "tests/unit/backend/geometry/random_rays.hpp"

namespace scenec::numerics {
namespace {

using namespace backend;
using backend::testing_support::Draw;
using Points = std::vector<ProfilePoint>;

struct Tally {
  std::uint64_t rays = 0;
  std::uint64_t unsure = 0;
  std::uint64_t roots = 0;
  std::uint64_t wrong = 0;  // rays with too few or too many hits
  double t_error = 0;       // absolute, times the slope of the root
  std::size_t most = 0;
  std::uint64_t seen = 0;
  std::uint64_t newton_missed = 0;

  [[nodiscard]] std::string text() const {
    return fmt::format(
        "{} rays wrong of {} roots ({} too near a tangent or an end to be told); t {}", wrong,
        roots, unsure, short_number(t_error));
  }
  [[nodiscard]] std::string newton() const {
    return seen == 0 ? std::string() : "Newton misses " + percent(newton_missed, seen);
  }
};

void judge(const Revolve& revolve, const Ray& ray, Tally& tally) {
  ++tally.rays;
  const auto want = roots_of(revolve.profile(), ray);
  if (!want) {
    ++tally.unsure;
    return;
  }
  std::vector<ShapeHit> hits;
  intersect_all(revolve, ray, hits);
  tally.roots += want->size();
  tally.most = std::max(tally.most, hits.size());
  ShapeHit first;
  const bool got = intersect(revolve, ray, first);
  const bool ordered = std::is_sorted(
      hits.begin(), hits.end(), [](const ShapeHit& a, const ShapeHit& b) { return a.t < b.t; });
  if (hits.size() != want->size() || got != !want->empty() || !ordered) {
    ++tally.wrong;
    return;
  }
  for (std::size_t i = 0; i < hits.size(); ++i)
    tally.t_error = std::fmax(
        tally.t_error,
        static_cast<double>(magnitude(static_cast<long double>(hits[i].t) - (*want)[i].t)) *
            std::fmin(1, (*want)[i].slope));
  if (want->empty()) return;
  ++tally.seen;
  ShapeHit newton;
  const double t = static_cast<double>((*want)[0].t);
  if (!intersect_by_newton(revolve, ray, newton) || std::fabs(newton.t - t) > 1e-3 * (1 + t))
    ++tally.newton_missed;
}

Ray ray_at(Draw& draw, double radius, double height) {
  const Point3 origin{draw.between(-4, 4) * radius, draw.between(-2, 3) * height,
                      draw.between(-4, 4) * radius};
  const Point3 target{draw.between(-1, 1) * radius, draw.between(0, 1) * height,
                      draw.between(-1, 1) * radius};
  return {origin, normalized(target - origin)};
}

TEST(R06, RaysAlongTheAxis) {
  Draw draw(6);
  Tally tally;
  for (int i = 0; i < 100; ++i) {
    Points p;
    for (int k = 0; k < 4; ++k) p.push_back({draw.between(0.1, 2), draw.between(0, 2)});
    const Revolve revolve(bezier_profile(p));
    for (int k = 0; k < 1'000; ++k)
      judge(revolve, Ray{{draw.between(-1.4, 1.4), -3, draw.between(-1.4, 1.4)}, {0, 1, 0}}, tally);
  }
  EXPECT_EQ(tally.wrong, 0U);
  EXPECT_LE(tally.most, 3U);
  record({"R06", "100 random cubics", tally.rays,
          tally.text() + fmt::format("; at most {} hits", tally.most), tally.newton()});
}

TEST(R07, AsManyHitsAsThereCanBe) {
  // h(s) - 0.5 has three roots, so a level ray near the axis has six hits.
  const Revolve cubic(bezier_profile(Points{{1, 0}, {1.2, 3}, {1.4, -2}, {1.6, 1}}));
  Draw draw(7);
  constexpr std::uint64_t rays = 50'000;
  std::uint64_t six = 0;
  std::vector<ShapeHit> hits;
  for (std::uint64_t i = 0; i < rays; ++i) {
    const double slope = i % 2 == 0 ? 0 : draw.between(-1e-3, 1e-3);
    intersect_all(cubic, Ray{{-5, 0.5 - 5 * slope, draw.between(-0.6, 0.6)}, {1, slope, 0}}, hits);
    if (hits.size() == 6 && hits[0].t < hits[5].t) ++six;
  }
  EXPECT_EQ(six, rays);
  record({"R07", "a cubic built for six", rays, fmt::format("{} with all six", six), ""});
  // Heights as Chebyshev's polynomial of degree 15, whose Bernstein coefficients are
  // (-1)^(n-i) C(2n, 2i) / C(n, i): fifteen crossings of the middle height.
  Points wave;
  double coefficient = 1;
  for (int i = 0; i <= 15; ++i) {
    wave.push_back({1 + 0.02 * i, (i % 2 == 0 ? -0.3 : 0.3) * coefficient});
    coefficient *=
        (30.0 - 2 * i) * (29.0 - 2 * i) / ((2 * i + 1) * (2 * i + 2)) * (i + 1) / (15.0 - i);
  }
  const Revolve steep(bezier_profile(wave));
  Tally tally;
  for (int i = 0; i < 300; ++i) {
    const double slope = draw.between(-0.02, 0.02);
    judge(steep, Ray{{-5, -5 * slope, draw.between(-0.5, 0.5)}, {1, slope, 0}}, tally);
  }
  EXPECT_EQ(tally.wrong, 0U);
  EXPECT_EQ(tally.most, 30U);
  record({"R07", "degree 15, fifteen waves", tally.rays,
          tally.text() + fmt::format("; up to {} hits", tally.most), tally.newton()});
}

struct Shape {
  const char* id;
  const char* name;
  Profile (*make)();
};

Profile vase() {
  return bezier_profile(Points{{1, 0}, {2, 0.7}, {0.2, 1.3}, {1, 2}});
}
Profile loop() {
  return bezier_profile(Points{{0.5, 0}, {3, 2}, {-1, 2}, {2, 0}});
}
Profile through_axis() {
  return bezier_profile(Points{{1, 0}, {-1.5, 0.7}, {1.5, 1.3}, {-1, 2}});
}
Profile touching_axis() {
  return bezier_profile(Points{{1, 0}, {0, 0.7}, {0, 1.3}, {1, 2}});
}
Profile stairs() {
  return polyline_profile(
      Points{{0, 0}, {1, 0}, {1, 0.5}, {0.5, 0.5}, {0.5, 1.2}, {0.8, 1.5}, {0.8, 2}, {0, 2}});
}
Profile clamped_spline() {
  return bspline_profile(Points{{0.5, 0}, {1.5, 0.5}, {0.5, 1}, {1.5, 1.5}, {0.7, 2}, {1, 2.5}},
                         SplineEnds::clamped);
}
Profile uniform_spline() {
  return bspline_profile(Points{{0.5, 0}, {1.5, 0.5}, {0.5, 1}, {1.5, 1.5}, {0.7, 2}, {1, 2.5}},
                         SplineEnds::uniform);
}
Profile cubics() {
  return beziers_profile(Points{{0, 0},
                                {1, 0},
                                {1, 0.5},
                                {0.6, 0.7},
                                {0.2, 0.9},
                                {0.2, 1.2},
                                {0.7, 1.4},
                                {1, 1.5},
                                {0.9, 2},
                                {0, 2}});
}
// A horn like the vuvuzela of POV-Ray's open issue 335: long, thin, nearly straight, flared late.
Profile horn() {
  return beziers_profile(Points{
      {0.01, 0}, {0.01, 0.9}, {0.02, 1.6}, {0.03, 1.7}, {0.05, 1.9}, {0.12, 1.98}, {0.3, 2}});
}

class R10Profiles : public testing::TestWithParam<Shape> {};
TEST_P(R10Profiles, HaveTheirCountedRoots) {
  const Shape& shape = GetParam();
  const Revolve revolve(shape.make());
  Draw draw(10);
  Tally tally;
  const Bounds3 box = bounds(revolve);
  for (int i = 0; i < 12'500; ++i) judge(revolve, ray_at(draw, box.max.x, box.max.y), tally);
  EXPECT_EQ(tally.wrong, 0U);
  record({shape.id, shape.name, tally.rays, tally.text(), tally.newton()});
}
INSTANTIATE_TEST_SUITE_P(R10R11R13R20, R10Profiles,
                         testing::Values(Shape{"R10", "a loop", loop},
                                         Shape{"R11", "through the axis", through_axis},
                                         Shape{"R11", "touching the axis", touching_axis},
                                         Shape{"R20", "vase, cubic", vase},
                                         Shape{"R20", "polyline", stairs},
                                         Shape{"R13", "spline, clamped", clamped_spline},
                                         Shape{"R13", "spline, uniform", uniform_spline},
                                         Shape{"R20", "three cubics", cubics},
                                         Shape{"R20", "a horn (POV-Ray issue 335)", horn}));

class R20Degree : public testing::TestWithParam<int> {};
TEST_P(R20Degree, RandomProfiles) {
  const int degree = GetParam();
  Draw draw(static_cast<std::uint64_t>(2000 + degree));
  Tally tally;
  const int rays = degree <= 6 ? 100 : 20;
  for (int i = 0; i < 100; ++i) {
    Points p;
    for (int k = 0; k <= degree; ++k) p.push_back({draw.between(0, 1.5), draw.between(0, 2)});
    const Revolve revolve(bezier_profile(p));
    for (int k = 0; k < rays; ++k) judge(revolve, ray_at(draw, 1, 1.5), tally);
  }
  EXPECT_EQ(tally.wrong, 0U);
  record({"R20", fmt::format("100 random profiles of degree {}", degree), tally.rays, tally.text(),
          tally.newton()});
}
INSTANTIATE_TEST_SUITE_P(R20, R20Degree, testing::Values(1, 2, 3, 5, 8, 15));

TEST(R12, DegenerateProfilesAreHarmless) {
  constexpr int rays = 20'000;
  Draw draw(12);
  std::uint64_t bad = 0;
  std::uint64_t count = 0;
  const std::vector<Points> profiles{
      {{1, 1}, {1, 1}, {1, 1}},          // a circle
      {{0, 1}, {0, 1}},                  // a point
      {{0, 0}, {0, 0}, {1, 0}, {1, 1}},  // begins with its limit tangent
      {{0, 1}, {1, 1}},                  // a disk
      {{0.5, 0}, {0.5, 2}},              // a cylinder
      {{0, 0}, {0, 1}}};                 // the axis
  std::vector<ShapeHit> hits;
  for (const Points& p : profiles) {
    const Revolve revolve(bezier_profile(p));
    for (int i = 0; i < rays; ++i) {
      const Ray ray = i % 4 == 0 ? Ray{{draw.between(-1, 1), -1, draw.between(-1, 1)}, {0, 1, 0}}
                                 : ray_at(draw, 1, 1.5);
      ++count;
      intersect_all(revolve, ray, hits);
      for (const ShapeHit& h : hits) {
        const Surface s = surface(revolve, ray, h);
        if (!is_finite(s.point) || !is_finite(as_vector(s.geometric_normal)) ||
            length(as_vector(s.geometric_normal)) == 0 || !is_finite(s.dp_du))
          ++bad;
      }
      if (!hits.empty() && &p != &profiles[0] && hits.size() > 2) ++bad;
    }
  }
  EXPECT_EQ(bad, 0U);
  record({"R12", "circle, point, limit tangent, disk, cylinder, axis", count,
          fmt::format("{} bad", bad), ""});
}

TEST(R13, SpansDoNotLeakAtKnots) {
  std::uint64_t rays = 0;
  std::uint64_t leaks = 0;
  std::uint64_t apart = 0;
  Draw draw(13);
  for (const Profile& profile : {clamped_spline(), uniform_spline(), cubics(), stairs()}) {
    const Revolve revolve(profile);
    for (std::size_t i = 1; i < profile.size(); ++i) {
      const ProfilePoint knot = profile.segment(i)[0];
      const ProfilePoint other = profile.segment(i - 1).back();
      if (knot.height != other.height || knot.radius != other.radius) ++apart;
      for (int k = -50; k <= 50; ++k) {
        const double y = knot.height * (1 + k * 0x1p-52);
        for (int n = 0; n < 60; ++n) {
          const double angle = draw.between(0, 2 * pi);
          // From the axis outward, at and through the joint: something is in the way.
          const double dy = n % 2 == 0 ? 0 : draw.between(-1, 1) * 1e-12;
          ShapeHit hit;
          ++rays;
          const Ray ray{{0, y, 0}, {cos(angle), dy, sin(angle)}};
          if (knot.radius > 0 && knot.height > 0 && knot.height < 2 &&
              !intersect(revolve, ray, hit))
            ++leaks;
        }
      }
    }
  }
  EXPECT_EQ(leaks, 0U);
  EXPECT_EQ(apart, 0U);
  record({"R13", "heights of the knots ±50 ulp, from the axis", rays,
          fmt::format("{} leaks, {} joints apart", leaks, apart), ""});
}

TEST(R14, FromWithin) {
  Draw draw(14);
  const Revolve revolve(vase());
  Tally tally;
  for (int i = 0; i < 50'000; ++i)
    judge(revolve,
          Ray{{draw.between(-0.3, 0.3), draw.between(0.1, 1.9), draw.between(-0.3, 0.3)},
              draw.direction()},
          tally);
  EXPECT_EQ(tally.wrong, 0U);
  record({"R14", "the camera in a vase", tally.rays, tally.text(), tally.newton()});
}

TEST(R15, InFrontOfAndBehindASphere) {
  constexpr int rays = 100'000;
  ThreadPool pool(1);
  const auto shape = std::make_shared<const Revolve>(vase());
  SceneAccel accel;
  accel.add_revolve(0, shape);
  accel.add(1, Sphere{{0, 1, -3}, 0.7});
  accel.add(2, Sphere{{0, 1, 0}, 0.25});
  accel.build(pool);
  Draw draw(15);
  std::uint64_t wrong = 0;
  std::array<std::uint64_t, 3> seen{};
  for (int i = 0; i < rays; ++i) {
    // From either side, and from above into the mouth.
    const Point3 side{draw.between(-1, 1), draw.between(0, 2), i % 2 == 0 ? -6.0 : 6.0};
    const Point3 origin = i % 3 == 0 ? Point3{draw.between(-1, 1), 7, 0} : side;
    const double reach = i % 3 == 0 ? 0.3 : 1;
    const Ray ray{origin,
                  normalized(Point3{draw.between(-reach, reach), draw.between(0, 2), 0} - origin)};
    ShapeHit nearest;
    std::uint32_t item = Hit::none;
    ShapeHit hit;
    const std::array<Sphere, 2> spheres{Sphere{{0, 1, -3}, 0.7}, Sphere{{0, 1, 0}, 0.25}};
    if (intersect(*shape, ray, hit)) {
      nearest = hit;
      item = 0;
    }
    for (std::uint32_t k = 0; k < 2; ++k) {
      if (intersect(spheres[k], ray, hit) && hit.t < nearest.t) {
        nearest = hit;
        item = k + 1;
      }
    }
    Hit got;
    const bool any = accel.intersect(ray, got);
    if (any != (item != Hit::none) || (any && (got.item != item || got.t != nearest.t))) ++wrong;
    if (any) ++seen[got.item];
  }
  EXPECT_EQ(wrong, 0U);
  for (const std::uint64_t n : seen) EXPECT_GT(n, 1000U);
  record({"R15", "one sphere in front, one within", rays, fmt::format("{} wrong", wrong), ""});
}

// The nearest point of the profile by sampling, then by thirds: a distance from above.
double distance_to_profile(const Profile& profile, const Point3& p) {
  const double rho = std::sqrt(p.x * p.x + p.z * p.z);
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const auto at = [&](double s) {
      const ProfilePoint q = evaluate_profile(profile.segment(i), s).point;
      const double r = std::fabs(q.radius) - rho;
      const double h = q.height - p.y;
      return std::sqrt(r * r + h * h);
    };
    constexpr int samples = 64;
    int nearest = 0;
    for (int k = 1; k <= samples; ++k)
      if (at(double(k) / samples) < at(double(nearest) / samples)) nearest = k;
    double low = std::fmax(0, (nearest - 1.0) / samples);
    double high = std::fmin(1, (nearest + 1.0) / samples);
    for (int n = 0; n < 30; ++n) {
      const double a = low + (high - low) / 3;
      const double b = high - (high - low) / 3;
      (at(a) < at(b) ? high : low) = at(a) < at(b) ? b : a;
    }
    best = std::fmin(best, at(0.5 * (low + high)));
  }
  return best;
}

TEST(R18, TrianglesKeepTheirChordBound) {
  Series measured{"chords", "measured", {}, {}};
  Series bound{"chords", "chord bound", {}, {}};
  Draw draw(18);
  double share = 0;
  std::uint64_t points = 0;
  std::uint64_t wrong_side = 0;
  const Profile profile = cubics();
  const Revolve revolve(profile);
  for (const std::uint32_t steps : {4U, 8U, 16U, 32U, 64U, 128U, 256U}) {
    const TriangleMesh mesh = tessellate(revolve, steps);
    EXPECT_LE(mesh.faces.size(), tessellated_face_count(revolve, steps));
    double worst = 0;
    const std::size_t count = 2'000;
    for (std::size_t i = 0; i < count; ++i) {
      const auto face = static_cast<std::uint32_t>(draw.unit() * double(mesh.faces.size()));
      const double b = draw.unit();
      const double c = draw.unit() * (1 - b);
      const Surface s = surface(mesh, {1, face, b, c});
      worst = std::fmax(worst, distance_to_profile(profile, s.point));
      // Faces lie on the side the surface's own normal says.
      if (!(dot(normalized(s.geometric_normal), normalized(s.shading_normal)) > 0)) ++wrong_side;
      ++points;
    }
    const double most = chord_bound(revolve, steps);
    share = std::fmax(share, worst / most);
    measured.x.push_back(steps);
    measured.y.push_back(worst);
    bound.x.push_back(steps);
    bound.y.push_back(most);
  }
  EXPECT_LE(share, 1 + 1e-9);
  EXPECT_EQ(wrong_side, 0U);
  record(measured);
  record(bound);
  record({"R18", "4 to 256 steps, points of the faces", points,
          fmt::format("{} of the bound; {} faces turned", short_number(share), wrong_side), ""});
}

TEST(R18, TrianglesAreClosed) {
  // Every edge of a closed profile's mesh is used once in each direction.
  for (const std::uint32_t steps : {3U, 7U, 64U}) {
    const TriangleMesh mesh = tessellate(Revolve(cubics()), steps);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (const Face& f : mesh.faces)
      for (std::size_t i = 0; i < 3; ++i) edges.emplace_back(f[i], f[(i + 1) % 3]);
    std::sort(edges.begin(), edges.end());
    for (const auto& [a, b] : edges)
      ASSERT_TRUE(std::binary_search(edges.begin(), edges.end(), std::pair(b, a)));
    EXPECT_EQ(std::adjacent_find(edges.begin(), edges.end()), edges.end());
  }
}

// Rays at the surface itself and at 2048 steps of it: what they hit differs by the chord.
void against_triangles(std::uint32_t steps, int rays) {
  ThreadPool pool(2);
  const Revolve revolve(vase());
  SceneAccel accel;
  accel.add_mesh(0, std::make_shared<const MeshAccel>(tessellate(revolve, steps), pool));
  accel.build(pool);
  const double bound = chord_bound(revolve, steps);
  Draw draw(180);
  double share = 0;
  double uv = 0;
  std::uint64_t compared = 0;
  std::uint64_t only_one = 0;
  std::uint64_t silhouettes = 0;
  std::vector<ShapeHit> hits;
  for (int i = 0; i < rays; ++i) {
    const Ray ray = ray_at(draw, 1.2, 2);
    Hit chord;
    intersect_all(revolve, ray, hits);
    if (accel.intersect(ray, chord) != !hits.empty()) {
      ++only_one;
      continue;
    }
    if (hits.empty()) continue;
    // At a silhouette the triangles may miss a sheet that the surface shows: the nearest of all.
    const auto off = [&](const ShapeHit& h) { return std::fabs(h.t - chord.t); };
    const ShapeHit exact =
        *std::min_element(hits.begin(), hits.end(),
                          [&](const ShapeHit& a, const ShapeHit& b) { return off(a) < off(b); });
    const Surface s = surface(revolve, ray, exact);
    const double cosine = std::fabs(dot(normalized(s.geometric_normal), ray.direction));
    // At the rims either may be the first to end.
    if (std::fabs(chord.point.y - 1) > 1 - bound) continue;
    // Where the surface is hollow its chords stand out, and show silhouettes of their own.
    if (cosine < 0.2 || std::fabs(dot(chord.geometric_normal, ray.direction)) < 0.2) {
      ++silhouettes;
      continue;
    }
    ++compared;
    share = std::fmax(share, off(exact) * cosine / (2 * bound));
    const double du = std::fabs(s.u - chord.u);
    uv = std::fmax(uv, std::fmax(std::fmin(du, 1 - du), std::fabs(s.v - chord.v)));
  }
  EXPECT_LE(share, 1);
  EXPECT_LE(only_one, static_cast<std::uint64_t>(rays) / 100);
  record({"R18", fmt::format("the surface and {} steps, same rays", steps), compared,
          fmt::format("{} of the bound; u, v differ by {}; {} rays hit only one, {} at silhouettes",
                      short_number(share), short_number(uv), only_one, silhouettes),
          ""});
}
TEST(R18, TrianglesAgainstTheSurface) {
  against_triangles(256, 100'000);
}
TEST(R18, SlowTrianglesAgainstTheSurface) {
  against_triangles(2048, 1'000'000);
}

}  // namespace
}  // namespace scenec::numerics
