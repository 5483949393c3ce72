// Every light. Lights are stored in world space: the groups above them are applied at lowering.
#pragma once

#include <optional>
#include <tuple>
#include <variant>

#include "ir/schema.hpp"
#include "ir/values.hpp"

namespace scenec::ir {

enum class Decay : std::uint8_t { inverse_square, none };
template <>
struct EnumNames<Decay> {
  static constexpr std::array<std::string_view, 2> names{"inverse_square", "none"};
};

// `power` is the total radiant flux a channel; it is multiplied by `color`, as is intensity.
struct PointLight {
  Point3 position;
  std::optional<double> intensity;
  std::optional<Power> power;
  Decay decay = Decay::inverse_square;
  Color color = white;
};
template <>
struct Schema<PointLight> {
  static constexpr std::string_view name = "point";
  static constexpr std::string_view doc = "Light from a point, the same in all directions.";
  static constexpr auto keys = std::tuple{
      required(&PointLight::position, "position", range::any, "where it is"),
      key(&PointLight::intensity, "intensity", range::non_negative, "radiant intensity [W/sr]"),
      key(&PointLight::power, "power", range::non_negative, "total power"),
      key(&PointLight::decay, "decay", range::any, "how it weakens with distance"),
      key(&PointLight::color, "color", range::non_negative, "factor a channel"),
  };
  static constexpr std::array rules{KeyRule{KeyRule::Kind::exactly_one, {"intensity", "power"}}};
};

struct SpotLight {
  Point3 position;
  Direction direction;
  Angle angle;
  Angle falloff;
  std::optional<double> intensity;
  std::optional<Power> power;
  Decay decay = Decay::inverse_square;
  Color color = white;
};
template <>
struct Schema<SpotLight> {
  static constexpr std::string_view name = "spot";
  static constexpr std::string_view doc = "Light from a point into a cone.";
  static constexpr auto keys = std::tuple{
      required(&SpotLight::position, "position", range::any, "where it is"),
      required(&SpotLight::direction, "direction", range::any,
               "axis of the cone, away from the light"),
      required(&SpotLight::angle, "angle",
               Range{.low = 0, .high = 6.283185307179586, .low_open = true},
               "full angle of the cone"),
      key(&SpotLight::falloff, "falloff", range::non_negative,
          "width of the soft edge inside the cone"),
      key(&SpotLight::intensity, "intensity", range::non_negative,
          "radiant intensity on the axis [W/sr]"),
      key(&SpotLight::power, "power", range::non_negative,
          "total power if it shone in all directions"),
      key(&SpotLight::decay, "decay", range::any, "how it weakens with distance"),
      key(&SpotLight::color, "color", range::non_negative, "factor a channel"),
  };
  static constexpr std::array rules{KeyRule{KeyRule::Kind::exactly_one, {"intensity", "power"}}};
};

struct DirectionalLight {
  Direction direction;
  double irradiance = 1;
  Color color = white;
};
template <>
struct Schema<DirectionalLight> {
  static constexpr std::string_view name = "directional";
  static constexpr std::string_view doc = "Parallel light, as from the sun.";
  static constexpr auto keys = std::tuple{
      required(&DirectionalLight::direction, "direction", range::any, "direction of travel"),
      required(&DirectionalLight::irradiance, "irradiance", range::non_negative,
               "on a surface facing it [W/m^2]"),
      key(&DirectionalLight::color, "color", range::non_negative, "factor a channel"),
  };
  static constexpr auto rules = no_rules;
};

struct SphereLight {
  Point3 center;
  Length radius{1};
  std::optional<double> radiance;
  std::optional<Power> power;
  bool visible = true;
  Color color = white;
};
template <>
struct Schema<SphereLight> {
  static constexpr std::string_view name = "sphere";
  static constexpr std::string_view doc = "A glowing sphere.";
  static constexpr auto keys = std::tuple{
      required(&SphereLight::center, "center", range::any, "centre"),
      required(&SphereLight::radius, "radius", range::positive, "radius"),
      key(&SphereLight::radiance, "radiance", range::non_negative, "emitted radiance [W/m^2/sr]"),
      key(&SphereLight::power, "power", range::non_negative, "total power"),
      key(&SphereLight::visible, "visible", range::any, "whether the camera sees it"),
      key(&SphereLight::color, "color", range::non_negative, "factor a channel"),
  };
  static constexpr std::array rules{KeyRule{KeyRule::Kind::exactly_one, {"radiance", "power"}}};
};

struct QuadLight {
  Point3 corner;
  Point3 edge_u;
  Point3 edge_v;
  std::optional<double> radiance;
  std::optional<Power> power;
  bool visible = true;
  Color color = white;
};
template <>
struct Schema<QuadLight> {
  static constexpr std::string_view name = "quad";
  static constexpr std::string_view doc =
      "A glowing parallelogram; it emits along edge_u x edge_v.";
  static constexpr auto keys = std::tuple{
      required(&QuadLight::corner, "corner", range::any, "one corner"),
      required(&QuadLight::edge_u, "edge_u", range::any, "first edge from the corner"),
      required(&QuadLight::edge_v, "edge_v", range::any, "second edge from the corner"),
      key(&QuadLight::radiance, "radiance", range::non_negative, "emitted radiance [W/m^2/sr]"),
      key(&QuadLight::power, "power", range::non_negative, "total power"),
      key(&QuadLight::visible, "visible", range::any, "whether the camera sees it"),
      key(&QuadLight::color, "color", range::non_negative, "factor a channel"),
  };
  static constexpr std::array rules{KeyRule{KeyRule::Kind::exactly_one, {"radiance", "power"}}};
};

struct DiskLight {
  Point3 center;
  Direction normal;
  Length radius;
  std::optional<double> radiance;
  std::optional<Power> power;
  bool visible = true;
  Color color = white;
};
template <>
struct Schema<DiskLight> {
  static constexpr std::string_view name = "disk";
  static constexpr std::string_view doc = "A glowing disk; it emits along its normal.";
  static constexpr auto keys = std::tuple{
      required(&DiskLight::center, "center", range::any, "centre"),
      required(&DiskLight::normal, "normal", range::any, "direction it emits to"),
      required(&DiskLight::radius, "radius", range::positive, "radius"),
      key(&DiskLight::radiance, "radiance", range::non_negative, "emitted radiance [W/m^2/sr]"),
      key(&DiskLight::power, "power", range::non_negative, "total power"),
      key(&DiskLight::visible, "visible", range::any, "whether the camera sees it"),
      key(&DiskLight::color, "color", range::non_negative, "factor a channel"),
  };
  static constexpr std::array rules{KeyRule{KeyRule::Kind::exactly_one, {"radiance", "power"}}};
};

struct EnvironmentLight {
  TextureId image;
  std::optional<Color> constant;
  double gain = 1;
  Angle rotation;
  Color color = white;
};
template <>
struct Schema<EnvironmentLight> {
  static constexpr std::string_view name = "environment";
  static constexpr std::string_view doc = "Light from infinitely far away, all round.";
  static constexpr auto keys = std::tuple{
      key(&EnvironmentLight::image, "image", range::any, "latitude-longitude image"),
      key(&EnvironmentLight::constant, "constant", range::non_negative,
          "the same radiance from everywhere"),
      key(&EnvironmentLight::gain, "gain", range::non_negative, "factor on the radiance"),
      key(&EnvironmentLight::rotation, "rotation", range::any, "turn about +y"),
      key(&EnvironmentLight::color, "color", range::non_negative, "factor a channel"),
  };
  static constexpr std::array rules{KeyRule{KeyRule::Kind::exactly_one, {"image", "constant"}}};
};

using LightKind = std::variant<PointLight, SpotLight, DirectionalLight, SphereLight, QuadLight,
                               DiskLight, EnvironmentLight>;
struct Light {
  LightKind kind;
};

}  // namespace scenec::ir
