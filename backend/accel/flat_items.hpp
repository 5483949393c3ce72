// The few simple shapes of a world, laid out for testing one ray against four of a kind at a time:
// for a dozen walls and balls that is faster than any tree, whose boxes they would fill.
//
// Domain:     plain spheres, quads, disks and planes without transform, no coordinate beyond
//             2^300; rays likewise (`takes`).
// Method:     the formulas of the shapes' own kernels, operation by operation, so t has the same
//             bits; the nearest shape is then asked again by its kernel for the rest of the hit.
// Error:      that of the kernels.
// Degenerate: rays beyond the domain ask the kernels themselves, one shape after the other.
// Proof:      tests/unit/backend/accel/scene_accel_test.cpp, flat_items_test.cpp: the bits of brute
//             force.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "backend/geometry/kernel.hpp"

namespace scenec::backend {

inline constexpr std::size_t flat_width = 4;
// One number of each of four shapes; a place without a shape holds NaN, which nothing meets.
using FlatLane = std::array<double, flat_width>;
using FlatPoint = std::array<FlatLane, 3>;

struct alignas(32) FlatSpheres {
  FlatPoint center;
  FlatLane radius;
  std::array<std::uint32_t, flat_width> item;  // into FlatItems::order
};
struct alignas(32) FlatQuads {
  std::array<FlatPoint, 4> corner;
  FlatPoint normal;
  std::array<std::uint32_t, flat_width> item;
};
struct alignas(32) FlatDisks {
  FlatPoint center;
  FlatPoint normal;
  FlatLane radius;
  std::array<std::uint32_t, flat_width> item;
};
struct alignas(32) FlatPlanes {
  FlatPoint normal;
  FlatLane offset;
  std::array<std::uint32_t, flat_width> item;
};

struct FlatItems {
  static constexpr std::size_t most = 32;                // that are the whole world
  static constexpr std::size_t most_beside_others = 12;  // that stand beside a tree
  static constexpr double largest = 0x1p300;

  bool used = false;
  std::vector<FlatSpheres> spheres;
  std::vector<FlatQuads> quads;
  std::vector<FlatDisks> disks;
  std::vector<FlatPlanes> planes;

  [[nodiscard]] static bool takes(const Ray& ray) {
    const double direction = max_abs(ray.direction);
    return direction <= largest && direction >= 1 / largest &&
           max_abs(as_vector(ray.origin)) <= largest;
  }
};

}  // namespace scenec::backend
