// Small worlds tested without a tree give the bits of brute force by the shapes' own kernels, on
// every instruction set, alone and beside a tree.
#include "backend/accel/flat_items.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "backend/accel/scene_accel.hpp"
#include "backend/accel/target.hpp"
#include "backend/math/rng.hpp"
#include "backend/math/sampling.hpp"

namespace scenec::backend {
namespace {

double draw(std::uint64_t i, std::uint32_t what) {
  return 4 * random_unit(9, i, 0, what) - 2;
}
Vector3 vector(std::uint64_t i, std::uint32_t what) {
  return {draw(i, what), draw(i, what + 1), draw(i, what + 2)};
}

// `others`: boxes, which need a tree.
void fill(SceneAccel& world, std::uint32_t count, int others) {
  for (std::uint32_t i = 0; i < count; ++i) {
    const Point3 at = as_point(vector(i, 0));
    switch (i % 4) {
      case 0:
        world.add(i, Sphere{at, 0.3 + (i % 3) * 0.4});
        break;
      case 1:
        world.add(i, Quad{at, vector(i, 3), vector(i, 6)});
        break;
      case 2:
        world.add(i, Disk{at, normalized(vector(i, 3)), 0.8});
        break;
      default:
        world.add(i, Plane{as_normal(vector(i, 3)), 3 * draw(i, 6)});
        break;
    }
  }
  // Twice the same wall: the smaller number is met.
  world.add(count + 1, Quad{{-2, -2, -2}, {4, 0, 0}, {0, 0, 4}});
  world.add(count, Quad{{-2, -2, -2}, {4, 0, 0}, {0, 0, 4}});
  for (int i = 0; i < others; ++i) {
    const Point3 at = as_point(vector(static_cast<std::uint64_t>(i), 20));
    world.add(100 + static_cast<std::uint32_t>(i), Box{at, at + Vector3{0.3, 0.4, 0.5}});
  }
}

TEST(FlatItems, HaveTheBitsOfBruteForce) {
  ThreadPool pool(1);
  for (const Target target : available_targets())
    for (const int others : {0, 9})
      for (const std::uint32_t count : {1U, 4U, 9U, 30U}) {
        SceneAccel world;
        fill(world, count, others);
        world.build(pool, target);
        int hits = 0;
        for (std::uint64_t i = 0; i < 4000; ++i) {
          Ray ray{as_point(vector(i, 30) * 2), vector(i, 33)};
          if (i % 3 == 0) ray.t_max = 0.7;
          if (i % 7 == 0) ray.direction.x = 0;
          if (i % 11 == 0) ray.direction = ray.direction * 0x1p-600;  // beyond the domain
          Hit a;
          Hit b;
          const bool found = world.intersect(ray, a);
          ASSERT_EQ(found, world.intersect_brute_force(ray, b)) << i << " of " << count;
          ASSERT_EQ(found, world.occluded(ray)) << i;
          if (!found) continue;
          ++hits;
          ASSERT_EQ(a.t, b.t) << i << " of " << count;
          ASSERT_EQ(a.item, b.item) << i;
          ASSERT_EQ(a.point, b.point) << i;
          ASSERT_EQ(a.u, b.u) << i;
        }
        EXPECT_GT(hits, 100);
      }
}

}  // namespace
}  // namespace scenec::backend
