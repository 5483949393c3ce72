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
//             picture, so that no sample weighs itself.
// Error:      measured: docs/accuracy.md.
// Degenerate: no variance and no difference: no evidence. No variance and a difference beyond the
//             rounding of the file: proof. Values that are not finite: proof.
// Proof:      tests/unit/backend/film/agreement_test.cpp, tests/accuracy/verify_test.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "backend/film/noisy_picture.hpp"

namespace scenec::backend {

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
// Among the worst, if it belongs there.
void add_finding(Agreement& all, const Disagreement& one);
// Puts the findings of `other` beside those of `all`; places are moved by (x, y).
void join(Agreement& all, const Agreement& other, std::int64_t x = 0, std::int64_t y = 0);

// Blocks of `side` pixels, each overlapping half of the next.
[[nodiscard]] Agreement compare_blocks(const NoisyPicture& a, const NoisyPicture& b,
                                       std::size_t side);
// How much either picture's noise leaves unexplained at each place: the mean of the squares of
// differences in their standard deviations, no pixel's counting as more than a few of those. Not a
// test: it tells where to look again.
[[nodiscard]] std::vector<double> suspicions_of(const NoisyPicture& a, const NoisyPicture& b,
                                                const std::vector<ir::Region>& places);
// Whether `picture` is brighter or darker by a factor than b and c, which have the same samples.
[[nodiscard]] Agreement compare_brightness(const NoisyPicture& picture, const NoisyPicture& b,
                                           const NoisyPicture& c);

// What a pixel of a picture says of a common factor; a weight a channel and pixel.
[[nodiscard]] std::vector<double> brightness_weights(const NoisyPicture& picture);

}  // namespace scenec::backend
