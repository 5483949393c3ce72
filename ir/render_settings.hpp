// How the picture is made: the `render` block.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <tuple>
#include <vector>

#include "ir/schema.hpp"
#include "ir/values.hpp"

namespace scenec::ir {

enum class Method : std::uint8_t { path, whitted, phong };
template <>
struct EnumNames<Method> {
  static constexpr std::array<std::string_view, 3> names{"path", "whitted", "phong"};
};
enum class FilterKind : std::uint8_t { tent, box, gaussian, mitchell, blackman_harris };
template <>
struct EnumNames<FilterKind> {
  static constexpr std::array<std::string_view, 5> names{"tent", "box", "gaussian", "mitchell",
                                                         "blackman_harris"};
};
// Written `tent(1.0)` or `.box` (then with the kind's usual radius), radius in pixels.
struct PixelFilter {
  FilterKind kind = FilterKind::tent;
  double radius = 1;
  friend constexpr auto operator<=>(const PixelFilter&, const PixelFilter&) = default;
};
[[nodiscard]] constexpr double usual_radius(FilterKind kind) {
  constexpr std::array radii{1.0, 0.5, 1.5, 2.0, 1.5};
  return radii[static_cast<std::size_t>(kind)];
}
enum class FilmKind : std::uint8_t { standard, course };
template <>
struct EnumNames<FilmKind> {
  static constexpr std::array<std::string_view, 2> names{"standard", "course"};
};
enum class Tonemap : std::uint8_t { srgb, none };
template <>
struct EnumNames<Tonemap> {
  static constexpr std::array<std::string_view, 2> names{"srgb", "none"};
};
enum class SamplerKind : std::uint8_t { sobol, independent };
template <>
struct EnumNames<SamplerKind> {
  static constexpr std::array<std::string_view, 2> names{"sobol", "independent"};
};
enum class Aov : std::uint8_t {
  albedo,
  normal,
  depth,
  position,
  uv,
  ids,
  variance,
  samples,
  trust
};
template <>
struct EnumNames<Aov> {
  static constexpr std::array<std::string_view, 9> names{
      "albedo", "normal", "depth", "position", "uv", "ids", "variance", "samples", "trust"};
};

struct ImageSize {
  std::int64_t width = 640;
  std::int64_t height = 480;
  friend constexpr auto operator<=>(const ImageSize&, const ImageSize&) = default;
};
// Pixels [x0, x1) x [y0, y1) from the top left.
struct Region {
  std::int64_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  friend constexpr auto operator<=>(const Region&, const Region&) = default;
};

struct Stop {
  std::optional<double> error;
  std::optional<Time> time;
  std::optional<std::int64_t> samples;
};
template <>
struct Schema<Stop> {
  static constexpr std::string_view name = "stop";
  static constexpr std::string_view doc = "When the picture is good enough; whichever comes first.";
  static constexpr auto keys = std::tuple{
      key(&Stop::error, "error", range::positive, "relative error of the image"),
      key(&Stop::time, "time", range::positive, "render time"),
      key(&Stop::samples, "samples", range::between(1, 1048576), "samples a pixel"),
  };
  static constexpr auto rules = no_rules;
};

enum class EffectSwitch : std::uint8_t { automatic, off };
template <>
struct EnumNames<EffectSwitch> {
  static constexpr std::array<std::string_view, 2> names{"auto", "off"};
};
struct EffectSwitches {
  EffectSwitch shadows{}, reflection{}, refraction{}, absorption{}, glossy{}, interreflection{},
      caustics{}, textures{}, alpha{}, normal_maps{}, area_lights{}, environment{}, many_lights{},
      depth_of_field{}, nested_media{};
};
template <>
struct Schema<EffectSwitches> {
  static constexpr std::string_view name = "effects";
  static constexpr std::string_view doc = "Effects the author switches off; the picture says so.";
  static constexpr auto keys = std::tuple{
      key(&EffectSwitches::shadows, "shadows", range::any, "light that is blocked"),
      key(&EffectSwitches::reflection, "reflection", range::any, "mirror reflection"),
      key(&EffectSwitches::refraction, "refraction", range::any, "light through clear media"),
      key(&EffectSwitches::absorption, "absorption", range::any, "light lost inside clear media"),
      key(&EffectSwitches::glossy, "glossy", range::any, "blurred reflection and refraction"),
      key(&EffectSwitches::interreflection, "interreflection", range::any,
          "light between matt surfaces"),
      key(&EffectSwitches::caustics, "caustics", range::any, "light gathered by mirrors and glass"),
      key(&EffectSwitches::textures, "textures", range::any, "values that vary over a surface"),
      key(&EffectSwitches::alpha, "alpha", range::any, "opacity below 1 and cut-outs"),
      key(&EffectSwitches::normal_maps, "normal_maps", range::any, "normals from images"),
      key(&EffectSwitches::area_lights, "area_lights", range::any,
          "soft shadows of lights with an area"),
      key(&EffectSwitches::environment, "environment", range::any, "light from all round"),
      key(&EffectSwitches::many_lights, "many_lights", range::any, "choice among many lights"),
      key(&EffectSwitches::depth_of_field, "depth_of_field", range::any,
          "blur off the sharp distance"),
      key(&EffectSwitches::nested_media, "nested_media", range::any,
          "clear media inside each other"),
  };
  static constexpr auto rules = no_rules;
};

struct RenderSettings {
  CameraId camera;  // invalid only in a scene without cameras
  ImageSize size;
  Method method = Method::path;
  std::optional<std::int64_t> samples;
  std::optional<std::int64_t> max_depth;
  std::int64_t seed = 0;
  PixelFilter filter;
  FilmKind film = FilmKind::standard;
  Color background = black;
  bool background_written =
      false;  // not a key: with an environment a written background replaces it for camera rays
  double exposure = 0;
  Tonemap tonemap = Tonemap::srgb;
  SamplerKind sampler = SamplerKind::sobol;
  std::vector<Aov> aovs;
  std::optional<Region> region;
  Stop stop;
  EffectSwitches effects;
};
template <>
struct Schema<RenderSettings> {
  static constexpr std::string_view name = "render";
  static constexpr std::string_view doc = "How the picture is made.";
  static constexpr auto keys = std::tuple{
      key(&RenderSettings::camera, "camera", range::any, "which camera, if there are several"),
      key(&RenderSettings::size, "size", range::between(1, 65535), "width and height in pixels"),
      key(&RenderSettings::method, "method", range::any, "how light is followed"),
      key(&RenderSettings::samples, "samples", range::between(1, 1048576), "samples a pixel"),
      key(&RenderSettings::max_depth, "max_depth", range::between(0, 1024),
          "bounces at most; none: chance ends paths"),
      key(&RenderSettings::seed, "seed", range::non_negative, "seed of all random choices"),
      key(&RenderSettings::filter, "filter", range::any, "pixel filter"),
      key(&RenderSettings::film, "film", range::any, "how samples become bytes"),
      key(&RenderSettings::background, "background", range::non_negative,
          "what a ray that leaves the scene sees"),
      key(&RenderSettings::exposure, "exposure", range::any, "stops; each doubles the picture"),
      key(&RenderSettings::tonemap, "tonemap", range::any, "transfer curve of 8-bit output"),
      key(&RenderSettings::sampler, "sampler", range::any, "kind of random numbers"),
      key(&RenderSettings::aovs, "aovs", range::any, "extra layers"),
      key(&RenderSettings::region, "region", range::non_negative,
          "pixels to render: [x0, y0, x1, y1)"),
      key(&RenderSettings::stop, "stop", range::any, "when to stop"),
      key(&RenderSettings::effects, "effects", range::any, "effects switched off"),
  };
  static constexpr std::array rules{
      KeyRule{KeyRule::Kind::at_most_one, {"samples", "stop.samples"}}};
};

}  // namespace scenec::ir
