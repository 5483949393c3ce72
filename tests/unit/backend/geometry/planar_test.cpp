// Planes, quads and disks: parallel rays, rims, closed edges, orientation (G09-G11).
#include <gtest/gtest.h>

#include <cmath>

#include "backend/geometry/disk.hpp"
#include "backend/geometry/plane.hpp"
#include "backend/geometry/quad.hpp"
#include "tests/unit/backend/geometry/random_rays.hpp"

namespace scenec::backend {
namespace {

using testing_support::Draw;

TEST(Plane, PointsLieOnIt) {
  Draw draw(1);
  for (int i = 0; i < 10000; ++i) {
    const UnitVector3 n = draw.direction();
    const Plane plane{as_normal(n), draw.between(-5, 5)};
    const Ray ray{draw.point(1e6), draw.direction()};
    ShapeHit hit;
    if (!intersect(plane, ray, hit)) continue;
    const Surface s = surface(plane, ray, hit);
    const double off = std::fabs(dot(n, as_vector(s.point)) - plane.offset);
    EXPECT_LE(off, dot(abs(n), s.error)) << i;
  }
}

TEST(Quad, InsideOutsideAndCoordinates) {
  const Quad quad{{1, 1, 0}, {2, 0, 0}, {1, 3, 0}};
  Draw draw(2);
  for (int i = 0; i < 20000; ++i) {
    const double u = draw.between(-0.2, 1.2);
    const double v = draw.between(-0.2, 1.2);
    const Point3 target = quad.corner + u * quad.edge_u + v * quad.edge_v;
    const Point3 origin{draw.between(-5, 5), draw.between(-5, 5), draw.between(1, 5)};
    ShapeHit hit;
    const bool inside = u > 0 && u < 1 && v > 0 && v < 1;
    ASSERT_EQ(intersect(quad, Ray{origin, target - origin}, hit), inside);
    if (!inside) continue;
    EXPECT_NEAR(hit.t, 1, 1e-14);
    EXPECT_NEAR(hit.a, u, 1e-13);
    EXPECT_NEAR(hit.b, v, 1e-13);
  }
  const Surface s = surface(quad, {}, {});
  EXPECT_GT(s.geometric_normal.z, 0);
}

TEST(Quad, SharedEdgesDoNotLeak) {
  // Four quads around a vertex; rays aimed at the shared edges.
  const Quad quads[4] = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                         {{0, 0, 0}, {0, 1, 0}, {-1, 0, 0}},
                         {{0, 0, 0}, {-1, 0, 0}, {0, -1, 0}},
                         {{0, 0, 0}, {0, -1, 0}, {1, 0, 0}}};
  Draw draw(3);
  for (int i = 0; i < 100000; ++i) {
    const double along = draw.between(-1, 1);
    const Point3 target = i % 2 == 0 ? Point3{along, 0, 0} : Point3{0, along, 0};
    const Point3 origin = draw.point(7) + Vector3{0, 0, 10};
    bool any = false;
    ShapeHit hit;
    for (const Quad& q : quads) any = any || intersect(q, Ray{origin, target - origin}, hit);
    ASSERT_TRUE(any) << i;
  }
}

TEST(Disk, RimAndOrientation) {
  const Disk disk{{0, 0, 2}, UnitVector3::assume_unit({0, 0, 1}), 1.5};
  ShapeHit hit;
  EXPECT_TRUE(intersect(disk, Ray{{1.5, 0, 0}, {0, 0, 1}}, hit));
  EXPECT_EQ(hit.t, 2);
  EXPECT_FALSE(intersect(disk, Ray{{next_up(1.5), 0, 0}, {0, 0, 1}}, hit));
  EXPECT_FALSE(intersect(disk, Ray{{0, 0, 2}, {1, 0, 0}}, hit));
  const Surface s = surface(disk, Ray{{0.5, 0.5, 0}, {0, 0, 1}}, {2, 0, 0, 0});
  EXPECT_GT(dot(cross(s.dp_du, s.dp_dv), {0, 0, 1}), 0);
  const Bounds3 b = bounds(disk);
  EXPECT_LE(b.min.x, -1.5);
  EXPECT_LT(b.max.z - b.min.z, 1e-6);
}

}  // namespace
}  // namespace scenec::backend
