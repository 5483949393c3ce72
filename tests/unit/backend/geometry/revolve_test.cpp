// Surfaces of revolution against closed forms, level and axis-parallel rays among them (R01-R06,
// R08, R09, R13, R16, R17, R19).
#include "backend/geometry/revolve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "tests/unit/backend/geometry/random_rays.hpp"

namespace scenec::backend {
namespace {

using testing_support::Draw;
using Points = std::vector<ProfilePoint>;

// rho^2 = a h^2 + b h + c on h in [0, 2], as a cubic that parametrises it exactly.
struct Quadric {
  const char* name;
  Points profile;
  double a;
  double b;
  double c;
};

const std::array<Quadric, 3>& quadrics() {
  static const std::array<Quadric, 3> all{{
      {"cylinder", {{1.5, 0}, {1.5, 2.0 / 3}, {1.5, 4.0 / 3}, {1.5, 2}}, 0, 0, 2.25},
      {"cone", {{0, 0}, {0.5, 2.0 / 3}, {1, 4.0 / 3}, {1.5, 2}}, 0.5625, 0, 0},
      // rho = s, h = 2 s^2: a pole with horizontal tangent.
      {"paraboloid", {{0, 0}, {1.0 / 3, 0}, {2.0 / 3, 2.0 / 3}, {1, 2}}, 0, 0.5, 0},
  }};
  return all;
}

struct Roots {
  std::vector<double> t;
  bool unsure = false;  // tangent or at a rim, where rounding decides
};

Roots closed_form(const Quadric& q, const Ray& ray) {
  const long double ox = ray.origin.x, oy = ray.origin.y, oz = ray.origin.z;
  const long double dx = ray.direction.x, dy = ray.direction.y, dz = ray.direction.z;
  const long double a = dx * dx + dz * dz - q.a * dy * dy;
  const long double b = 2 * (ox * dx + oz * dz) - 2 * q.a * oy * dy - q.b * dy;
  const long double c = ox * ox + oz * oz - q.a * oy * oy - q.b * oy - q.c;
  std::vector<long double> t;
  Roots out;
  if (std::fabs(a) < 1e-14L) {
    if (b != 0) t.push_back(-c / b);
  } else {
    const long double d = b * b - 4 * a * c;
    if (std::fabs(d) < 1e-8L * (b * b + std::fabs(4 * a * c))) out.unsure = true;
    if (d >= 0) {
      const long double r = -(b + (b < 0 ? -std::sqrt(d) : std::sqrt(d))) / 2;
      t.push_back(r / a);
      if (r != 0) t.push_back(c / r);
    }
  }
  for (const long double v : t) {
    const long double h = oy + v * dy;
    if (std::fabs(h) < 1e-9L || std::fabs(h - 2) < 1e-9L) out.unsure = true;
    if (h >= 0 && h <= 2 && v >= ray.t_min) out.t.push_back(static_cast<double>(v));
    if (std::fabs(v) < 1e-9L) out.unsure = true;
  }
  std::sort(out.t.begin(), out.t.end());
  return out;
}

using MakeRay = std::function<Ray(Draw&)>;

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

const std::vector<std::pair<const char*, MakeRay>>& ray_kinds() {
  static const std::vector<std::pair<const char*, MakeRay>> all{
      {"generic", [](Draw& d) { return aimed(d, -1); }},
      {"nearly level", [](Draw& d) { return aimed(d, 5e-5); }},
      {"very nearly level", [](Draw& d) { return aimed(d, 1e-15); }},
      {"level", [](Draw& d) { return aimed(d, 0); }},
      {"along the axis",
       [](Draw& d) { return Ray{{d.between(-1.4, 1.4), -3, d.between(-0.4, 0.4)}, {0, 1, 0}}; }},
      {"from inside",
       [](Draw& d) {
         return Ray{{d.between(-0.1, 0.1), d.between(0.5, 1.5), 0.05}, d.direction()};
       }},
      {"through the axis",
       [](Draw& d) { return Ray{{3, d.between(0, 2), 0}, {-1, d.between(-0.3, 0.3), 0}}; }},
      {"long direction",
       [](Draw& d) {
         Ray r = aimed(d, -1);
         r.direction = 1e20 * r.direction;
         return r;
       }},
  };
  return all;
}

TEST(Revolve, QuadricsMatchTheirClosedForms) {
  for (const Quadric& q : quadrics()) {
    const Revolve revolve(bezier_profile(q.profile));
    for (const auto& [kind, make] : ray_kinds()) {
      Draw draw(17);
      int missed = 0;
      int extra = 0;
      int inexact = 0;
      int total = 0;
      std::vector<ShapeHit> hits;
      for (int i = 0; i < 4000; ++i) {
        const Ray ray = make(draw);
        const Roots want = closed_form(q, ray);
        if (want.unsure) continue;
        intersect_all(revolve, ray, hits);
        total += static_cast<int>(want.t.size());
        if (hits.size() < want.t.size()) ++missed;
        if (hits.size() > want.t.size()) ++extra;
        if (hits.size() != want.t.size()) continue;
        for (std::size_t k = 0; k < hits.size(); ++k)
          if (std::fabs(hits[k].t - want.t[k]) > 1e-10 * std::fabs(want.t[k])) ++inexact;
        ShapeHit first;
        ASSERT_EQ(intersect(revolve, ray, first), !want.t.empty());
        if (!want.t.empty() && std::fabs(first.t - want.t[0]) > 1e-10 * std::fabs(want.t[0]))
          ++inexact;
      }
      EXPECT_EQ(missed, 0) << q.name << ", " << kind << " of " << total;
      EXPECT_EQ(extra, 0) << q.name << ", " << kind << " of " << total;
      EXPECT_LE(inexact, total / 500)
          << q.name << ", " << kind << " of " << total;  // nearly tangent ones
    }
  }
}

TEST(Revolve, LevelRaysAreTheLimitOfSlopingOnes) {
  const Revolve vase(bezier_profile(Points{{1, 0}, {2, 0.7}, {0.2, 1.3}, {1, 2}}));
  ShapeHit level;
  ASSERT_TRUE(intersect(vase, Ray{{5, 0.8, 0.3}, {-1, 0, 0}}, level));
  for (int k = 10; k <= 18; ++k) {
    ShapeHit hit;
    ASSERT_TRUE(intersect(vase, Ray{{5, 0.8, 0.3}, {-1, std::pow(10.0, -k), 0}}, hit)) << k;
    EXPECT_NEAR(hit.t, level.t, 1e-8) << k;
  }
}

TEST(Revolve, AxisRayHitsPolesWithTheirNormals) {
  const Revolve drop(bezier_profile(Points{{0, 0}, {1, 0}, {1, 1.2}, {0, 1.2}}));
  std::vector<ShapeHit> hits;
  const Ray ray{{0, -1, 0}, {0, 1, 0}};
  intersect_all(drop, ray, hits);
  ASSERT_EQ(hits.size(), 2U);
  EXPECT_NEAR(hits[0].t, 1, 1e-13);
  EXPECT_NEAR(hits[1].t, 2.2, 1e-13);
  EXPECT_LT(normalized(surface(drop, ray, hits[0]).geometric_normal).y(), -0.999999);
  EXPECT_GT(normalized(surface(drop, ray, hits[1]).geometric_normal).y(), 0.999999);
  for (int i = 0; i < 360; ++i) {
    const double angle = 2 * pi * i / 360;
    const Ray near{{1e-12 * cos(angle), -1, 1e-12 * sin(angle)}, {0, 1, 0}};
    ShapeHit hit;
    ASSERT_TRUE(intersect(drop, near, hit));
    const Surface s = surface(drop, near, hit);
    EXPECT_TRUE(is_finite(s.point) && is_finite(as_vector(s.geometric_normal)) &&
                is_finite(s.dp_du));
  }
}

TEST(Revolve, NormalsAreThoseOfASphereLikeProfile) {
  const Revolve cone(bezier_profile(quadrics()[1].profile));
  const double slope = 0.75;
  for (int i = 0; i < 360; ++i) {
    const double angle = 2 * pi * i / 360;
    const Ray ray{{5 * cos(angle), 1, 5 * sin(angle)}, {-cos(angle), 0, -sin(angle)}};
    ShapeHit hit;
    ASSERT_TRUE(intersect(cone, ray, hit));
    const Surface s = surface(cone, ray, hit);
    const UnitVector3 n = normalized(s.geometric_normal);
    const double k = 1 / std::sqrt(1 + slope * slope);
    EXPECT_NEAR(n.x(), k * cos(angle), 1e-12);
    EXPECT_NEAR(n.y(), -k * slope, 1e-12);
    EXPECT_NEAR(n.z(), k * sin(angle), 1e-12);
    EXPECT_GT(dot(cross(s.dp_du, s.dp_dv), n), 0);
  }
}

TEST(Revolve, OtherAxesAreRotations) {
  const Points points{{1, 0}, {2, 0.7}, {0.2, 1.3}, {1, 2}};
  const Revolve about_y(bezier_profile(points), Axis::y);
  const Revolve about_x(bezier_profile(points), Axis::x);
  const Revolve about_z(bezier_profile(points), Axis::z);
  Draw draw(5);
  for (int i = 0; i < 2000; ++i) {
    const Point3 o = draw.point(5);
    const Vector3 d = draw.direction();
    ShapeHit y;
    ShapeHit x;
    ShapeHit z;
    const bool got = intersect(about_y, Ray{o, d}, y);
    EXPECT_EQ(intersect(about_x, Ray{{o.y, o.z, o.x}, {d.y, d.z, d.x}}, x), got);
    EXPECT_EQ(intersect(about_z, Ray{{o.z, o.x, o.y}, {d.z, d.x, d.y}}, z), got);
    if (!got) continue;
    EXPECT_EQ(x.t, y.t);
    EXPECT_EQ(z.t, y.t);
  }
}

TEST(Revolve, NegativeRadiiCountAsTheirAbsoluteValue) {
  const Revolve positive(bezier_profile(Points{{1, 0}, {2, 0.7}, {0.2, 1.3}, {1, 2}}));
  const Revolve negative(bezier_profile(Points{{-1, 0}, {-2, 0.7}, {-0.2, 1.3}, {-1, 2}}));
  Draw draw(6);
  for (int i = 0; i < 2000; ++i) {
    const Ray ray{draw.point(5), draw.direction()};
    ShapeHit a;
    ShapeHit b;
    const bool got = intersect(positive, ray, a);
    ASSERT_EQ(intersect(negative, ray, b), got);
    if (!got) continue;
    EXPECT_EQ(a.t, b.t);
    EXPECT_EQ(surface(positive, ray, a).geometric_normal,
              surface(negative, ray, b).geometric_normal);
  }
}

TEST(Revolve, SplineSpansDoNotLeakAtKnots) {
  const Points points{{0.5, 0}, {1.5, 0.5}, {0.5, 1}, {1.5, 1.5}, {0.7, 2}, {1, 2.5}};
  for (const SplineEnds ends : {SplineEnds::clamped, SplineEnds::uniform}) {
    const Profile profile = bspline_profile(points, ends);
    ASSERT_EQ(profile.size(), 3U);
    const Revolve revolve(profile);
    for (std::size_t i = 1; i < profile.size(); ++i) {
      const ProfilePoint knot = profile.segment(i)[0];
      EXPECT_EQ(knot.height, profile.segment(i - 1)[3].height);
      for (int k = -20; k <= 20; ++k) {
        const double y = knot.height * (1 + k * 0x1p-52);
        ShapeHit hit;
        EXPECT_TRUE(intersect(revolve, Ray{{0, y, 0}, {1, 0, 0}}, hit)) << k;
        EXPECT_TRUE(intersect(revolve, Ray{{4, y, 0.1}, {-1, 0, 0}}, hit)) << k;
      }
    }
  }
}

TEST(Revolve, ClampedSplinesReachTheirEnds) {
  const Points points{{0.5, 0}, {1.5, 0.5}, {0.5, 1}, {1.5, 1.5}};
  const Profile p = bspline_profile(points, SplineEnds::clamped);
  ASSERT_EQ(p.size(), 1U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(p.segment(0)[i].radius, points[i].radius, 1e-15);
    EXPECT_NEAR(p.segment(0)[i].height, points[i].height, 1e-15);
  }
  const Profile u = bspline_profile(points, SplineEnds::uniform);
  EXPECT_NEAR(u.segment(0)[0].radius, (0.5 + 4 * 1.5 + 0.5) / 6, 1e-15);
}

TEST(Revolve, PowersOfTwoScaleExactly) {
  const Points points{{1, 0}, {2, 0.7}, {0.2, 1.3}, {1, 2}};
  const Revolve revolve(bezier_profile(points));
  Draw draw(7);
  for (int i = 0; i < 1000; ++i) {
    const Ray ray{draw.point(5), draw.direction()};
    ShapeHit hit;
    const bool got = intersect(revolve, ray, hit);
    for (const int k : {-20, 20}) {
      const double s = std::ldexp(1.0, k);
      Points scaled = points;
      for (ProfilePoint& p : scaled) p = {s * p.radius, s * p.height};
      ShapeHit other;
      ASSERT_EQ(intersect(Revolve(bezier_profile(scaled)),
                          Ray{as_point(s * as_vector(ray.origin)), ray.direction}, other),
                got);
      if (got) {
        EXPECT_EQ(other.t, s * hit.t);
      }
    }
  }
}

TEST(Revolve, DegenerateProfilesEnd) {
  std::vector<ShapeHit> hits;
  // A ray lying in the wall of a cylinder.
  intersect_all(Revolve(bezier_profile(quadrics()[0].profile)), Ray{{1.5, -1, 0}, {0, 1, 0}}, hits);
  for (const ShapeHit& h : hits) EXPECT_TRUE(h.t >= 1 - 1e-9 && h.t <= 3 + 1e-9);
  ShapeHit hit;
  const Ray ray{{0.3, -1, 0.4}, {0, 1, 0}};
  for (const Points& p :
       {Points{{1, 1}, {1, 1}, {1, 1}}, Points{{0, 0}, {0, 0}, {1, 0}, {1, 1}},
        Points{{0, 1}, {1, 1}}, Points{{0.5, 0}, {0.5, 2}}, Points{{0, 0}, {0, 1}}}) {
    const Revolve revolve(bezier_profile(p));
    if (intersect(revolve, ray, hit)) {
      EXPECT_TRUE(is_finite(as_vector(surface(revolve, ray, hit).geometric_normal)));
    }
  }
  // A flat annulus.
  ASSERT_TRUE(intersect(Revolve(bezier_profile(Points{{0, 1}, {1, 1}})), ray, hit));
  EXPECT_NEAR(hit.t, 2, 1e-14);
}

TEST(Revolve, RootsSayWhetherTheyAreCertified) {
  const Points points{{1, 0}, {2, 0.7}, {0.2, 1.3}, {1, 2}};
  const Revolve vase(bezier_profile(points));
  const Revolve by_newton(bezier_profile(points), Axis::y, RootFinder::newton);
  Draw draw(31);
  int certified = 0;
  int guessed = 0;
  for (int i = 0; i < 4000; ++i) {
    const Ray ray = ray_kinds()[static_cast<std::size_t>(i) % ray_kinds().size()].second(draw);
    ShapeHit hit;
    if (intersect(vase, ray, hit)) {
      ++certified;
      EXPECT_TRUE(is_certified(hit)) << i;
    }
    if (intersect(by_newton, ray, hit)) {
      ++guessed;
      EXPECT_FALSE(is_certified(hit)) << i;
    }
  }
  EXPECT_GT(certified, 2000);
  EXPECT_GT(guessed, 1000);
}

TEST(Revolve, RootsThatNoPieceProvesAreNotCertified) {
  const Revolve cylinder(bezier_profile(quadrics()[0].profile));
  const Ray touching{{1.5, 1, -5}, {0, 0, 1}};  // one point: the pieces become too narrow
  const Ray within{{1.5, -1, 0}, {0, 1, 0}};    // a whole line: they run out, too
  const Ray through{{1.4, 1, -5}, {0, 0, 1}};
  std::vector<ShapeHit> hits;
  for (const auto& [ray, proven] :
       {std::pair{touching, false}, std::pair{within, false}, std::pair{through, true}}) {
    ShapeHit hit;
    ASSERT_TRUE(intersect(cylinder, ray, hit));
    EXPECT_EQ(is_certified(hit), proven);
    intersect_all(cylinder, ray, hits);
    ASSERT_FALSE(hits.empty());
    for (const ShapeHit& h : hits) EXPECT_EQ(is_certified(h), proven);
  }
}

}  // namespace
}  // namespace scenec::backend
