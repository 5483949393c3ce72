// The tail of Student's distribution, for tests that must not cry wolf once in a million.
//
// Domain:     any t, not negative; degrees of freedom above 0, not whole ones too.
// Method:     2 P(T > t) is the incomplete beta function I_x(v/2, 1/2) with x = v / (v + t^2)
//             (Abramowitz & Stegun 26.7.1, 26.5.27), by its continued fraction (26.5.8, modified
//             Lentz) in logarithms, so that tails far below the smallest double are told apart.
// Error:      relative 1e-10 of the logarithm.
// Degenerate: t = 0: 0. t infinite: minus infinity. NaN: 0, that is, no evidence.
// Proof:      tests/unit/backend/math/student_test.cpp, against tables and closed forms.
#pragma once

namespace scenec::backend {

// The logarithm of the probability of |T| >= t.
[[nodiscard]] double log_student_tail(double t, double freedom);

}  // namespace scenec::backend
