#include "backend/textures/pyramid.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/elementary.hpp"

namespace scenec::backend {
namespace {

std::uint32_t half_of(std::uint32_t size) {
  return std::max<std::uint32_t>(1, size / 2);
}

// What a texel of the smaller row covers of the larger one.
struct Cover {
  std::uint32_t first = 0;
  std::uint32_t last = 0;
  double from = 0;
  double to = 0;

  Cover(std::uint32_t texel, std::uint32_t large, std::uint32_t small) {
    const double ratio = static_cast<double>(large) / small;
    from = texel * ratio;
    to = (texel + 1) * ratio;
    first = static_cast<std::uint32_t>(from);
    last = std::min(static_cast<std::uint32_t>(std::ceil(to)), large) - 1;
  }
  [[nodiscard]] double share(std::uint32_t i) const {
    return (std::min<double>(i + 1, to) - std::max<double>(i, from)) / (to - from);
  }
};

void put(const TextureValue& value, std::uint32_t channels, float* out) {
  const double all[4] = {value.color.r, value.color.g, value.color.b, value.alpha};
  for (std::uint32_t c = 0; c < channels; ++c)
    out[c] = static_cast<float>(all[channels == 2 && c == 1 ? 3 : c]);
}

DecodedImage halved(const DecodedImage& image, bool srgb) {
  DecodedImage small;
  small.width = half_of(image.width);
  small.height = half_of(image.height);
  small.channels = image.channels;
  small.encoding = SampleEncoding::linear;
  std::vector<float> samples(std::size_t{small.width} * small.height * small.channels);
  for (std::uint32_t y = 0; y < small.height; ++y) {
    const Cover rows(y, image.height, small.height);
    for (std::uint32_t x = 0; x < small.width; ++x) {
      const Cover columns(x, image.width, small.width);
      TextureValue sum{{}, 0};
      for (std::uint32_t j = rows.first; j <= rows.last; ++j) {
        for (std::uint32_t i = columns.first; i <= columns.last; ++i) {
          const TextureValue t = texel(image, i, j, srgb);
          const double share = rows.share(j) * columns.share(i);
          sum.color += t.color * share;
          sum.alpha += t.alpha * share;
        }
      }
      put(sum, small.channels,
          &samples[(std::size_t{y} * small.width + x) * std::size_t{small.channels}]);
    }
  }
  small.samples = std::move(samples);
  return small;
}

TextureValue mixed(const TextureValue& a, const TextureValue& b, double t) {
  return {a.color * (1 - t) + b.color * t, a.alpha * (1 - t) + b.alpha * t};
}

}  // namespace

Pyramid::Pyramid(const DecodedImage& image, bool srgb) : srgb_(srgb) {
  const DecodedImage* last = &image;
  bool curve = srgb;
  while (last->width > 1 || last->height > 1) {
    DecodedImage next = halved(*last, curve);
    levels_.push_back(std::move(next));
    last = &levels_.back();
    curve = false;
  }
}

std::uint64_t Pyramid::memory() const {
  std::uint64_t bytes = sizeof *this;
  for (const DecodedImage& level : levels_) bytes += sizeof level + memory_of(level);
  return bytes;
}

std::uint64_t Pyramid::memory_for(const DecodedImage& image) {
  std::uint64_t texels = 0;
  std::uint32_t width = image.width;
  std::uint32_t height = image.height;
  while (width > 1 || height > 1) {
    width = half_of(width);
    height = half_of(height);
    texels += std::uint64_t{width} * height;
  }
  return texels * image.channels * sizeof(float);
}

TextureValue Pyramid::lookup(const DecodedImage& image, const TexturePlace& at,
                             ir::Wrap wrap) const {
  const auto level = [&](std::size_t i) {
    return i == 0
               ? backend::lookup(image, at.uv, wrap, ir::TextureFilter::bilinear, srgb_)
               : backend::lookup(levels_[i - 1], at.uv, wrap, ir::TextureFilter::bilinear, false);
  };
  const double texels = std::max(at.width_u * image.width, at.width_v * image.height);
  if (texels <= 1 || levels_.empty()) return level(0);
  const double size = std::isfinite(texels) ? log(texels) / log(2.0) : texels;
  // NaN too.
  if (!(size < static_cast<double>(levels_.size()))) return level(levels_.size());
  const double whole = std::floor(size);
  const auto lower = static_cast<std::size_t>(whole);
  return mixed(level(lower), level(lower + 1), size - whole);
}

}  // namespace scenec::backend
