// Surfaces of revolution with closed forms (R01 - R06, R08, R09, R16, R19) and what the course's
// Newton iteration makes of the same rays.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "backend/geometry/revolve.hpp"
#include "tests/numerics/finding.hpp"
#include "tests/numerics/wide.hpp"
#include "tests/unit/backend/geometry/random_rays.hpp"

namespace scenec::numerics {
namespace {

using namespace backend;
using backend::testing_support::Draw;
using Points = std::vector<ProfilePoint>;

// rho^2 = a h^2 + b h + c on h in [0, 2], as a cubic that is exactly that; a disk is h = 1.
struct Quadric {
  const char* id;
  const char* name;
  Points profile;
  double a;
  double b;
  double c;
};

constexpr std::size_t disk = 3;

const std::array<Quadric, 4>& quadrics() {
  static const std::array<Quadric, 4> all{{
      {"R01", "cylinder", {{1.5, 0}, {1.5, 2.0 / 3}, {1.5, 4.0 / 3}, {1.5, 2}}, 0, 0, 2.25},
      {"R02", "cone", {{0, 0}, {0.5, 2.0 / 3}, {1, 4.0 / 3}, {1.5, 2}}, 0.5625, 0, 0},
      // rho = s, h = 2 s^2: a pole with a horizontal tangent.
      {"R03", "paraboloid", {{0, 0}, {1.0 / 3, 0}, {2.0 / 3, 2.0 / 3}, {1, 2}}, 0, 0.5, 0},
      {"R04", "disk", {{0, 1}, {0.5, 1}, {1, 1}, {1.5, 1}}, 0, 0, 0},
  }};
  return all;
}

struct Root {
  Wide t;
  Wide s;
  bool steep = false;  // more than 1e-4 off the tangent plane
};
struct Truth {
  std::vector<Root> roots;
  // Tangent to rounding, at a rim, or starting on the surface: either answer is right.
  bool unsure = false;
};

Truth disk_truth(const Ray& ray) {
  const V3<Wide> o = as<Wide>(ray.origin);
  const V3<Wide> d = as<Wide>(ray.direction);
  if (d.y == 0) return {{}, o.y == 1};
  const Wide t = (1 - o.y) / d.y;
  const Wide x = o.x + t * d.x;
  const Wide z = o.z + t * d.z;
  const Wide rho = root(x * x + z * z);
  Truth out;
  // Nearly level rays cross the plane where rounding puts them.
  const Wide blur = Wide(1e-12) * (1 + magnitude(t));
  out.unsure = magnitude(rho - Wide(1.5)) < blur || magnitude(t) < Wide(1e-9);
  if (rho < Wide(1.5) && t >= 0)
    out.roots.push_back({t, rho / Wide(1.5), magnitude(d.y) > Wide(1e-4) * length(d)});
  return out;
}

Truth closed_form(const Quadric& q, const Ray& ray) {
  if (&q == &quadrics()[disk]) return disk_truth(ray);
  const V3<Wide> o = as<Wide>(ray.origin);
  const V3<Wide> d = as<Wide>(ray.direction);
  const Wide a = d.x * d.x + d.z * d.z - Wide(q.a) * d.y * d.y;
  const Wide b = o.x * d.x + o.z * d.z - Wide(q.a) * o.y * d.y - Wide(q.b) * d.y / 2;
  const Wide c = o.x * o.x + o.z * o.z - Wide(q.a) * o.y * o.y - Wide(q.b) * o.y - Wide(q.c);
  std::vector<Wide> t;
  Truth out;
  const Wide discriminant = b * b - a * c;
  if (magnitude(a) < Wide(1e-25) * dot(d, d)) {
    if (b != 0) t.push_back(-c / (2 * b));
  } else {
    out.unsure = magnitude(discriminant) < Wide(1e-11) * (b * b + magnitude(a * c));
    if (discriminant >= 0) {
      const Wide r = -(b + (b < 0 ? -root(discriminant) : root(discriminant)));
      t.push_back(r / a);
      if (r != 0) t.push_back(c / r);
    }
  }
  for (const Wide v : t) {
    const Wide h = o.y + v * d.y;
    const Wide margin = Wide(1e-11);
    out.unsure = out.unsure || magnitude(h) < margin || magnitude(h - 2) < margin ||
                 magnitude(v) < Wide(1e-9) / length(d);
    if (!(h >= 0 && h <= 2 && v >= 0)) continue;
    const V3<Wide> p = o + v * d;
    const V3<Wide> n{2 * p.x, -2 * Wide(q.a) * h - Wide(q.b), 2 * p.z};
    const Wide s = &q == &quadrics()[2] ? root(h / 2) : h / 2;
    out.roots.push_back({v, s, magnitude(dot(n, d)) > Wide(1e-4) * length(n) * length(d)});
  }
  std::sort(out.roots.begin(), out.roots.end(),
            [](const Root& x, const Root& y) { return x.t < y.t; });
  return out;
}

Ray aimed(Draw& draw, double slope) {
  const Point3 origin{draw.between(-6, 6), draw.between(-1, 3), draw.between(-6, 6)};
  const Point3 target{draw.between(-1.5, 1.5), draw.between(0, 2), draw.between(-1.5, 1.5)};
  Ray ray{origin, normalized(target - origin)};
  if (slope >= 0) {
    ray.origin.y = draw.between(0.01, 1.99);
    ray.direction.y = (draw.unit() < 0.5 ? -1 : 1) * slope * draw.unit();
  }
  return ray;
}

struct RayKind {
  const char* name;
  Ray (*make)(Draw&);
};
constexpr std::array<RayKind, 6> ray_kinds{{
    {"generic", [](Draw& d) { return aimed(d, -1); }},
    {"abs(d_y) < 5e-5", [](Draw& d) { return aimed(d, 5e-5); }},
    {"abs(d_y) < 1e-15", [](Draw& d) { return aimed(d, 1e-15); }},
    {"d_y = 0", [](Draw& d) { return aimed(d, 0); }},
    {"along the axis",
     [](Draw& d) { return Ray{{d.between(-1.4, 1.4), -3, d.between(-0.4, 0.4)}, {0, 1, 0}}; }},
    {"from inside",
     [](Draw& d) { return Ray{{d.between(-0.1, 0.1), d.between(0.5, 1.5), 0.05}, d.direction()}; }},
}};

struct Score {
  std::uint64_t rays = 0;
  std::uint64_t unsure = 0;
  std::uint64_t roots = 0;
  std::uint64_t missed = 0;
  std::uint64_t extra = 0;
  std::uint64_t tangent = 0;
  double s_error = 0;          // relative, where steep
  double s_error_tangent = 0;  // else
  std::uint64_t seen = 0;      // rays that hit
  std::uint64_t newton_missed = 0;
};

void judge(const Revolve& revolve, const Ray& ray, const Truth& want, std::vector<ShapeHit>& hits,
           Score& score) {
  intersect_all(revolve, ray, hits);
  score.roots += want.roots.size();
  if (hits.size() < want.roots.size()) ++score.missed;
  if (hits.size() > want.roots.size()) ++score.extra;
  ShapeHit first;
  const bool got = intersect(revolve, ray, first);
  if (got != !want.roots.empty()) ++(got ? score.extra : score.missed);
  if (hits.size() == want.roots.size()) {
    for (std::size_t k = 0; k < hits.size(); ++k) {
      const Root& r = want.roots[k];
      const auto error =
          static_cast<double>(magnitude(Wide(hits[k].a) - r.s) / std::max(r.s, Wide(1e-6)));
      double& worst = r.steep ? score.s_error : score.s_error_tangent;
      worst = std::fmax(worst, error);
      if (!r.steep) ++score.tangent;
    }
  }
  // The iteration is slow: every fourth ray says enough of it.
  if (want.roots.empty() || score.rays % 4 != 0) return;
  ++score.seen;
  ShapeHit newton;
  const double t = static_cast<double>(want.roots[0].t);
  if (!intersect_by_newton(revolve, ray, newton) || std::fabs(newton.t - t) > 1e-3 * (1 + t))
    ++score.newton_missed;
}

Score score_of(const Quadric& q, const RayKind& kind) {
  constexpr std::uint64_t rays = 17'000;  // of six kinds: 1e5 a surface
  const Revolve revolve(bezier_profile(q.profile));
  Draw draw(17);
  Score score;
  std::vector<ShapeHit> hits;
  for (std::uint64_t i = 0; i < rays; ++i) {
    const Ray ray = kind.make(draw);
    const Truth want = closed_form(q, ray);
    ++score.rays;
    if (want.unsure) {
      ++score.unsure;
      continue;
    }
    judge(revolve, ray, want, hits, score);
  }
  return score;
}

class Quadrics : public testing::TestWithParam<std::size_t> {};
TEST_P(Quadrics, MatchTheirClosedForms) {
  const Quadric& q = quadrics()[GetParam()];
  for (const RayKind& kind : ray_kinds) {
    const Score s = score_of(q, kind);
    EXPECT_EQ(s.missed, 0U) << kind.name;
    EXPECT_EQ(s.extra, 0U) << kind.name;
    EXPECT_LE(s.s_error, 1e-10) << kind.name;
    EXPECT_LE(s.s_error_tangent, 1e-6) << kind.name;
    record({q.id, kind.name, s.rays,
            fmt::format("{} missed, {} extra of {} roots; s {} (tangent: {})", s.missed, s.extra,
                        s.roots, short_number(s.s_error), short_number(s.s_error_tangent)),
            s.seen == 0 ? "" : "Newton misses " + percent(s.newton_missed, s.seen)});
  }
}
INSTANTIATE_TEST_SUITE_P(R01R02R03R04, Quadrics, testing::Range(std::size_t{0}, std::size_t{4}));

// The course's method must miss what it is known to miss (finding 5); one bar a kind of ray.
TEST(R03, NewtonMissesRoots) {
  Series bars{"newton", "", {}, {}};
  for (std::size_t k = 0; k < ray_kinds.size(); ++k) {
    const Score s = score_of(quadrics()[2], ray_kinds[k]);
    bars.x.push_back(static_cast<double>(k + 1));
    bars.y.push_back(100.0 * static_cast<double>(s.newton_missed) / static_cast<double>(s.seen));
  }
  EXPECT_GT(bars.y[0], 1);   // generic rays
  EXPECT_GT(bars.y[1], 25);  // nearly level ones
  EXPECT_GT(bars.y[3], 99);
  record(bars);
}

TEST(R05, LevelRaysAreTheLimitOfSlopingOnes) {
  Draw draw(5);
  const Revolve vase(bezier_profile(Points{{1, 0}, {2, 0.7}, {0.2, 1.3}, {1, 2}}));
  constexpr std::uint64_t rays = 3'000;
  double worst = 0;
  std::uint64_t compared = 0;
  for (std::uint64_t i = 0; i < rays; ++i) {
    const Point3 origin{5, draw.between(0.2, 1.8), draw.between(-0.4, 0.4)};
    ShapeHit level;
    ASSERT_TRUE(intersect(vase, Ray{origin, {-1, 0, 0}}, level));
    for (int k = 1; k <= 18; ++k) {
      for (const double sign : {-1.0, 1.0}) {
        // The height of the hit moves by dy t, t by that over the slope of the surface, at
        // most 2.5.
        const double dy = sign * pow(10.0, -k);
        ShapeHit hit;
        const bool got = intersect(vase, Ray{origin, {-1, dy, 0}}, hit);
        if (k < 3) continue;
        ASSERT_TRUE(got) << k;
        ++compared;
        worst =
            std::fmax(worst, (std::fabs(hit.t - level.t)) / std::fmax(25 * std::fabs(dy), 1e-9));
      }
    }
  }
  EXPECT_LE(worst, 1);
  record({"R05", "d_y = ±10^-k, k = 3..18, against d_y = 0", compared,
          short_number(worst) + " of the bound", ""});
}

TEST(R08, TangentsAreDecidedBeyondTheirTolerance) {
  constexpr std::uint64_t rays = 20'000;
  Draw draw(8);
  const Revolve revolve(bezier_profile(quadrics()[0].profile));
  for (const double k : {-1024.0, -64.0, -4.0, -1.0, 1.0, 4.0, 64.0, 1024.0}) {
    std::uint64_t hit = 0;
    for (std::uint64_t i = 0; i < rays; ++i) {
      // Along z at distance x of the axis: the closest approach is exact.
      const double x = 1.5 * (1 + k * 1e-15);
      const Ray ray{{x, draw.between(0.1, 1.9), -draw.between(1, 4)}, {0, 0, 1}};
      ShapeHit out;
      if (intersect(revolve, ray, out)) ++hit;
    }
    // 4 gamma(16) of profile and origin is 5e-14 here: k = 64 is beyond it, 1 and 4 are within.
    if (k <= -64) {
      EXPECT_EQ(hit, rays) << k;
    }
    if (k >= 64) {
      EXPECT_EQ(hit, 0U) << k;
    }
    record({"R08", fmt::format("r (1 + {:g}e-15)", k), rays, percent(hit, rays) + " hit", ""});
  }
}

TEST(R09, PolesHaveTheirNormals) {
  const Revolve drop(bezier_profile(Points{{0, 0}, {1, 0}, {1, 1.2}, {0, 1.2}}));
  const Ray axis{{0, -1, 0}, {0, 1, 0}};
  std::vector<ShapeHit> hits;
  intersect_all(drop, axis, hits);
  ASSERT_EQ(hits.size(), 2U);
  EXPECT_NEAR(hits[0].t, 1, 1e-13);
  EXPECT_NEAR(hits[1].t, 2.2, 1e-13);
  EXPECT_LT(normalized(surface(drop, axis, hits[0]).geometric_normal).y(), -0.999999);
  EXPECT_GT(normalized(surface(drop, axis, hits[1]).geometric_normal).y(), 0.999999);
  constexpr std::uint64_t rays = 100'000;
  Draw draw(9);
  std::uint64_t bad = 0;
  std::uint64_t newton_missed = 0;
  double tilt = 0;
  for (std::uint64_t i = 0; i < rays; ++i) {
    const double angle = draw.between(0, 2 * pi);
    const double rho = draw.power_of_ten(-300, -12);
    const Ray near{{rho * cos(angle), -1, rho * sin(angle)}, {0, 1, 0}};
    intersect_all(drop, near, hits);
    if (hits.size() != 2) {
      ++bad;
      continue;
    }
    for (const ShapeHit& h : hits) {
      const Surface s = surface(drop, near, h);
      if (!is_finite(s.point) || !is_finite(s.dp_du) || !is_finite(s.dp_dv)) ++bad;
      tilt = std::fmax(tilt, 1 - std::fabs(normalized(s.geometric_normal).y()));
    }
    ShapeHit newton;
    if (!intersect_by_newton(drop, near, newton)) ++newton_missed;
  }
  EXPECT_EQ(bad, 0U);
  EXPECT_LE(tilt, 1e-9);
  record({"R09", "rays within 1e-12 of the axis, down to 1e-300", rays,
          fmt::format("{} bad; normals tilt by 1 - cos = {}", bad, short_number(tilt)),
          "Newton misses " + percent(newton_missed, rays)});
}

TEST(R16, NormalsAreThoseOfTheClosedForm) {
  constexpr int rays = 100'080;
  double worst = 0;
  double turned = 0;
  const Revolve cone(bezier_profile(quadrics()[1].profile));
  const double slope = 0.75;
  const double k = 1 / std::sqrt(1 + slope * slope);
  Draw draw(16);
  double reference = 0;
  for (int i = 0; i < rays; ++i) {
    const double angle = 2 * pi * (i % 360) / 360;
    const double height = i % 360 == 0 ? draw.between(0.1, 1.9) : reference;
    reference = height;
    const Ray ray{{5 * cos(angle), height, 5 * sin(angle)}, {-cos(angle), 0, -sin(angle)}};
    ShapeHit hit;
    ASSERT_TRUE(intersect(cone, ray, hit));
    const Surface s = surface(cone, ray, hit);
    const UnitVector3 n = normalized(s.geometric_normal);
    const Vector3 want{k * cos(angle), -k * slope, k * sin(angle)};
    worst = std::fmax(worst, length(cross(n, want)));
    turned = std::fmax(turned, std::fabs(n.y() + k * slope));
    ASSERT_GT(dot(cross(s.dp_du, s.dp_dv), n), 0);
  }
  EXPECT_LE(worst, 1e-9);
  EXPECT_LE(turned, 8 * unit_roundoff);
  record({"R16", "a cone, 360 angles", rays,
          fmt::format("{} rad; the part along the axis varies by {} u", short_number(worst),
                      short_number(turned / unit_roundoff)),
          ""});
}

TEST(R19, RaysWithinTheSurfaceEnd) {
  constexpr std::uint64_t rays = 500;  // each takes all 4096 pieces
  Draw draw(19);
  const Revolve cylinder(bezier_profile(quadrics()[0].profile));
  const Revolve flat(bezier_profile(quadrics()[3].profile));
  std::uint64_t wild = 0;
  std::uint64_t hit = 0;
  std::size_t most = 0;
  std::vector<ShapeHit> hits;
  for (std::uint64_t i = 0; i < rays; ++i) {
    // A line of the cylinder's wall, and a level ray in the disk.
    const double angle = draw.between(0, 2 * pi);
    const bool wall = i % 2 == 0;
    const Ray ray = wall ? Ray{{1.5 * cos(angle), -1, 1.5 * sin(angle)}, {0, 1, 0}}
                         : Ray{{-4 * cos(angle), 1, -4 * sin(angle)}, {cos(angle), 0, sin(angle)}};
    intersect_all(wall ? cylinder : flat, ray, hits);
    most = std::max(most, hits.size());
    if (!hits.empty()) ++hit;
    const double low = wall ? 1 : 2.5;
    const double high = wall ? 3 : 5.5;
    for (const ShapeHit& h : hits)
      if (!(h.t >= low - 1e-9 && h.t <= high + 1e-9)) ++wild;
  }
  EXPECT_EQ(wild, 0U);
  record({"R19", "along the wall of a cylinder, across a disk", rays,
          fmt::format("{} hit, {} elsewhere than in the surface; at most {} points a ray",
                      percent(hit, rays), wild, most),
          ""});
}

}  // namespace
}  // namespace scenec::numerics
