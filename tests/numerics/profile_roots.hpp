// Certified counts of the roots of a ray with a profile: the oracle for surfaces of revolution
// without a closed form. With t eliminated by the height (so d_y must not be tiny) the roots are
// those of a polynomial of degree 2 n; its Bernstein coefficients in extended precision are halved
// until the signs vary at most once, which by Descartes' rule means no root or exactly one.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "backend/geometry/revolve.hpp"
#include "tests/numerics/wide.hpp"

namespace scenec::numerics {

struct ProfileRoot {
  std::size_t segment = 0;
  long double s = 0;
  long double t = 0;
  // Slope of the polynomial there, against its size: small for tangent rays.
  double slope = 0;
};

// All roots with t >= 0, sorted by t; nothing when two are too close to be told apart, or one too
// close to an end of a segment or of the ray.
[[nodiscard]] std::optional<std::vector<ProfileRoot>> roots_of(const backend::Profile& profile,
                                                               const backend::Ray& ray);

}  // namespace scenec::numerics
