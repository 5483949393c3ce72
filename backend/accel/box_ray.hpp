// A ray as the boxes of a tree see it: in float, so arranged that one fused multiply-add a slab
// decides, and yet no box is left out that the ray meets.
//
// Domain:     any ray whose origin is finite in tree space, any finite direction but zero.
// Method:     where the largest component of d is not in [2^-20, 2^20], d is scaled by a power of
// two
//             to one in [1, 2), so that t is within 2^20 of the order of tree space. Origins
//             outside
//             [-4, 4]^3, and rays that begin at t != 0, are moved in double to where they come near
//             the tree (`shift`), so |o| <= 4 and the part of the ray that matters is
//             0 <= t <= 5 * 2^20. Components of d below 2^-52 become +-2^-52. Then with
//             r = fl(1 / fl(d)) a slab plane b is met at
//               near(b) = fma(b, r, near_add), near_add = fl(-o r - m),
//               far(b)  = fma(b, r, far_add),  far_add  = fl(-o r + m),
//               m = 12 u (1 + |o|) |r| + 2^-49 |o as given| |r|, u = 2^-24, in float.
// Error:      near(b) <= (b - o) / d <= far(b) in exact arithmetic. With u = 2^-24: r = (1 + e) /
// d,
//             |e| <= 2.1 u, moves (b - o) / d by 2.1 u (1 + |o|) |r|; the sum in the addend rounds
//             by u (|o r| + m), the product (where nothing is fused) by u |b r|, the result by u
//             (|b r| + |o r| + m). With |b| <= 1 that is at most 5.2 u (1 + |o|) |r|, and m has 8;
//             the rest, 2.8 u, is a thousand million times the kernels' own rounding. The move of
//             the origin rounds by 2^-51 |o as given|, which the second term covers.
// Degenerate: a clamped component belongs to a ray that moves less than 5 * 2^-32 across the tree
//             along that axis, while m / |r| >= 2^-21: whatever slab it meets, near <= 0 and
//             far >= 5. Zero, negative zero, subnormal and huge components are nothing special.
//             Nothing is ever infinite or NaN, but for the empty box, which no comparison accepts.
// Proof:      tests/unit/backend/accel/box_ray_test.cpp, against exact rational arithmetic.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "backend/accel/wide_tree.hpp"
#include "backend/geometry/kernel.hpp"

namespace scenec::backend {

// t in tree space: in units of the direction's and the tree's powers of two, so it keeps its bits.
// Several factors, because their product may be out of range.
struct LocalTimes {
  double from_local[3];
  double into_local[2];
  [[nodiscard]] double to_world(double t_local) const {
    return t_local * from_local[0] * from_local[1] * from_local[2];
  }
  [[nodiscard]] double to_local(double t) const { return t * into_local[0] * into_local[1]; }
};

// The ray in tree space: the same points.
struct LocalRay {
  // Of the largest component of a direction.
  static constexpr double least = 0x1p-20;
  static constexpr double most = 0x1p20;

  double origin[3];
  double direction[3];
  double t_min;
  double t_max;
  LocalTimes times;
};

[[nodiscard]] LocalRay make_local(const TreeSpace& space, const Ray& ray);

// The power of two at or below x; 0 for subnormal x.
[[nodiscard]] inline double power_of_two_below(double x) {
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) & 0x7ff0000000000000ULL);
}

// Each array has a fourth place of no meaning.
struct BoxRay {
  static constexpr double reach = 4;             // of origins that need no move
  static constexpr float smallest = 0x1p-52F;    // component of a direction
  static constexpr float slack = 12 * 0x1p-24F;  // of the test, in units of (1 + |o|) |r|

  alignas(16) float reciprocal[4];
  alignas(16) float near_add[4];
  alignas(16) float far_add[4];
  std::uint32_t negative = 0;  // bit k: component k of the direction is negative
  double shift = 0;            // t_box = t_local - shift

  // In WideNode::bounds, in bytes from its beginning.
  [[nodiscard]] std::uint32_t near_row(std::uint32_t k) const {
    return 64 * k + (negative >> k & 1U) * 32;
  }
  [[nodiscard]] std::uint32_t far_row(std::uint32_t k) const {
    return 64 * k + 32 - (negative >> k & 1U) * 32;
  }
  // Not below t_box of `t_local`: what `near` is compared with.
  [[nodiscard]] float limit(double t_local) const {
    const auto t = static_cast<float>(t_local - shift);
    return t + std::fabs(t) * 0x1p-22F;
  }
};

// False when the ray passes the whole tree.
[[nodiscard]] bool make_box_ray(const LocalRay& ray, BoxRay& out);

}  // namespace scenec::backend
