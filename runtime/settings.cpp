#include "runtime/settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "base/text.hpp"

namespace scenec::runtime {

namespace {

constexpr std::int64_t sample_cap = 1048576;  // of `--time` and `--error` without `--samples`

std::optional<ir::CameraId> find_camera(const ir::Scene& scene, const std::string& name,
                                        const Environment& environment) {
  std::vector<std::string_view> names;
  std::uint32_t index = 0;
  for (const ir::Declared& declared : scene.camera_names) {
    if (declared.name.valid()) {
      names.push_back(scene.names[declared.name]);
      if (names.back() == name) return ir::CameraId(index);
    }
    ++index;
  }
  environment.err << fmt::format("scenec: `--camera` is `{}`; the scene has {}\n", printable(name),
                                 names.empty() ? "no named camera" : quoted_list(names));
  return std::nullopt;
}

}  // namespace

std::optional<ir::RenderSettings> settings_of(const Options& options, const ir::Scene& scene,
                                              const Environment& environment) {
  ir::RenderSettings settings = scene.render;
  if (options.camera) {
    const auto camera = find_camera(scene, *options.camera, environment);
    if (!camera) return std::nullopt;
    settings.camera = *camera;
  }
  if (options.size) settings.size = *options.size;
  if (options.method) settings.method = *options.method;
  if (options.seed) settings.seed = *options.seed;
  if (options.region) settings.region = options.region;
  if (options.samples || options.error || options.time) {
    settings.samples = options.samples.value_or(sample_cap);
    settings.stop = {};
    settings.stop.error = options.error;
    settings.stop.time = options.time;
  }
  if (const auto& region = settings.region;
      region && (region->x1 > settings.size.width || region->y1 > settings.size.height)) {
    environment.err << fmt::format(
        "scenec: the region {},{},{},{} does not lie inside the picture of {}x{}\n", region->x0,
        region->y0, region->x1, region->y1, settings.size.width, settings.size.height);
    return std::nullopt;
  }
  return settings;
}

ir::ImageSize small_size(ir::ImageSize size) {
  constexpr double most_pixels = 20'000;
  const double pixels = static_cast<double>(size.width) * static_cast<double>(size.height);
  const double scale = std::min(1.0, std::sqrt(most_pixels / pixels));
  const auto part = [&](std::int64_t side) {
    return std::max<std::int64_t>(1, std::llround(scale * static_cast<double>(side)));
  };
  return {part(size.width), part(size.height)};
}

}  // namespace scenec::runtime
