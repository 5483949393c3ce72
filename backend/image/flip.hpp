// FLIP: how different two pictures look to a person who switches between them, a number in [0, 1] a
// pixel.
//
// Domain:     linear RGB, clamped to [0, 1] (what a display can show); equal sizes.
// Method:     Andersson et al. 2020, "FLIP: A Difference Evaluator for Alternating Images", with
//             its constants: contrast sensitivity filters in YCxCz, HyAB in Hunt-adjusted L*a*b*,
//             differences of edges and points raise the difference of colours.
// Error:      single-precision constants of the paper; filters are cut off at three standard
//             deviations.
// Degenerate: pixels beyond the edge repeat the edge; a picture of one pixel has no edges; NaN
//             is 0.
// Proof:      tests/unit/backend/image/flip_test.cpp.
#pragma once

#include <vector>

#include "backend/image/image.hpp"

namespace scenec::backend {

// A 0.7 m distant, 0.7 m wide display of 3840 pixels, as the paper takes.
inline constexpr double usual_pixels_a_degree = 67.0206;

// One value a pixel. Precondition: equal sizes, at least three channels each.
[[nodiscard]] std::vector<float> flip_of(const FloatImage& image, const FloatImage& reference,
                                         double pixels_a_degree = usual_pixels_a_degree);

}  // namespace scenec::backend
