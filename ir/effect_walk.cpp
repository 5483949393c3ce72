#include "ir/effect_walk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bitset>
#include <optional>
#include <type_traits>
#include <unordered_map>
#include <vector>

#include "ir/roughness.hpp"

namespace scenec::ir {
namespace {

using Traits = std::bitset<trait_count>;

void add(Traits& traits, Trait trait, bool present = true) {
  if (present) traits.set(static_cast<std::size_t>(trait));
}
bool has(const Traits& traits, Trait trait) {
  return traits[static_cast<std::size_t>(trait)];
}

// The traits of materials, found once each.
class MaterialTraits {
 public:
  MaterialTraits(const Scene& scene, const ImageFacts& images)
      : scene_(scene), folding_(scene, images), known_(scene.materials.size()) {}

  // References are acyclic, so this ends.
  const Traits& of(MaterialId id) {
    std::optional<Traits>& known = known_[id.value()];
    if (!known) known = find(scene_.materials[id]);
    return *known;
  }

 private:
  Traits find(const Material& material) {
    Traits traits;
    const MaterialCommon& common = material.common;
    add(traits, Trait::emissive, !folding_.is_black(common.emission));
    add(traits, Trait::see_through, !folding_.is(common.opacity, 1));
    add(traits, Trait::normal_map, common.normal_map.valid());
    // A constant normal map still bends normals, and is still looked up.
    add(traits, Trait::textured, common.normal_map.valid());
    add(traits, Trait::textured, varies(common));
    std::visit(
        [&](const auto& kind) {
          add(traits, Trait::textured, varies(kind));
          lobes(kind, traits);
        },
        material.kind);
    return traits;
  }

  template <class T>
  [[nodiscard]] bool varies(const T& part) const {
    bool found = false;
    visit_keys<T>([&](const auto& key) { found = found || input_varies(part.*key.member); });
    return found;
  }
  template <class M>
  [[nodiscard]] bool input_varies(const M& value) const {
    if constexpr (std::is_same_v<M, ColorInput>) {
      return !folding_.color(value);
    } else if constexpr (std::is_same_v<M, NumberInput>) {
      return !folding_.number(value);
    } else if constexpr (std::is_same_v<M, std::optional<ColorInput>>) {
      return value && !folding_.color(*value);
    } else {
      return false;
    }
  }

  // Whether alpha = roughness squared can be below, and at or above, what counts as smooth.
  [[nodiscard]] bool can_be_smooth(const NumberInput& roughness) const {
    const std::optional<double> r = folding_.number(roughness);
    return !r || *r * *r < specular_alpha;
  }
  [[nodiscard]] bool can_be_rough(const NumberInput& roughness) const {
    const std::optional<double> r = folding_.number(roughness);
    return !r || *r * *r >= specular_alpha;
  }

  void lobes(const Diffuse& m, Traits& traits) const {
    add(traits, Trait::matt, !folding_.is_black(m.color));
  }
  void lobes(const Phong& m, Traits& traits) const {
    add(traits, Trait::matt, !folding_.is_black(m.diffuse));
    add(traits, Trait::glossy, !folding_.is_black(m.specular));
    add(traits, Trait::mirror, !folding_.is_black(m.reflect));
    // What cannot leave the body is reflected at its surface.
    const bool clear = !folding_.is_black(m.refract);
    add(traits, Trait::clear, clear);
    add(traits, Trait::mirror, clear && m.ior != 1);
    add(traits, Trait::bends, clear && m.ior != 1);
    add(traits, Trait::mirror_within, clear && m.ior == 1);
  }
  void lobes(const Mirror& m, Traits& traits) const {
    add(traits, Trait::mirror, !folding_.is_black(m.color));
  }
  void lobes(const Dielectric& m, Traits& traits) const {
    add(traits, Trait::absorbing, m.absorption != black);
    add(traits, Trait::clear);
    const bool bends = m.ior != 1;
    add(traits, Trait::bends, bends);
    add(traits, bends ? Trait::mirror : Trait::mirror_within, can_be_smooth(m.roughness));
    add(traits, bends ? Trait::glossy : Trait::glossy_within, can_be_rough(m.roughness));
  }
  void lobes(const Conductor& m, Traits& traits) const {
    // Black f0 too: at grazing angles everything reflects.
    add(traits, Trait::mirror, can_be_smooth(m.roughness));
    add(traits, Trait::glossy, can_be_rough(m.roughness));
  }
  void lobes(const Ggx& m, Traits& traits) const {
    add(traits, Trait::matt, !folding_.is_black(m.base));
    add(traits, Trait::mirror, can_be_smooth(m.roughness));
    add(traits, Trait::glossy, can_be_rough(m.roughness));
  }
  void lobes(const Mix& m, Traits& traits) {
    // A part whose weight is 0 everywhere does not show.
    if (!folding_.is(m.weight, 1)) traits |= of(m.a);
    if (!folding_.is(m.weight, 0)) traits |= of(m.b);
  }

  const Scene& scene_;
  Folding folding_;
  std::vector<std::optional<Traits>> known_;
};

class Walker {
 public:
  Walker(const Scene& scene, const RenderSettings& settings, const ImageFacts& images)
      : scene_(scene), settings_(settings), traits_(scene, images) {}

  EffectWalk walk() {
    for (const Item& item : scene_.items) place(item, {});
    lights();
    settle_bodies();
    return std::move(walk_);
  }

 private:
  struct Counts {
    std::uint64_t placements = 0, flat = 0, clear = 0, emitters = 0;
  };

  // A bubble of index 1 does nothing in air, and everything in glass.
  void settle_bodies() {
    if (walk_.clear_placements < 2 || !walk_.of(Trait::bends).present) return;
    const auto take = [&](Trait trait, Trait within) {
      TraitWitness& found = walk_.traits[static_cast<std::size_t>(trait)];
      if (found.present || !walk_.of(within).present) return;
      found = walk_.of(within);
      found.within = true;
    };
    take(Trait::mirror, Trait::mirror_within);
    take(Trait::glossy, Trait::glossy_within);
  }

  static std::uint64_t sum(std::uint64_t a, std::uint64_t b) {
    return std::min(a + b, EffectWalk::many);
  }

  void place(const Item& item, MaterialId replaced) {
    const Counts c = counts_of(item, replaced, item.origin);
    if (walk_.clear_placements < 2 && walk_.clear_placements + c.clear >= 2)
      walk_.second_clear = item.origin;
    walk_.placements = sum(walk_.placements, c.placements);
    walk_.flat_placements = sum(walk_.flat_placements, c.flat);
    walk_.clear_placements = sum(walk_.clear_placements, c.clear);
    if (c.emitters == 0) return;
    if (walk_.area_lights == 0) walk_.area_light = item.origin;
    add_lights(c.emitters, item.origin);
    walk_.area_lights = sum(walk_.area_lights, c.emitters);
  }

  void add_lights(std::uint64_t count, OriginId origin) {
    if (walk_.lights < 2 && walk_.lights + count >= 2) walk_.second_light = origin;
    walk_.lights = sum(walk_.lights, count);
  }

  // `outer`: the material of the outermost instance that has one, which replaces all inside.
  Counts counts_of(const Item& item, MaterialId outer, OriginId witness) {
    const MaterialId material = outer.valid() ? outer : item.material;
    if (const auto* instance = std::get_if<Id<Instance>>(&item.shape))
      return counts_of_proto(scene_.shape(*instance).of, material, witness);
    if (!material.valid()) return {};
    const Traits& traits = traits_.of(material);
    for (std::size_t i = 0; i < trait_count; ++i)
      if (traits[i] && !walk_.traits[i].present)
        walk_.traits[i] = {true, source_of(material, static_cast<Trait>(i)), witness, false};
    Counts c;
    c.placements = 1;
    c.flat = is_flat(item) ? 1 : 0;
    c.clear = !has(traits, Trait::clear) ? 0 : may_nest(item) ? 2 : 1;
    c.emitters = has(traits, Trait::emissive) ? pieces_of(item) : 0;
    return c;
  }

  // Protos are walked once for each material that replaces theirs.
  Counts counts_of_proto(ProtoId proto, MaterialId material, OriginId witness) {
    const std::uint64_t key =
        (static_cast<std::uint64_t>(proto.value()) << 32) | std::uint64_t{material.value()};
    if (const auto found = protos_.find(key); found != protos_.end()) return found->second;
    Counts total;
    for (const Item& item : scene_.protos[proto].items) {
      const Counts c = counts_of(item, material, witness);
      total = {sum(total.placements, c.placements), sum(total.flat, c.flat),
               sum(total.clear, c.clear), sum(total.emitters, c.emitters)};
    }
    protos_.emplace(key, total);
    return total;
  }

  // The part of a mix that has the trait, to be named to the author.
  MaterialId source_of(MaterialId id, Trait trait) {
    const auto* mix = std::get_if<Mix>(&scene_.materials[id].kind);
    if (mix == nullptr) return id;
    for (const MaterialId part : {mix->a, mix->b})
      if (has(traits_.of(part), trait)) return source_of(part, trait);
    return id;
  }

  static bool is_flat(const Item& item) {
    return std::holds_alternative<Id<Plane>>(item.shape) ||
           std::holds_alternative<Id<Triangle>>(item.shape) ||
           std::holds_alternative<Id<Quad>>(item.shape) ||
           std::holds_alternative<Id<Disk>>(item.shape);
  }
  // Shapes that are not convex by kind: a mesh may hold one shell within another, an outline cross
  // itself.
  static bool may_nest(const Item& item) {
    return std::holds_alternative<Id<Mesh>>(item.shape) ||
           std::holds_alternative<Id<Revolve>>(item.shape);
  }
  // At least so many pieces a light of this shape is aimed at in; more than one counts as two.
  static std::uint64_t pieces_of(const Item& item) {
    return is_flat(item) || std::holds_alternative<Id<Sphere>>(item.shape) ? 1 : 2;
  }

  void lights() {
    for (std::uint32_t i = 0; i < scene_.lights.size(); ++i) {
      const Id<Light> id(i);
      std::visit([&](const auto& light) { add_light(light, id); }, scene_.lights[id].kind);
    }
    if (settings_.method == Method::path && settings_.background != black && !walk_.surroundings) {
      walk_.surroundings = true;
      walk_.surroundings_reason = "the background gives light";
      walk_.surroundings_origin = scene_.render_origin;
    }
  }

  template <class L>
  void add_light(const L& light, Id<Light> id) {
    if (light.color == black) return;
    const OriginId origin = scene_.light_names[id].origin;
    if constexpr (std::is_same_v<L, EnvironmentLight>) {
      if (light.gain == 0 || light.constant == black) return;
      walk_.surroundings = true;
      walk_.surroundings_reason = light.constant ? "a constant environment gives light"
                                                 : "the image of an environment gives light";
      walk_.surroundings_origin = origin;
      if (!light.constant) add_lights(1, origin);
    } else if constexpr (requires { light.irradiance; }) {
      if (light.irradiance > 0) add_lights(1, origin);
    } else if constexpr (requires { light.intensity; }) {
      if (light.intensity.value_or(0) > 0 || (light.power && light.power->value > 0))
        add_lights(1, origin);
    } else {
      if (!(light.radiance.value_or(0) > 0) && !(light.power && light.power->value > 0)) return;
      add_lights(1, origin);
      walk_.light_shapes = sum(walk_.light_shapes, 1);
      if (walk_.area_lights == 0) {
        walk_.area_light = origin;
        walk_.area_light_id = id;
      }
      walk_.area_lights = sum(walk_.area_lights, 1);
    }
  }

  const Scene& scene_;
  const RenderSettings& settings_;
  MaterialTraits traits_;
  std::unordered_map<std::uint64_t, Counts> protos_;
  EffectWalk walk_;
};

}  // namespace

std::string EffectWalk::area_light_reason(const Scene& scene) const {
  if (!area_light_id.valid()) return "a placed material emits light";
  const NameId name = scene.light_names[area_light_id].name;
  return name.valid() ? fmt::format("light `{}` has an area", scene.names[name])
                      : "a light has an area";
}

EffectWalk walk_for_effects(const Scene& scene, const RenderSettings& settings,
                            const ImageFacts& images) {
  return Walker(scene, settings, images).walk();
}

}  // namespace scenec::ir
