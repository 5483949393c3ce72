// Boxes of floats in vector registers, for the builders.
#pragma once

#include <cstring>
#include <limits>

#include "backend/accel/tree_build.hpp"

namespace scenec::backend {

using Float4 = float __attribute__((vector_size(16)));
using Int4 = int __attribute__((vector_size(16)));

[[nodiscard]] inline Float4 min_of(Float4 a, Float4 b) {
  return a < b ? a : b;
}
[[nodiscard]] inline Float4 max_of(Float4 a, Float4 b) {
  return a > b ? a : b;
}

// The fourth coordinate is 0 in boxes of references and of no meaning elsewhere.
struct FloatBox {
  static constexpr float infinity = std::numeric_limits<float>::infinity();
  Float4 min = {infinity, infinity, infinity, infinity};
  Float4 max = {-infinity, -infinity, -infinity, -infinity};

  void grow(const FloatBox& b) {
    min = min_of(min, b.min);
    max = max_of(max, b.max);
  }
  void grow(Float4 p) {
    min = min_of(min, p);
    max = max_of(max, p);
  }
  [[nodiscard]] bool empty() const { return !(min[0] <= max[0]); }
  // Half the surface; of no meaning when empty.
  [[nodiscard]] float half_area() const {
    const Float4 e = max - min;
    return e[0] * (e[1] + e[2]) + e[1] * e[2];
  }
};

// The number beside the coordinates is masked away: taken for a float it would be subnormal, and
// slow to add.
[[nodiscard]] inline FloatBox box_of(const BuildRef& ref) {
  constexpr Int4 coordinates = {-1, -1, -1, 0};
  Int4 low;
  Int4 high;
  std::memcpy(&low, ref.min, sizeof low);
  std::memcpy(&high, ref.max, sizeof high);
  return {reinterpret_cast<Float4>(low & coordinates),
          reinterpret_cast<Float4>(high & coordinates)};
}

// Twice the centre.
[[nodiscard]] inline Float4 center_of(const FloatBox& box) {
  return box.min + box.max;
}

}  // namespace scenec::backend
