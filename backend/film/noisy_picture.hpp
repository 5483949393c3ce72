// A picture and how sure each of its pixels is: what the tests of agreement.hpp, mirrored_tests.hpp
// and lineup.hpp hold against each other.
#pragma once

#include <cstddef>
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
// Of every pixel.
[[nodiscard]] std::vector<float> contrast_of(const NoisyPicture& picture);
// To be called before a part is taken: a pixel at the part's edge has neighbours outside.
void look_at_contrast(NoisyPicture& picture);
// Of a picture rendered with the layer `variance`.
[[nodiscard]] NoisyPicture noisy_picture_of(const Picture& picture);
// Pixels [x0, x1) x [y0, y1).
[[nodiscard]] NoisyPicture part_of(const NoisyPicture& picture, const ir::Region& part);

// For a picture whose variances are not known: what those of `own`, another picture of it, leave to
// expect of it, and no less than what it differs from its surroundings by. Sets its variances.
void guess_variance(NoisyPicture& picture, const NoisyPicture& own);

}  // namespace scenec::backend
