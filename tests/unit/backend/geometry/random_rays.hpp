// Reproducible random points, directions and transforms for the geometry tests.
#pragma once

#include <cmath>
#include <cstdint>

#include "backend/geometry/kernel.hpp"
#include "backend/math/frame.hpp"
#include "backend/math/rng.hpp"
#include "backend/math/sampling.hpp"
#include "backend/math/transform.hpp"
#include "base/elementary.hpp"

namespace scenec::backend::testing_support {

// One stream a test: every draw is a function of (seed, index of the draw).
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : seed_(seed) {}
  double unit() { return random_unit(seed_, next_++, 0, 0); }
  double between(double low, double high) { return low + (high - low) * unit(); }
  double power_of_ten(double low, double high) { return pow(10.0, between(low, high)); }
  UnitVector3 direction() { return sample_uniform_sphere({unit(), unit()}); }
  Point3 point(double size) {
    return {between(-size, size), between(-size, size), between(-size, size)};
  }
  // A rotation times a scale of 10^[-spread, spread] an axis, and a translation of the same size.
  Transform affine(double spread) {
    const Frame f = frame_about(direction());
    AffineRows rows{};
    const Vector3 axes[3] = {f.x, f.y, f.z};
    for (std::size_t i = 0; i < 3; ++i) {
      const double s = power_of_ten(-spread, spread);
      rows[i] = {s * axes[i].x, s * axes[i].y, s * axes[i].z, s * between(-1, 1)};
    }
    return Transform::from_rows(rows).value();
  }

 private:
  std::uint64_t seed_;
  std::uint64_t next_ = 0;
};

}  // namespace scenec::backend::testing_support
