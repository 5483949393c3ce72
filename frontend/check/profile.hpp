// What the front end has to know of a profile's form.
#pragma once

#include "ir/values.hpp"

namespace scenec::frontend {

// The smallest first coordinate of the curve.
//
// Domain:     curves with as many points as their kind needs.
// Method:     a curve lies in the hull of its points, so without a negative one the smallest of
//             them is the answer; else 64 points a span are evaluated (de Boor 1972).
// Error:      the answer may lie above the smallest radius by what a curve does between two of
//             those points; it is exact for polylines and where no point is negative only a bound
//             from below.
// Degenerate: no points give 0.
// Proof:      tests/unit/frontend/lints_test.cpp.
[[nodiscard]] double smallest_radius(const ir::Curve& curve);

}  // namespace scenec::frontend
