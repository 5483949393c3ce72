// Bases are orthonormal and right-handed for every direction, the poles included (P12).
#include "backend/math/frame.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "backend/math/rng.hpp"
#include "backend/math/sampling.hpp"

namespace scenec::backend {
namespace {

void expect_orthonormal(const Frame& f) {
  const double bound = 8 * unit_roundoff;
  EXPECT_NEAR(length(f.x), 1, bound);
  EXPECT_NEAR(length(f.y), 1, bound);
  EXPECT_NEAR(dot(f.x, f.y), 0, bound);
  EXPECT_NEAR(dot(f.x, f.z), 0, bound);
  EXPECT_NEAR(dot(f.y, f.z), 0, bound);
  EXPECT_GT(dot(cross(f.x, f.y), f.z), 0);
}

TEST(Frame, AllDirections) {
  for (std::uint64_t i = 0; i < 100000; ++i)
    expect_orthonormal(
        frame_about(sample_uniform_sphere({random_unit(1, i, 0, 0), random_unit(1, i, 0, 1)})));
}

TEST(Frame, PolesAndTheirNeighbours) {
  for (const double z : {1.0, -1.0})
    for (const double e : {0.0, -0.0, 1e-20, -1e-20, 1e-9})
      expect_orthonormal(frame_about(UnitVector3::assume_unit({e, -e, z})));
  expect_orthonormal(frame_about(UnitVector3::assume_unit({1, 0, -0.0})));
}

TEST(Frame, TangentIsKept) {
  const Frame f = frame_about(UnitVector3::assume_unit({0, 1, 0}), {3, 5, 0});
  EXPECT_EQ(f.x, UnitVector3::assume_unit({1, 0, 0}));
  expect_orthonormal(f);
  expect_orthonormal(frame_about(UnitVector3::assume_unit({0, 1, 0}), {0, 2, 0}));
}

}  // namespace
}  // namespace scenec::backend
