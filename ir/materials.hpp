// Every material, with the keys common to all (MaterialCommon).
#pragma once

#include <optional>
#include <string>
#include <tuple>
#include <variant>

#include "ir/schema.hpp"
#include "ir/values.hpp"

namespace scenec::ir {

struct Diffuse {
  ColorInput color;
};
template <>
struct Schema<Diffuse> {
  static constexpr std::string_view name = "diffuse";
  static constexpr std::string_view doc = "An ideal matt surface.";
  static constexpr auto keys =
      std::tuple{required(&Diffuse::color, "color", range::non_negative, "albedo")};
  static constexpr auto rules = no_rules;
};

struct Phong {
  ColorInput diffuse;
  ColorInput specular;
  NumberInput shininess{1, {}};
  ColorInput reflect;
  ColorInput refract;
  double ior = 1.5;
};
template <>
struct Schema<Phong> {
  static constexpr std::string_view name = "phong";
  static constexpr std::string_view doc =
      "The course's and Whitted's material: diffuse, specular lobe, mirror and refraction weights.";
  static constexpr auto keys = std::tuple{
      required(&Phong::diffuse, "diffuse", range::non_negative, "diffuse colour"),
      key(&Phong::specular, "specular", range::non_negative, "colour of the specular lobe"),
      key(&Phong::shininess, "shininess", range::non_negative, "exponent of the specular lobe"),
      key(&Phong::reflect, "reflect", range::non_negative, "weight of the mirror direction"),
      key(&Phong::refract, "refract", range::non_negative, "weight of the refracted direction"),
      key(&Phong::ior, "ior", range::positive, "index of refraction, inside over outside"),
  };
  static constexpr auto rules = no_rules;
};

struct Mirror {
  ColorInput color{white, {}};
};
template <>
struct Schema<Mirror> {
  static constexpr std::string_view name = "mirror";
  static constexpr std::string_view doc = "A perfect mirror.";
  static constexpr auto keys =
      std::tuple{key(&Mirror::color, "color", range::non_negative, "reflectance")};
  static constexpr auto rules = no_rules;
};

struct Dielectric {
  double ior = 1.5;
  ColorInput tint{white, {}};
  NumberInput roughness;
  Color absorption = black;
};
template <>
struct Schema<Dielectric> {
  static constexpr std::string_view name = "dielectric";
  static constexpr std::string_view doc =
      "Glass, water and other clear media: exact Fresnel reflection and refraction.";
  static constexpr auto keys = std::tuple{
      key(&Dielectric::ior, "ior", range::positive, "index of refraction, inside over outside"),
      key(&Dielectric::tint, "tint", range::non_negative, "factor on what passes the surface"),
      key(&Dielectric::roughness, "roughness", range::unit,
          "0 is smooth; alpha is roughness squared"),
      key(&Dielectric::absorption, "absorption", range::non_negative,
          "absorption coefficient inside [1/m]"),
  };
  static constexpr auto rules = no_rules;
};

enum class ConductorPreset : std::uint8_t {
  gold,
  silver,
  copper,
  aluminium,
  iron,
  brass,
  chromium,
  titanium
};
template <>
struct EnumNames<ConductorPreset> {
  static constexpr std::array<std::string_view, 8> names{"gold", "silver", "copper",   "aluminium",
                                                         "iron", "brass",  "chromium", "titanium"};
};
struct Conductor {
  std::optional<ConductorPreset> preset;
  std::optional<ColorInput> f0;
  std::optional<Color> eta;
  std::optional<Color> k;
  NumberInput roughness;
};
template <>
struct Schema<Conductor> {
  static constexpr std::string_view name = "conductor";
  static constexpr std::string_view doc = "A metal.";
  static constexpr auto keys = std::tuple{
      key(&Conductor::preset, "preset", range::any, "a metal by name; its constants are approximate"),
      key(&Conductor::f0, "f0", range::unit, "reflectance at normal incidence"),
      key(&Conductor::eta, "eta", range::positive, "real part of the index of refraction"),
      key(&Conductor::k, "k", range::non_negative, "imaginary part of the index of refraction"),
      key(&Conductor::roughness, "roughness", range::unit,
          "0 is smooth; alpha is roughness squared"),
  };
  static constexpr std::array rules{
      KeyRule{KeyRule::Kind::exactly_one, {"preset", "f0", "eta"}},
      KeyRule{KeyRule::Kind::together, {"eta", "k"}},
  };
};

struct Ggx {
  ColorInput base;
  ColorInput f0{{0.04, 0.04, 0.04}, {}};
  NumberInput roughness;
};
template <>
struct Schema<Ggx> {
  static constexpr std::string_view name = "ggx";
  static constexpr std::string_view doc =
      "A diffuse base under a rough coat that conserves energy.";
  static constexpr auto keys = std::tuple{
      required(&Ggx::base, "base", range::non_negative, "colour of the diffuse base"),
      key(&Ggx::f0, "f0", range::unit, "reflectance of the coat at normal incidence"),
      required(&Ggx::roughness, "roughness", range::unit,
               "0 is smooth; alpha is roughness squared"),
  };
  static constexpr auto rules = no_rules;
};

struct Mix {
  MaterialId a;
  MaterialId b;
  NumberInput weight;
};
template <>
struct Schema<Mix> {
  static constexpr std::string_view name = "mix";
  static constexpr std::string_view doc = "Two materials in a ratio.";
  static constexpr auto keys = std::tuple{
      required(&Mix::a, "a", range::any, "material where the weight is 0"),
      required(&Mix::b, "b", range::any, "material where the weight is 1"),
      required(&Mix::weight, "weight", range::unit, "share of b"),
  };
  static constexpr auto rules = no_rules;
};

// Keys every material has besides its own.
struct MaterialCommon {
  ColorInput emission;
  NumberInput opacity{1, {}};
  std::optional<double> cutout;
  TextureId normal_map;
  bool two_sided = false;
};
template <>
struct Schema<MaterialCommon> {
  static constexpr std::string_view name = "material";
  static constexpr std::string_view doc = "Keys common to all materials.";
  static constexpr auto keys = std::tuple{
      key(&MaterialCommon::emission, "emission", range::non_negative,
          "emitted radiance [W/m^2/sr]"),
      key(&MaterialCommon::opacity, "opacity", range::unit, "below 1 light passes at random"),
      key(&MaterialCommon::cutout, "cutout", range::unit,
          "opacity below this is a hole, above it solid"),
      key(&MaterialCommon::normal_map, "normal_map", range::any, "tangent-space normal image"),
      key(&MaterialCommon::two_sided, "two_sided", range::any, "emit from both sides"),
  };
  static constexpr auto rules = no_rules;
};

using MaterialKind = std::variant<Diffuse, Phong, Mirror, Dielectric, Conductor, Ggx, Mix>;
struct Material {
  MaterialKind kind;
  MaterialCommon common;
};

}  // namespace scenec::ir
