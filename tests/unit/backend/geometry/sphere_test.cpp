// Spheres from near, far, inside and along the tangent (G01-G06, G09, G25).
#include "backend/geometry/sphere.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "backend/math/frame.hpp"
#include "tests/unit/backend/geometry/random_rays.hpp"

namespace scenec::backend {
namespace {

using testing_support::Draw;

struct Oracle {
  bool hit;
  long double t;
  long double h;
};

// The first root of the rounded inputs in long double, by the closest approach.
Oracle oracle_of(const Sphere& s, const Ray& ray) {
  const long double x = static_cast<long double>(ray.origin.x) - s.center.x;
  const long double y = static_cast<long double>(ray.origin.y) - s.center.y;
  const long double z = static_cast<long double>(ray.origin.z) - s.center.z;
  const long double dx = ray.direction.x;
  const long double dy = ray.direction.y;
  const long double dz = ray.direction.z;
  const long double a = dx * dx + dy * dy + dz * dz;
  const long double b = -(x * dx + y * dy + z * dz);
  const long double mx = x + b / a * dx;
  const long double my = y + b / a * dy;
  const long double mz = z + b / a * dz;
  const long double h = std::sqrt(mx * mx + my * my + mz * mz);
  if (h > s.radius) return {false, 0, h};
  return {true, (b - std::sqrt(a * (s.radius - h) * (s.radius + h))) / a, h};
}

void expect_far_rays_right(double distance, double radius, std::uint64_t seed) {
  Draw draw(seed);
  int wrong = 0;
  int bad_t = 0;
  for (int i = 0; i < 50000; ++i) {
    const Frame f = frame_about(draw.direction());
    const double angle = draw.between(0, 2 * pi);
    const double off = 1.2 * radius * draw.unit();
    const Point3 target = as_point(off * (cos(angle) * f.x.vector() + sin(angle) * f.y.vector()));
    const Point3 origin = as_point(distance * f.z.vector());
    const Sphere sphere{{0, 0, 0}, radius};
    const Ray ray{origin, normalized(target - origin)};
    const Oracle want = oracle_of(sphere, ray);
    ShapeHit hit;
    const bool got = intersect(sphere, ray, hit);
    const double near_rim =
        static_cast<double>(std::fabs(want.h - static_cast<long double>(radius)));
    if (near_rim <= 4 * unit_roundoff * distance) continue;
    if (got != want.hit) ++wrong;
    if (!got || !want.hit) continue;
    const double depth =
        std::sqrt((radius - static_cast<double>(want.h)) * (radius + static_cast<double>(want.h)));
    const double bound = 8 * unit_roundoff * distance / depth * static_cast<double>(want.t);
    if (std::fabs(hit.t - static_cast<double>(want.t)) > bound) ++bad_t;
  }
  EXPECT_EQ(wrong, 0) << distance;
  EXPECT_EQ(bad_t, 0) << distance;
}

TEST(Sphere, FarAwayAgreesWithLongDouble) {
  for (const double distance : {1e2, 1e4, 1e6, 1e8}) expect_far_rays_right(distance, 1, 1);
}

TEST(Sphere, TinyAgreesWithLongDouble) {
  for (const double radius : {1e-3, 1e-6, 1e-12}) expect_far_rays_right(1, radius, 2);
}

TEST(Sphere, TangentIsDecidedExactly) {
  for (int k = -4; k <= 4; ++k) {
    ShapeHit hit;
    const bool got = intersect(Sphere{{0, 0, 0}, 1}, Ray{{1 + k * 0x1p-52, 0, -5}, {0, 0, 1}}, hit);
    if (k != 0) {
      EXPECT_EQ(got, k < 0) << k;
    }
    if (got) {
      EXPECT_NEAR(hit.t, 5, 5 * std::sqrt(unit_roundoff));
    }
  }
}

TEST(Sphere, FromInside) {
  ShapeHit hit;
  const Sphere sphere{{0, 0, 0}, 3};
  ASSERT_TRUE(intersect(sphere, Ray{{0, 0, 0}, normalized(Vector3{1, 2, 3})}, hit));
  EXPECT_NEAR(hit.t, 3, 3 * 0x1p-52);
  const double cosine = 1e-6;
  const Ray grazing{{3, 0, 0}, {-cosine, std::sqrt(1 - cosine * cosine), 0}, next_up(0)};
  ASSERT_TRUE(intersect(sphere, grazing, hit));
  EXPECT_NEAR(hit.t / (2 * 3 * cosine), 1, 4 * unit_roundoff / cosine);
}

TEST(Sphere, PowersOfTwoScaleExactly) {
  Draw draw(3);
  for (int i = 0; i < 2000; ++i) {
    const Sphere sphere{draw.point(4), draw.between(0.1, 3)};
    const Ray ray{draw.point(10), draw.direction()};
    ShapeHit hit;
    const bool got = intersect(sphere, ray, hit);
    for (const int k : {-40, -1, 7, 40}) {
      const double s = std::ldexp(1.0, k);
      const Sphere scaled{as_point(s * as_vector(sphere.center)), s * sphere.radius};
      ShapeHit other;
      EXPECT_EQ(intersect(scaled, Ray{as_point(s * as_vector(ray.origin)), ray.direction}, other),
                got);
      if (got) {
        EXPECT_EQ(other.t, s * hit.t);
      }
    }
  }
}

TEST(Sphere, DyadicTranslationKeepsTheBits) {
  Draw draw(4);
  for (int i = 0; i < 2000; ++i) {
    const auto dyadic = [&] { return std::floor(draw.between(-4096, 4096)) / 1024; };
    const Sphere sphere{{dyadic(), dyadic(), dyadic()}, 1.5};
    const Ray ray{{dyadic(), dyadic(), dyadic()}, draw.direction()};
    const Vector3 shift{0x1p20, -0x1p20, 0x1p20};
    ShapeHit a;
    ShapeHit b;
    const bool got = intersect(sphere, ray, a);
    EXPECT_EQ(
        intersect(Sphere{sphere.center + shift, 1.5}, Ray{ray.origin + shift, ray.direction}, b),
        got);
    if (got) {
      EXPECT_EQ(a.t, b.t);
    }
  }
}

TEST(Sphere, DirectionsOfAnyLength) {
  const Sphere sphere{{0, 0, 5}, 1};
  for (const double length : {1e-300, 1e-20, 1.0, 1e20, 1e300}) {
    ShapeHit hit;
    ASSERT_TRUE(intersect(sphere, Ray{{0, 0, 0}, {0, 0, length}}, hit)) << length;
    EXPECT_NEAR(hit.t * length, 4, 4 * 0x1p-52);
  }
}

TEST(Sphere, IntervalIsClosed) {
  const Sphere sphere{{0, 0, 5}, 1};
  ShapeHit hit;
  EXPECT_TRUE(intersect(sphere, Ray{{0, 0, 0}, {0, 0, 1}, 0, 4}, hit));
  EXPECT_FALSE(intersect(sphere, Ray{{0, 0, 0}, {0, 0, 1}, 0, next_down(4)}, hit));
  EXPECT_TRUE(intersect(sphere, Ray{{0, 0, 0}, {0, 0, 1}, 6, 9}, hit));
  EXPECT_EQ(hit.t, 6);
  EXPECT_FALSE(intersect(sphere, Ray{{0, 0, 0}, {0, 0, 1}, next_up(6), 9}, hit));
}

TEST(Sphere, ConcentricGapsAreOrdered) {
  for (const double gap : {1e-3, 4e-5, 1e-6, 1e-9}) {
    std::vector<double> t;
    for (const double r : {1.0, 1.0 - gap}) {
      ShapeHit hit;
      Ray ray{{0, 0, -3}, {0, 0, 1}};
      ASSERT_TRUE(intersect(Sphere{{0, 0, 0}, r}, ray, hit));
      t.push_back(hit.t);
    }
    EXPECT_NEAR(t[1] - t[0], gap, 16 * unit_roundoff);
  }
}

TEST(Sphere, GroundSphereKeepsItsPoints) {
  const Sphere ground{{0, -1e9, 0}, 1e9};
  Draw draw(5);
  for (int i = 0; i < 10000; ++i) {
    const Ray ray{{draw.between(-10, 10), 2, draw.between(-10, 10)},
                  {draw.between(-1, 1), -1, draw.between(-1, 1)}};
    ShapeHit hit;
    ASSERT_TRUE(intersect(ground, ray, hit));
    const Surface s = surface(ground, ray, hit);
    EXPECT_LE(std::fabs(distance(s.point, ground.center) - 1e9),
              2 * (std::nextafter(1e9, 2e9) - 1e9));
  }
}

TEST(Sphere, SurfaceCoordinates) {
  const Sphere sphere{{1, 2, 3}, 2};
  const auto at = [&](Vector3 d) {
    const Ray ray{sphere.center, d};
    ShapeHit hit;
    EXPECT_TRUE(intersect(sphere, ray, hit));
    return surface(sphere, ray, hit);
  };
  EXPECT_EQ(at({1, 0, 0}).u, 0);
  EXPECT_EQ(at({0, 0, -1}).u, 0.25);  // counter-clockwise seen from the tip of y
  EXPECT_EQ(at({-1, 0, 0}).u, 0.5);
  EXPECT_EQ(at({0, 0, 1}).u, 0.75);
  EXPECT_EQ(at({0, 1, 0}).v, 1);
  EXPECT_EQ(at({0, -1, 0}).v, 0);
  const Surface s = at({1, 1, 1});
  EXPECT_GT(dot(cross(s.dp_du, s.dp_dv), as_vector(s.geometric_normal)), 0);
  for (const Vector3& pole : {Vector3{0, 1, 0}, Vector3{0, -1, 0}})
    EXPECT_TRUE(is_finite(at(pole).dp_dv));
}

}  // namespace
}  // namespace scenec::backend
