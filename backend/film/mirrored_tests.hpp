// Tests of two pictures that have equally many samples each, if the files say what is so: then the
// two may be swapped in every pixel.
//
// Domain:     pictures of one size with independent random numbers; pixels independent.
// Method:     Signs of differences are fair coins whatever the tails are, and sums of them obey
//             Hoeffding's bound (1963, theorem 2). Of three such pictures the first lies between
//             the others in a third of the pixels.
// Error:      none: exact bounds.
// Degenerate: equal values toss no coin; no coins, no evidence.
// Proof:      tests/unit/backend/film/agreement_test.cpp, tests/accuracy/verify_test.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "backend/film/noisy_picture.hpp"

namespace scenec::backend {

// Sums for tests of pictures with equally many samples, taken over any number of parts.
struct MirroredSums {
  std::array<double, 3> difference{};
  std::array<double, 3> squares{};
  // Of coins: how often the first picture's side is up.
  struct Coins {
    std::size_t up = 0;
    std::size_t down = 0;
  };
  Coins noisier;  // pixels by their variances
  Coins rougher;  // groups of nine pixels by how much those differ among themselves
  Coins middle;   // pixels in which the first of three pictures lies between the others: a third
};
// `weights`: of a third picture, for this part of it. Pictures whose files round must both be
// rounded.
void add_mirrored(MirroredSums& sums, const NoisyPicture& a, const NoisyPicture& b,
                  const std::vector<double>& weights);
// The first of three pictures: one with too much noise is between the others too seldom.
void add_middles(MirroredSums& sums, const NoisyPicture& a, const NoisyPicture& b,
                 const NoisyPicture& c);
// log p that one picture is the other times a factor; that the coins fall up with this probability.
[[nodiscard]] double log_p_brightness(const MirroredSums& sums);
[[nodiscard]] double log_p_fair(const MirroredSums::Coins& coins, double up = 0.5);

}  // namespace scenec::backend
