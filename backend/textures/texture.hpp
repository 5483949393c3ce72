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
// Proof:      tests/unit/backend/textures/texture_test.cpp, pyramid_test.cpp.
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "backend/image/image.hpp"
#include "backend/math/color.hpp"
#include "backend/math/sampling.hpp"
#include "ir/scene.hpp"

namespace scenec::backend {

class Pyramid;

// Where a texture is read, and how wide the pixel's cone is there in u and in v (0: a point).
struct TexturePlace {
  Sample2 uv;
  double width_u = 0;
  double width_v = 0;

  TexturePlace() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): a point is a place
  TexturePlace(Sample2 point) : uv(point) {}
  TexturePlace(double u, double v) : uv{u, v} {}
};

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
                   const std::vector<std::shared_ptr<const DecodedImage>>& images);
  ~TextureEvaluator();

  [[nodiscard]] TextureValue value(ir::TextureId texture, const TexturePlace& at,
                                   TextureUse use) const;
  [[nodiscard]] Rgb color(const ir::ColorInput& input, const TexturePlace& at) const {
    if (!input.texture.valid()) return {input.value.r, input.value.g, input.value.b};
    return value(input.texture, at, TextureUse::color).color;
  }
  [[nodiscard]] double number(const ir::NumberInput& input, const TexturePlace& at) const {
    if (!input.texture.valid()) return input.value;
    return value(input.texture, at, TextureUse::data).color.r;
  }
  // Whether any texture looks at the widths of places.
  [[nodiscard]] bool wants_widths() const { return !pyramids_.empty(); }
  [[nodiscard]] std::uint64_t memory() const;  // bytes of what it made of the images

 private:
  // Of a picture, taken as colour (with the sRGB curve) and as it is; null: not asked for.
  struct Pyramids {
    std::unique_ptr<const Pyramid> srgb;
    std::unique_ptr<const Pyramid> linear;
  };
  [[nodiscard]] TextureValue image(const ir::ImageTexture& texture, const TexturePlace& at,
                                   TextureUse use) const;

  const ir::Scene* scene_;
  const std::vector<std::shared_ptr<const DecodedImage>>* images_;
  std::map<ir::AssetId, Pyramids> pyramids_;  // of those a `.trilinear` texture names
};

// One texel as linear values (`srgb`: whole numbers carry the curve), by wrapped index.
[[nodiscard]] TextureValue texel(const DecodedImage& image, std::int64_t x, std::int64_t y,
                                 bool srgb);
// Bilinear or nearest (`.trilinear` is bilinear at a point); v = 0 is the bottom row.
[[nodiscard]] TextureValue lookup(const DecodedImage& image, Sample2 uv, ir::Wrap wrap,
                                  ir::TextureFilter filter, bool srgb);
// Gradient noise in [-1, 1], 0 at whole numbers.
[[nodiscard]] double gradient_noise(double x, double y);

}  // namespace scenec::backend
