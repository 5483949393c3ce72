// Smaller copies of a picture, for `filter = .trilinear`: where a pixel of the film sees many
// texels, their mean is read instead of one of them (Williams 1983, "Pyramidal Parametrics").
//
// Domain:     pictures of any size; any u, v and widths.
// Method:     each level half as wide and high as the last, rounded down, down to one texel; its
//             texels are the means, weighted by area, of what they cover, of linear values. Between
//             the two levels whose texels are nearest in size to the wider of the two widths,
//             values are mixed by the logarithm of the size.
// Error:      levels are floats: 2^-24 of a value a level. Round footprints blur what is seen at a
//             grazing angle.
// Degenerate: no width, or less than a texel: bilinear in the picture itself; not finite: the mean
//             of the whole picture; one texel: itself.
// Proof:      tests/unit/backend/textures/pyramid_test.cpp.
#pragma once

#include <cstdint>
#include <vector>

#include "backend/image/image.hpp"
#include "backend/textures/texture.hpp"

namespace scenec::backend {

class Pyramid {
 public:
  // `srgb`: whole numbers carry the curve. The picture itself is not kept.
  Pyramid(const DecodedImage& image, bool srgb);

  // As the function `lookup`, blurred to `at`'s widths. `image` is the one this was made from.
  [[nodiscard]] TextureValue lookup(const DecodedImage& image, const TexturePlace& at,
                                    ir::Wrap wrap) const;

  [[nodiscard]] std::uint64_t memory() const;  // bytes
  // Bytes that one takes, before it is made.
  [[nodiscard]] static std::uint64_t memory_for(const DecodedImage& image);

 private:
  bool srgb_;
  std::vector<DecodedImage> levels_;  // from half the size down, linear
};

}  // namespace scenec::backend
