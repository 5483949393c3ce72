// Values of textures at a place of a surface: the IR's table of expressions, walked from the root.
//
// Domain:     any u, v; what is not finite is taken as 0.
// Method:     wrapping on whole texel indices (floor, then modulo), texel centres at (i + 0.5) / n;
//             sRGB texels are decoded before they are mixed. Fractal: sum of gradient noise (Perlin
//             2002) over octaves of half amplitude, on a hashed lattice.
// Error:      lookups exact to 4 ulp of the texel values; at a texel's centre bilinear is exact
// (T04). Degenerate: 1 x 1 pictures under every filter; ramps without stops are black; u = 1 is the
// last
//             texel's far edge, which repeats to the first (T01).
// Proof:      tests/unit/backend/textures/texture_test.cpp.
#pragma once

#include <memory>
#include <vector>

#include "backend/image/image.hpp"
#include "backend/math/color.hpp"
#include "backend/math/sampling.hpp"
#include "ir/scene.hpp"

namespace scenec::backend {

struct TextureValue {
  Rgb color;
  double alpha = 1;
};

// What the value is for: 8-bit pictures carry the sRGB curve only where a colour is wanted.
enum class TextureUse : std::uint8_t { color, data };

class TextureEvaluator {
 public:
  // `images` by AssetId; null where the asset is no image. Both must outlive this.
  TextureEvaluator(const ir::Scene& scene,
                   const std::vector<std::shared_ptr<const DecodedImage>>& images)
      : scene_(&scene), images_(&images) {}

  [[nodiscard]] TextureValue value(ir::TextureId texture, Sample2 uv, TextureUse use) const;
  [[nodiscard]] Rgb color(const ir::ColorInput& input, Sample2 uv) const {
    if (!input.texture.valid()) return {input.value.r, input.value.g, input.value.b};
    return value(input.texture, uv, TextureUse::color).color;
  }
  [[nodiscard]] double number(const ir::NumberInput& input, Sample2 uv) const {
    if (!input.texture.valid()) return input.value;
    return value(input.texture, uv, TextureUse::data).color.r;
  }

 private:
  [[nodiscard]] TextureValue image(const ir::ImageTexture& texture, Sample2 uv,
                                   TextureUse use) const;

  const ir::Scene* scene_;
  const std::vector<std::shared_ptr<const DecodedImage>>* images_;
};

// One texel as linear values (`srgb`: whole numbers carry the curve), by wrapped index.
[[nodiscard]] TextureValue texel(const DecodedImage& image, std::int64_t x, std::int64_t y,
                                 bool srgb);
// Bilinear or nearest; v = 0 is the bottom row.
[[nodiscard]] TextureValue lookup(const DecodedImage& image, Sample2 uv, ir::Wrap wrap,
                                  ir::TextureFilter filter, bool srgb);
// Gradient noise in [-1, 1], 0 at whole numbers.
[[nodiscard]] double gradient_noise(double x, double y);

}  // namespace scenec::backend
