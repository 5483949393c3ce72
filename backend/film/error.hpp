// How far a film is from settled, told from the film alone.
//
// Domain:     every pixel has a sample in each replicate; finite sums.
// Method:     The variance v of a pixel's mean is that between its replicates. relMSE is the mean
//             of v / (R^2 + e) over pixels and channels, with e = 0.01 * (mean luminance)^2. R is
//             not known, and a pixel's own mean is a bad guess: the bright sample that makes v
//             large makes the mean large too. So v is read from two replicates at a time and R
//             guessed from the other two, which have not seen that noise, drawn towards the mean of
//             those of the eight pixels round it that are like it (James and Stein), as far as
//             their scatter allows; what the guess's own noise adds to 1 / (R^2 + e) is taken off.
//             All six ways to choose the two are averaged. The band: what the true squared error
//             exceeds v by has the variance 2 s^2 r / (r - 1), with s the true variance of the mean
//             and r replicates (the fourth cumulant cancels); s^2 is estimated without bias by
//             products of differences of disjoint pairs of replicates. The doubt about R is added
//             to it.
// Error:      measured: docs/accuracy.md. Light that no sample has found yet is in no estimate.
// Degenerate: no noise at all: 0 with a band of 0. A replicate without samples: not known.
// Proof:      tests/unit/backend/film/error_test.cpp, tests/accuracy.
#pragma once

#include <vector>

#include "backend/backend.hpp"
#include "backend/film/film.hpp"
#include "base/parallel.hpp"

namespace scenec::backend {

[[nodiscard]] ErrorEstimate error_of(const Film& film, ThreadPool& pool);
// The part of each pixel: the sum over its channels of what its squared relative error is expected
// to be. Empty: not known.
[[nodiscard]] std::vector<double> squared_errors_of(const Film& film, ThreadPool& pool);

}  // namespace scenec::backend
