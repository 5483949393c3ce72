// Whether two noisy pictures can be pictures of the same thing. What is asked is not how far they
// are apart but whether their own noise explains it; every answer is the logarithm of a probability
// that holds for honest pictures, corrected for the number of places that were looked at.
//
// Domain:     pictures of one size with independent random numbers; variances of the pixels' means.
//             How many samples each had may differ.
// Method:     Blocks: the sum of the differences over a block against Student's distribution. Its
//             variance is the larger of the sum of both pictures' variances and what they say
//             together of one sample's variance: a picture with few samples may have met no rare
//             bright one, and then knows nothing of them. The degrees of freedom are
//             Satterthwaite's over all pixels, so that a block whose variance is that of one bright
//             pixel has three of them and proves nothing. Every pixel's variance is at least that
//             of one sample more that differs by as much as a neighbour does: replicates that agree
//             by chance at an edge know nothing of it either. Brightness: the sum of differences
//             weighted with what a common factor would do to each; the weights come from a third
//             picture, so that no sample weighs itself. Mirrored tests: with equally many samples
//             the two pictures of a pixel may be swapped. Signs of differences are then fair coins
//             whatever the tails are, and sums of them obey Hoeffding's bound, exactly.
// Error:      Mirrored tests are exact bounds; the others are measured: docs/accuracy.md.
// Degenerate: no variance and no difference: no evidence. No variance and a difference beyond the
//             rounding of the file: proof. Values that are not finite: proof.
// Proof:      tests/unit/backend/film/agreement_test.cpp, tests/accuracy/verify_test.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "backend/backend.hpp"

namespace scenec::backend {

struct NoisyPicture {
  std::size_t width = 0;
  std::size_t height = 0;
  double samples = 1;           // a pixel
  std::vector<float> rgb;       // three a pixel, rows from the top
  std::vector<float> variance;  // of the means; as many
  double rounding = 0x1p-23;    // of the file the values come from, relative
  // The largest difference to a neighbour: how far one sample may well be off.
  std::vector<float> contrast;  // as many; empty: not looked at yet
};
// To be called before a part is taken: a pixel at the part's edge has neighbours outside.
void look_at_contrast(NoisyPicture& picture);
// Of a picture rendered with the layer `variance`.
[[nodiscard]] NoisyPicture noisy_picture_of(const Picture& picture);
// Pixels [x0, x1) x [y0, y1).
[[nodiscard]] NoisyPicture part_of(const NoisyPicture& picture, const ir::Region& part);

struct Disagreement {
  ir::Region place;
  std::size_t channel = 0;
  double first = 0;  // means over the place
  double second = 0;
  double deviations = 0;  // the difference in its own standard deviations
  double log_p = 0;       // of this place alone
};
struct Agreement {
  double log_p = 0;  // of the worst place, times the number of places looked at; 0: no evidence
  std::size_t tests = 0;
  std::vector<Disagreement> worst;  // worst first, none twice
};
// Puts the findings of `other` beside those of `all`; places are moved by (x, y).
void join(Agreement& all, const Agreement& other, std::int64_t x = 0, std::int64_t y = 0);

// Blocks of `side` pixels, each overlapping half of the next.
[[nodiscard]] Agreement compare_blocks(const NoisyPicture& a, const NoisyPicture& b,
                                       std::size_t side);
// Whether `picture` is brighter or darker by a factor than b and c, which have the same samples.
[[nodiscard]] Agreement compare_brightness(const NoisyPicture& picture, const NoisyPicture& b,
                                           const NoisyPicture& c);

// What a pixel of a picture says of a common factor; a weight a channel and pixel.
[[nodiscard]] std::vector<double> brightness_weights(const NoisyPicture& picture);

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

// For a picture whose variances are not known: what those of `own`, another picture of it, leave to
// expect of it, and no less than what it differs from its surroundings by. Sets its variances.
void guess_variance(NoisyPicture& picture, const NoisyPicture& own);

}  // namespace scenec::backend
