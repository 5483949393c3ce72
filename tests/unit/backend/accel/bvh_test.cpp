// The tree: complete, bounded in depth and size, the same for any pool, and walked without loss.
#include "backend/accel/bvh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "backend/accel/bvh_traverse.hpp"
#include "tests/unit/backend/geometry/random_rays.hpp"

namespace scenec::backend {
namespace {

using testing_support::Draw;

std::vector<Bounds3> random_boxes(std::size_t count, std::uint64_t seed) {
  Draw draw(seed);
  std::vector<Bounds3> boxes;
  for (std::size_t i = 0; i < count; ++i) {
    Bounds3 b;
    b.grow(draw.point(10));
    b.grow(b.min + as_vector(draw.point(0.5)));
    boxes.push_back(b);
  }
  return boxes;
}

// Every box in exactly one leaf, every node's box around what is below it.
void expect_sound(const Bvh& bvh, const std::vector<Bounds3>& boxes, std::size_t expected) {
  ASSERT_EQ(bvh.order().size(), expected);
  EXPECT_LE(bvh.nodes().size(), 2 * expected);
  EXPECT_LE(bvh.depth(), Bvh::max_depth);
  std::vector<std::uint32_t> order = bvh.order();
  std::sort(order.begin(), order.end());
  EXPECT_EQ(std::adjacent_find(order.begin(), order.end()), order.end());
  std::size_t in_leaves = 0;
  for (std::uint32_t i = 0; i < bvh.nodes().size(); ++i) {
    const BvhNode& node = bvh.nodes()[i];
    if (node.count == 0) {
      EXPECT_TRUE(node.box.contains(bvh.nodes()[i + 1].box) &&
                  node.box.contains(bvh.nodes()[node.first].box));
      continue;
    }
    in_leaves += node.count;
    for (std::uint32_t k = node.first; k < node.first + node.count; ++k)
      EXPECT_TRUE(node.box.contains(boxes[bvh.order()[k]]));
  }
  EXPECT_EQ(in_leaves, expected);
}

TEST(Bvh, HoldsEveryBoxOnce) {
  ThreadPool pool(2);
  for (const std::size_t count : {0U, 1U, 2U, 5U, 100U, 20000U}) {
    const std::vector<Bounds3> boxes = random_boxes(count, 1);
    expect_sound(Bvh(boxes, pool), boxes, count);
  }
}

TEST(Bvh, SameTreeForAnyPool) {
  const std::vector<Bounds3> boxes = random_boxes(50000, 2);
  ThreadPool one(1);
  const Bvh reference(boxes, one);
  for (const unsigned threads : {2U, 7U}) {
    ThreadPool pool(threads);
    const Bvh other(boxes, pool);
    ASSERT_EQ(other.order(), reference.order());
    ASSERT_EQ(other.nodes().size(), reference.nodes().size());
    for (std::size_t i = 0; i < other.nodes().size(); ++i) {
      EXPECT_EQ(other.nodes()[i].box, reference.nodes()[i].box);
      EXPECT_EQ(other.nodes()[i].first, reference.nodes()[i].first);
    }
  }
}

TEST(Bvh, HostileInputs) {
  ThreadPool pool(2);
  constexpr std::size_t count = 50000;
  const std::vector<Bounds3> equal(count, Bounds3{{0, 0, 0}, {1, 1, 0}});
  expect_sound(Bvh(equal, pool), equal, count);
  std::vector<Bounds3> nested;
  std::vector<Bounds3> line;
  std::vector<Bounds3> geometric;
  for (std::size_t i = 0; i < count; ++i) {
    const auto x = static_cast<double>(i);
    nested.push_back({{-x, -x, -x}, {x, x, x}});
    line.push_back({{x, 0, 0}, {x + 1, 0, 0}});
    const double g = std::ldexp(1.0, static_cast<int>(i % 2000) - 1000);
    geometric.push_back({{g, 0, 0}, {g, 0, 0}});
  }
  expect_sound(Bvh(nested, pool), nested, count);
  expect_sound(Bvh(line, pool), line, count);
  expect_sound(Bvh(geometric, pool), geometric, count);
}

TEST(Bvh, EmptyAndNonFiniteBoxesAreLeftOut) {
  ThreadPool pool(1);
  std::vector<Bounds3> boxes = random_boxes(10, 3);
  boxes[2] = {};
  boxes[5].max.x = std::numeric_limits<double>::infinity();
  boxes[7].min.y = std::nan("");
  expect_sound(Bvh(boxes, pool), boxes, 7);
}

TEST(Bvh, WalkFindsEveryBoxTheRayMeets) {
  ThreadPool pool(1);
  std::vector<Bounds3> boxes = random_boxes(2000, 4);
  for (std::size_t i = 0; i < boxes.size(); i += 3) boxes[i].max.y = boxes[i].min.y;  // flat ones
  const Bvh bvh(boxes, pool);
  const double parts[] = {0, -0.0, 1e-310, -1e-310, 1, -1, 1e300};
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    // An origin on a slab plane, heading along every kind of direction.
    for (const double x : parts)
      for (const double z : {0.0, 1.0}) {
        const Ray ray{{boxes[i].min.x, boxes[i].min.y, boxes[i].max.z}, {x, 0, z}};
        const RayBoxTest test(ray);
        bool seen = false;
        visit_leaves(bvh, test, ray.t_min, ray.t_max,
                     [&](std::uint32_t first, std::uint32_t count) {
                       for (std::uint32_t k = first; k < first + count; ++k)
                         seen = seen || bvh.order()[k] == i;
                       return false;
                     });
        ASSERT_TRUE(seen) << i << " " << x << " " << z;  // the origin is in the box
      }
  }
}

}  // namespace
}  // namespace scenec::backend
