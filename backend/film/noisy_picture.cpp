#include "backend/film/noisy_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "base/assert.hpp"

namespace scenec::backend {
namespace {

double median_around(const NoisyPicture& p, std::size_t x, std::size_t y, std::size_t c) {
  std::array<float, 9> around{};
  std::size_t count = 0;
  for (std::size_t v = y - std::min<std::size_t>(y, 1); v < std::min(p.height, y + 2); ++v)
    for (std::size_t u = x - std::min<std::size_t>(x, 1); u < std::min(p.width, x + 2); ++u)
      around[count++] = p.rgb[3 * (v * p.width + u) + c];
  const auto middle = around.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(around.begin(), middle, around.begin() + static_cast<std::ptrdiff_t>(count));
  return double{*middle};
}

}  // namespace

std::vector<float> contrast_of(const NoisyPicture& p) {
  std::vector<float> result(p.rgb.size());
  for (std::size_t y = 0; y < p.height; ++y) {
    for (std::size_t x = 0; x < p.width; ++x) {
      for (std::size_t c = 0; c < 3; ++c) {
        const float own = p.rgb[3 * (y * p.width + x) + c];
        float largest = 0;
        for (std::size_t v = y - std::min<std::size_t>(y, 1); v < std::min(p.height, y + 2); ++v)
          for (std::size_t u = x - std::min<std::size_t>(x, 1); u < std::min(p.width, x + 2); ++u)
            largest = std::max(largest, std::abs(p.rgb[3 * (v * p.width + u) + c] - own));
        result[3 * (y * p.width + x) + c] = largest;
      }
    }
  }
  return result;
}

void look_at_contrast(NoisyPicture& picture) {
  picture.contrast = contrast_of(picture);
}

NoisyPicture noisy_picture_of(const Picture& picture) {
  NoisyPicture result;
  result.width = static_cast<std::size_t>(picture.width);
  result.height = static_cast<std::size_t>(picture.height);
  result.samples = static_cast<double>(std::max<std::int64_t>(1, picture.samples));
  result.rgb = picture.rgb;
  SCENEC_ASSERT(picture.rgb.size() == 3 * result.width * result.height);
  result.variance.resize(picture.rgb.size());
  constexpr std::array<std::string_view, 3> names{"variance.R", "variance.G", "variance.B"};
  for (const auto& [name, values] : picture.layers) {
    const auto c =
        static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
    if (c == names.size()) continue;
    for (std::size_t i = 0; i < values.size(); ++i) result.variance[3 * i + c] = values[i];
  }
  return result;
}

NoisyPicture part_of(const NoisyPicture& picture, const ir::Region& part) {
  NoisyPicture result{static_cast<std::size_t>(part.x1 - part.x0),
                      static_cast<std::size_t>(part.y1 - part.y0),
                      picture.samples,
                      {},
                      {},
                      picture.rounding,
                      {}};
  const std::size_t row = 3 * result.width;
  for (std::int64_t y = part.y0; y < part.y1; ++y) {
    const auto at = static_cast<std::ptrdiff_t>(
        3 * (static_cast<std::size_t>(y) * picture.width + static_cast<std::size_t>(part.x0)));
    const auto end = at + static_cast<std::ptrdiff_t>(row);
    const auto take = [&](std::vector<float>& to, const std::vector<float>& whole) {
      if (!whole.empty()) to.insert(to.end(), whole.begin() + at, whole.begin() + end);
    };
    take(result.rgb, picture.rgb);
    take(result.variance, picture.variance);
    take(result.contrast, picture.contrast);
  }
  return result;
}

void guess_variance(NoisyPicture& picture, const NoisyPicture& own) {
  SCENEC_ASSERT(picture.rgb.size() == own.rgb.size());
  picture.variance.resize(picture.rgb.size());
  for (std::size_t i = 0; i < picture.rgb.size(); ++i) {
    const std::size_t pixel = i / 3;
    const double off = double{picture.rgb[i]} -
                       median_around(picture, pixel % picture.width, pixel / picture.width, i % 3);
    picture.variance[i] = static_cast<float>(
        std::max(double{own.variance[i]} * own.samples / picture.samples, off * off));
  }
}

}  // namespace scenec::backend
