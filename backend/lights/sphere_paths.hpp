// Paths that meet one smooth sphere between two given points: mirrored at its outside, or through
// it. All of them, in closed reach: such a path lies in the plane of its ends and the centre and
// passes the centre at the same distance before and after, so that one number describes it.
//
// Domain:     ends outside the sphere, distances in radii (> 1); ior > 1; impacts in (-1, 1): the
//             sine of the angle of incidence, positive on the other end's side of the axis.
// Method:     with the impact b = sin t the angle at the centre is a sum of arcsines of b over
//             the two distances, the index and 1. Mirrored: increasing in t, one root. Through: its
//             derivative over b has one peak, as the second one over b has one sign change, so that
//             at most two critical points part it into monotone pieces; each root is bracketed by
//             them and found by Newton's method, bisection where that leaves the bracket. Angles
//             are kept as sine and cosine, so that no arc function is called. Spreads: Coddington's
//             equations in the form of ray transfer, which pass through foci without dividing.
// Error:      impacts to 1e-12 where the spread is not below 1e-3 of its size at the axis.
// Degenerate: ends in line with the centre: the straight path; the ring of others has spread 0.
//             Within 1e-8 of a fold two roots may be missed, where their spread is as small.
// Proof:      tests/unit/backend/lights/sphere_paths_test.cpp.
#pragma once

#include <array>
#include <optional>

namespace scenec::backend {

struct SphereEnds {
  double from = 2;  // distances of the ends from the centre, in radii
  double to = 2;
  double cosine = 1;  // of the angle between the ways from the centre to both, in [0, pi]
  double sine = 0;
};

[[nodiscard]] std::optional<double> mirrored_impact(const SphereEnds& ends);

struct Impacts {
  std::array<double, 5> values{};
  int count = 0;
};
[[nodiscard]] Impacts impacts_through(const SphereEnds& ends, double ior);

// Area across the path at its end over solid angle at its start, in squared radii.
[[nodiscard]] double mirrored_spread(double from, double to, double impact);
[[nodiscard]] double spread_through(double from, double to, double impact, double ior);

}  // namespace scenec::backend
