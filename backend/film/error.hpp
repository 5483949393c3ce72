// How far a film is from settled, told from the film alone.
//
// Domain:     every pixel has a sample in each replicate; finite sums.
// Method:     The variance v of a pixel's mean is that between its replicates. relMSE is the mean
//             of v / (R^2 + e) over pixels and channels, with e = 0.01 * (mean luminance)^2. R is
//             not known, and a pixel's own mean is a bad guess: the bright sample that makes v
//             large makes the mean large too. The mean of the pixels round it that are like it
//             takes its place; likeness is judged by the two middle replicates, which do not see
//             one bright sample. The band: what the true squared error exceeds v by has the
//             variance 2 s^2 r / (r - 1), with s the true variance of the mean and r replicates
//             (the fourth cumulant cancels); s^2 is estimated without bias by products of
//             differences of disjoint pairs of replicates. The doubt about R, from the neighbours'
//             scatter, is added to it.
// Error:      measured: docs/accuracy.md. Light that no sample has found yet is in no estimate.
// Degenerate: no noise at all: 0 with a band of 0. A replicate without samples: not known.
// Proof:      tests/unit/backend/film/error_test.cpp, tests/accuracy.
#pragma once

#include "backend/backend.hpp"
#include "backend/film/film.hpp"
#include "base/parallel.hpp"

namespace scenec::backend {

[[nodiscard]] ErrorEstimate error_of(const Film& film, ThreadPool& pool);

}  // namespace scenec::backend
