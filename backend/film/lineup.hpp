// Whether a picture stands out in a line-up of pictures that were made as it claims to have been.
// Nothing has to be known of the noise: if the picture is what it says, any of the pictures could
// as well have been the one that is asked about.
//
// Domain:     pictures with as many samples each and independent random numbers; pixels that are
//             independent of each other, as those of a render are.
// Method:     Evidence with the expectation 1 (e-values: Vovk and Wang, Annals of Statistics 49,
//             2021). Among n pictures the rank of the suspect's value in a pixel is one of n alike,
//             so that a function of the rank, divided by its mean over all ranks, is evidence. The
//             pixels being independent, products are evidence too, and so are means of evidence: a
//             block's is the mean of that of both its halves and that of one of them, whichever it
//             is, down to the pixel. Ranks are taken three times: from above, from below and by the
//             distance from the middle in any channel. The cells of a picture are then believed in
//             part, by several parts.
//             A cell that was not looked at counts as proof of honesty: this can only lower the
//             evidence of the whole, so the choice of cells may depend on anything that was seen.
// Error:      none: an honest picture has evidence above e with probability 1 / e at most (Markov).
// Degenerate: equal values share their ranks; all of them equal within the rounding of the file
//             say nothing. Values that are not finite count as the largest.
// Proof:      tests/unit/backend/film/lineup_test.cpp, tests/accuracy/verify_test.cpp.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace scenec::backend {

// `suspect` and all `peers` hold the same pixels, three values each, `width` a row; values that
// differ by less than the part `rounding` are the same.
[[nodiscard]] double evidence_against(std::span<const float> suspect,
                                      const std::vector<std::vector<float>>& peers,
                                      std::size_t width, double rounding);

// The logarithm of the probability that an honest picture of `cells` cells has evidence of this
// size in those that were looked at.
[[nodiscard]] double log_p_of_evidence(const std::vector<double>& evidence, std::size_t cells);

}  // namespace scenec::backend
