// The extra layers of a picture. Values of surfaces are means over the samples that hit one; where
// none did they are 0. `variance` is that of the pixel's mean; 0 where it is not known.
// `trust` counts the samples that are not in the pixel as they were: `trust.dropped` were not
// finite and were left out, `trust.saturated` were beyond what a sum holds and were cut; and those
// whose camera ray first met a surface where it is not proven to, `trust.uncertified`. There is no
// count of hits of a surface by a ray leaving it: rays start outside the error of their origin, so
// none is refused.
#include <algorithm>
#include <cmath>

#include "backend/film/film.hpp"

namespace scenec::backend {
namespace {

template <class F>
void append(Picture& picture, const char* name, std::size_t pixels, const F& value) {
  std::vector<float> data(pixels);
  for (std::size_t i = 0; i < pixels; ++i) data[i] = static_cast<float>(value(i));
  picture.layers.emplace_back(name, std::move(data));
}

}  // namespace

void Film::append_layers(Picture& picture) const {
  const std::size_t n = sums_.size();
  const auto mean = [&](const FixedSum& sum, std::size_t i) {
    return sum.value() / std::max(1, sums_.at(i).hits);
  };
  for (const ir::Aov aov : settings_.aovs) {
    switch (aov) {
      case ir::Aov::albedo:
        append(picture, "albedo.R", n,
               [&](std::size_t i) { return mean(extra_.at(i).albedo[0], i); });
        append(picture, "albedo.G", n,
               [&](std::size_t i) { return mean(extra_.at(i).albedo[1], i); });
        append(picture, "albedo.B", n,
               [&](std::size_t i) { return mean(extra_.at(i).albedo[2], i); });
        break;
      case ir::Aov::normal:
        append(picture, "N.X", n, [&](std::size_t i) { return mean(extra_.at(i).normal[0], i); });
        append(picture, "N.Y", n, [&](std::size_t i) { return mean(extra_.at(i).normal[1], i); });
        append(picture, "N.Z", n, [&](std::size_t i) { return mean(extra_.at(i).normal[2], i); });
        break;
      case ir::Aov::position:
        append(picture, "P.X", n, [&](std::size_t i) { return mean(extra_.at(i).position[0], i); });
        append(picture, "P.Y", n, [&](std::size_t i) { return mean(extra_.at(i).position[1], i); });
        append(picture, "P.Z", n, [&](std::size_t i) { return mean(extra_.at(i).position[2], i); });
        break;
      case ir::Aov::depth:
        append(picture, "Z", n, [&](std::size_t i) { return mean(extra_.at(i).depth, i); });
        break;
      case ir::Aov::uv:
        append(picture, "UV.X", n, [&](std::size_t i) { return mean(extra_.at(i).uv[0], i); });
        append(picture, "UV.Y", n, [&](std::size_t i) { return mean(extra_.at(i).uv[1], i); });
        break;
      case ir::Aov::ids:
        // 0 is nothing, so numbers start at 1.
        append(picture, "id.item", n, [&](std::size_t i) {
          return extra_.at(i).identified ? extra_.at(i).item + 1.0 : 0.0;
        });
        append(picture, "id.material", n, [&](std::size_t i) {
          return extra_.at(i).identified ? extra_.at(i).material + 1.0 : 0.0;
        });
        break;
      case ir::Aov::variance: {
        const char* names[3] = {"variance.R", "variance.G", "variance.B"};
        for (std::size_t c = 0; c < 3; ++c) {
          append(picture, names[c], n, [&](std::size_t i) {
            const auto means = replicate_means(i);
            return means ? variance_of_mean(*means, c) : 0.0;
          });
        }
        break;
      }
      case ir::Aov::samples:
        append(picture, "samples.Y", n,
               [&](std::size_t i) { return static_cast<double>(sums_.at(i).count); });
        break;
      case ir::Aov::trust:
        append(picture, "trust.dropped", n,
               [&](std::size_t i) { return static_cast<double>(distrust_.at(i).dropped); });
        append(picture, "trust.saturated", n,
               [&](std::size_t i) { return static_cast<double>(distrust_.at(i).saturated); });
        append(picture, "trust.uncertified", n,
               [&](std::size_t i) { return static_cast<double>(distrust_.at(i).uncertified); });
        break;
    }
  }
}

}  // namespace scenec::backend
