// What decoded images tell the analysis of effects.
#include <algorithm>
#include <limits>
#include <type_traits>

#include "backend/backend.hpp"
#include "backend/build.hpp"

namespace scenec::backend {
namespace {

template <class T>
bool all_opaque(const std::vector<T>& samples, std::size_t channels) {
  const T full = std::is_integral_v<T> ? std::numeric_limits<T>::max() : T{1};
  for (std::size_t i = channels - 1; i < samples.size(); i += channels)
    if (samples[i] != full) return false;
  return true;
}

bool is_opaque(const DecodedImage& image) {
  if (image.channels != 2 && image.channels != 4) return true;  // no alpha channel
  return std::visit([&](const auto& samples) { return all_opaque(samples, image.channels); },
                    image.samples);
}

}  // namespace

ir::ImageFacts image_facts(const RenderScene& scene) {
  ir::ImageFacts facts(scene.images.size());
  for (std::size_t i = 0; i < facts.size(); ++i)
    if (scene.images[i]) facts[i].opaque = is_opaque(*scene.images[i]);
  return facts;
}

ir::EffectReport find_effects(const RenderScene& scene, const ir::RenderSettings& settings) {
  return ir::find_effects(*scene.scene, settings, image_facts(scene));
}

}  // namespace scenec::backend
