// What a picture can reach of a scene, as far as effects depend on it: which traits placed
// materials have, with the first item that shows each, and what kinds of light there are.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "ir/folding.hpp"
#include "ir/render_settings.hpp"
#include "ir/scene.hpp"

namespace scenec::ir {

// What one material can do, mixes resolved into their parts.
enum class Trait : std::uint8_t {
  matt,         // scatters light in all directions
  glossy,       // a rough or Phong lobe
  mirror,       // reflects into exactly one direction
  clear,        // light passes the surface
  absorbing,    // light is lost inside
  textured,     // a value varies over the surface
  see_through,  // opacity can be below 1
  normal_map,
  emissive,
  bends,          // its index is not 1
  glossy_within,  // index 1: glossy, or a mirror, but only inside a body of another index
  mirror_within
};
inline constexpr std::size_t trait_count = 12;

struct TraitWitness {
  bool present = false;
  MaterialId material;
  OriginId item;        // the first that shows it
  bool within = false;  // only inside a body of another index
};

struct EffectWalk {
  static constexpr std::uint64_t many = 1'000'000;  // counts stop here

  std::array<TraitWitness, trait_count> traits;
  std::uint64_t placements = 0;       // shapes, each as often as it is placed
  std::uint64_t flat_placements = 0;  // planes, triangles, quads, disks
  // Shapes light passes into; those whose parts may lie in each other count twice.
  std::uint64_t clear_placements = 0;
  OriginId second_clear;

  std::uint64_t lights = 0;        // to aim at: all but constant surroundings
  std::uint64_t area_lights = 0;   // of them, those with an area
  std::uint64_t light_shapes = 0;  // lights that have a shape of their own
  OriginId second_light;
  OriginId area_light;
  Id<Light> area_light_id;    // invalid: it is an emissive material
  bool surroundings = false;  // light comes from outside
  std::string surroundings_reason;
  OriginId surroundings_origin;

  [[nodiscard]] const TraitWitness& of(Trait trait) const {
    return traits[static_cast<std::size_t>(trait)];
  }
  [[nodiscard]] std::string area_light_reason(const Scene& scene) const;
};

[[nodiscard]] EffectWalk walk_for_effects(const Scene& scene, const RenderSettings& settings,
                                          const ImageFacts& images);

}  // namespace scenec::ir
