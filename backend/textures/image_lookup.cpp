// Texels of decoded pictures.
#include <algorithm>
#include <cmath>

#include "backend/image/tone.hpp"
#include "backend/textures/texture.hpp"

namespace scenec::backend {
namespace {

double linear_sample(const DecodedImage& image, std::size_t index, bool srgb) {
  if (const auto* bytes = std::get_if<std::vector<std::uint8_t>>(&image.samples)) {
    return srgb ? linear_of_srgb8((*bytes)[index]) : (*bytes)[index] / 255.0;
  }
  if (const auto* words = std::get_if<std::vector<std::uint16_t>>(&image.samples)) {
    const double value = (*words)[index] / 65535.0;
    return srgb ? linear_of_srgb(value) : value;
  }
  return static_cast<double>(std::get<std::vector<float>>(image.samples)[index]);
}

std::int64_t wrapped(std::int64_t i, std::int64_t n, ir::Wrap wrap) {
  switch (wrap) {
    case ir::Wrap::clamp:
      return std::clamp<std::int64_t>(i, 0, n - 1);
    case ir::Wrap::repeat: {
      const std::int64_t m = i % n;
      return m < 0 ? m + n : m;
    }
    case ir::Wrap::mirror: {
      std::int64_t m = i % (2 * n);
      if (m < 0) m += 2 * n;
      return m < n ? m : 2 * n - 1 - m;
    }
  }
  return 0;
}

// The whole part of a texel coordinate; far out (where doubles have no fraction of a texel left)
// any texel will do.
std::int64_t whole(double x) {
  constexpr double far = 0x1p52;
  if (!(std::fabs(x) < far)) return 0;
  return static_cast<std::int64_t>(std::floor(x));
}

TextureValue operator*(const TextureValue& a, double s) {
  return {a.color * s, a.alpha * s};
}
TextureValue operator+(const TextureValue& a, const TextureValue& b) {
  return {a.color + b.color, a.alpha + b.alpha};
}

}  // namespace

TextureValue texel(const DecodedImage& image, std::int64_t x, std::int64_t y, bool srgb) {
  const std::size_t channels = image.channels;
  const std::size_t base =
      (static_cast<std::size_t>(y) * image.width + static_cast<std::size_t>(x)) * channels;
  TextureValue value;
  if (channels <= 2) {
    value.color = Rgb::gray(linear_sample(image, base, srgb));
    if (channels == 2) value.alpha = linear_sample(image, base + 1, false);
  } else {
    value.color = {linear_sample(image, base, srgb), linear_sample(image, base + 1, srgb),
                   linear_sample(image, base + 2, srgb)};
    if (channels == 4) value.alpha = linear_sample(image, base + 3, false);
  }
  return value;
}

TextureValue lookup(const DecodedImage& image, Sample2 uv, ir::Wrap wrap, ir::TextureFilter filter,
                    bool srgb) {
  const auto width = static_cast<std::int64_t>(image.width);
  const auto height = static_cast<std::int64_t>(image.height);
  const double u = std::isfinite(uv.u) ? uv.u : 0;
  const double v = std::isfinite(uv.v) ? uv.v : 0;
  const double x = u * static_cast<double>(width);
  const double y = (1 - v) * static_cast<double>(height);
  if (filter == ir::TextureFilter::nearest) {
    return texel(image, wrapped(whole(x), width, wrap), wrapped(whole(y), height, wrap), srgb);
  }
  const double left = std::floor(x - 0.5);
  const double top = std::floor(y - 0.5);
  const double tx = x - 0.5 - left;
  const double ty = y - 0.5 - top;
  const std::int64_t x0 = wrapped(whole(left), width, wrap);
  const std::int64_t x1 = wrapped(whole(left) + 1, width, wrap);
  const std::int64_t y0 = wrapped(whole(top), height, wrap);
  const std::int64_t y1 = wrapped(whole(top) + 1, height, wrap);
  return (texel(image, x0, y0, srgb) * (1 - tx) + texel(image, x1, y0, srgb) * tx) * (1 - ty) +
         (texel(image, x0, y1, srgb) * (1 - tx) + texel(image, x1, y1, srgb) * tx) * ty;
}

}  // namespace scenec::backend
