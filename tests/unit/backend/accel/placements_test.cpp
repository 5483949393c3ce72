#include "backend/accel/placements.hpp"

#include <gtest/gtest.h>

#include "tests/unit/backend/geometry/random_rays.hpp"

namespace scenec::backend {
namespace {

using testing_support::Draw;

TEST(Placements, RaysAndTransformsKeepTheirBits) {
  Draw draw(71);
  Placements places;
  EXPECT_EQ(places.add(Transform()), Placements::identity);
  std::vector<std::pair<Placements::Index, Transform>> added;
  for (int i = 0; i < 10000; ++i) {
    const Vector3 v = as_vector(draw.point(100));
    const Transform move = Transform::translation(v);
    const Transform t = i % 3 == 0 ? move * Transform::scaling({2, 1 + draw.unit(), 0.5}) : move;
    added.emplace_back(places.add(t), t);
  }
  for (const auto& [index, transform] : added) {
    ASSERT_TRUE(places.holds(index));
    ASSERT_NE(index, Placements::identity);
    EXPECT_EQ(places[index], transform);
    const Ray ray{draw.point(10), draw.direction(), 0.25, 7};
    const Ray local = places.to_object(index, ray);
    EXPECT_EQ(local.origin, transform.apply_inverse(ray.origin));
    EXPECT_EQ(local.direction, transform.apply_inverse(ray.direction));
    EXPECT_EQ(local.t_min, 0.25);
    EXPECT_EQ(local.t_max, 7);
  }
  EXPECT_FALSE(places.holds(2 * 10000 + 1));
}

}  // namespace
}  // namespace scenec::backend
