#include "ir/effects.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "ir/effect_walk.hpp"

namespace scenec::ir {

namespace {

template <class F>
void with_key(Effect effect, F&& f) {
  std::size_t index = 0;
  visit_keys<EffectSwitches>([&](const auto& key) {
    if (index++ == static_cast<std::size_t>(effect)) f(key);
  });
}

// The findings of one scene, made one effect after the other.
class Finder {
 public:
  Finder(const Scene& scene, const RenderSettings& settings, const ImageFacts& images)
      : scene_(scene), settings_(settings), walk_(walk_for_effects(scene, settings, images)) {}

  EffectReport find() {
    light_transport();
    surfaces();
    lights();
    lens();
    for (std::size_t i = 0; i < effect_count; ++i)
      report_.findings[i].switched_off = is_switched_off(settings_.effects, static_cast<Effect>(i));
    return std::move(report_);
  }

 private:
  void on(Effect effect, std::string reason, OriginId witness) {
    report_.findings[static_cast<std::size_t>(effect)] = {true, false, std::move(reason), witness};
  }
  void off(Effect effect, std::string reason) {
    report_.findings[static_cast<std::size_t>(effect)] = {false, false, std::move(reason), {}};
  }
  // On when something that is placed has the trait, off with `absence` otherwise.
  void by_trait(Effect effect, Trait trait, std::string_view what, std::string absence) {
    const TraitWitness& found = walk_.of(trait);
    if (!found.present) return off(effect, std::move(absence));
    on(effect,
       fmt::format("{} {}{}", material_name(found.material), what,
                   found.within ? " inside another body" : ""),
       found.item);
  }

  [[nodiscard]] std::string material_name(MaterialId id) const {
    if (id.valid()) {
      const NameId name = scene_.material_names[id].name;
      if (name.valid()) return fmt::format("material `{}`", scene_.names[name]);
    }
    return "an unnamed material";
  }

  [[nodiscard]] bool follows_light() const { return settings_.method != Method::phong; }
  [[nodiscard]] bool lit() const { return walk_.lights != 0 || walk_.surroundings; }
  [[nodiscard]] bool scatters() const {
    return walk_.of(Trait::matt).present || walk_.of(Trait::glossy).present;
  }
  [[nodiscard]] const TraitWitness& scatterer() const {
    const TraitWitness& matt = walk_.of(Trait::matt);
    return matt.present ? matt : walk_.of(Trait::glossy);
  }

  void light_transport() {
    shadows();
    interreflection();
    caustics();
  }

  void shadows() {
    if (!follows_light()) return off(Effect::shadows, "`.phong` casts no shadows");
    if (!lit()) return off(Effect::shadows, "nothing gives light");
    if (!scatters()) return off(Effect::shadows, "no matt or rough surface is lit");
    if (walk_.placements == 1 && walk_.flat_placements == 1 && walk_.light_shapes <= 1)
      return off(Effect::shadows, "a single flat shape cannot stand in its own light");
    on(Effect::shadows, fmt::format("{} is lit and can be in shadow", shapes_in_words()),
       scatterer().item);
  }

  [[nodiscard]] std::string shapes_in_words() const {
    if (walk_.placements == 1) return "one shape";
    return walk_.placements >= EffectWalk::many
               ? "every one of many shapes"
               : fmt::format("each of {} shapes", walk_.placements);
  }

  void interreflection() {
    constexpr Effect effect = Effect::interreflection;
    if (settings_.method != Method::path)
      return off(effect, fmt::format("`.{}` follows no light from matt to matt surfaces",
                                     settings_.method == Method::phong ? "phong" : "whitted"));
    if (!lit()) return off(effect, "nothing gives light");
    if (!scatters()) return off(effect, "no matt or rough surface hands light on");
    if (settings_.max_depth && *settings_.max_depth <= 1)
      return off(effect, fmt::format("`max_depth` is {}", *settings_.max_depth));
    if (walk_.placements == 1 && walk_.flat_placements == 1)
      return off(effect, "a single flat shape cannot light itself");
    on(effect, fmt::format("{} hands light on", material_name(scatterer().material)),
       scatterer().item);
  }

  void caustics() {
    constexpr Effect effect = Effect::caustics;
    if (settings_.method != Method::path)
      return off(effect, "only `.path` follows light through mirrors to matt surfaces");
    if (!lit()) return off(effect, "nothing gives light");
    if (!scatters()) return off(effect, "no matt or rough surface could show one");
    const TraitWitness& mirror = walk_.of(Trait::mirror);
    const TraitWitness& clear = walk_.of(Trait::clear);
    if (!mirror.present && !clear.present)
      return off(effect, "nothing mirrors or lets light through");
    if (settings_.max_depth && *settings_.max_depth <= 1)
      return off(effect, fmt::format("`max_depth` is {}", *settings_.max_depth));
    if (walk_.area_lights == 0 && !walk_.surroundings)
      return off(effect, "every light is a point or parallel: no path can meet it by chance");
    const TraitWitness& witness = clear.present ? clear : mirror;
    on(effect, fmt::format("{} gathers light", material_name(witness.material)), witness.item);
  }

  void surfaces() {
    const bool follows = follows_light();
    const std::string none = "`.phong` follows no rays beyond the first hit";
    if (follows) {
      by_trait(Effect::reflection, Trait::mirror, "mirrors", "no placed material mirrors");
      by_trait(Effect::refraction, Trait::clear, "lets light through",
               "no placed material lets light through");
      by_trait(Effect::absorption, Trait::absorbing, "absorbs light inside",
               "no placed material absorbs light inside");
      nested_media();
    } else {
      for (const Effect effect :
           {Effect::reflection, Effect::refraction, Effect::absorption, Effect::nested_media})
        off(effect, none);
    }
    by_trait(Effect::glossy, Trait::glossy, "has a rough or Phong lobe",
             "no placed material has a rough or Phong lobe");
    by_trait(Effect::textures, Trait::textured, "varies over the surface",
             "every value of every placed material is constant");
    by_trait(Effect::alpha, Trait::see_through, "has opacity below 1",
             "every placed material is opaque");
    by_trait(Effect::normal_maps, Trait::normal_map, "has a normal map",
             "no placed material has a normal map");
  }

  void nested_media() {
    constexpr Effect effect = Effect::nested_media;
    const TraitWitness& clear = walk_.of(Trait::clear);
    if (!clear.present) return off(effect, "no placed material lets light through");
    if (walk_.clear_placements == 1) return off(effect, "only one clear body is placed");
    on(effect, "clear bodies may lie in each other", walk_.second_clear);
  }

  void lights() {
    const bool follows = follows_light();
    if (!follows) {
      off(Effect::area_lights, "`.phong` knows no lights with an area");
      off(Effect::environment, "`.phong` knows no light from all round");
    } else {
      if (walk_.area_lights == 0)
        off(Effect::area_lights, "no light has an area and no placed material emits");
      else
        on(Effect::area_lights, walk_.area_light_reason(scene_), walk_.area_light);
      if (walk_.surroundings)
        on(Effect::environment, walk_.surroundings_reason, walk_.surroundings_origin);
      else
        off(Effect::environment, "no light comes from outside the scene");
    }
    if (walk_.lights > 1)
      on(Effect::many_lights,
         walk_.lights >= EffectWalk::many ? "there are many lights to choose from"
                                          : fmt::format("there are {} lights", walk_.lights),
         walk_.second_light);
    else
      off(Effect::many_lights,
          walk_.lights == 1 ? "there is one light to aim at" : "there is no light to aim at");
  }

  void lens() {
    constexpr Effect effect = Effect::depth_of_field;
    if (!settings_.camera.valid()) return off(effect, "there is no camera");
    const Camera& camera = scene_.cameras[settings_.camera];
    const auto* lens = std::get_if<ThinLens>(&camera.kind);
    if (lens == nullptr) return off(effect, "the camera has no lens");
    if (lens->aperture && lens->aperture->value == 0) return off(effect, "the `aperture` is 0");
    on(effect,
       lens->aperture ? fmt::format("the lens has an `aperture` of {} m", lens->aperture->value)
                      : fmt::format("the lens has `f_stop = {}`", lens->f_stop.value_or(0)),
       scene_.camera_names[settings_.camera].origin);
  }

  const Scene& scene_;
  const RenderSettings& settings_;
  EffectWalk walk_;
  EffectReport report_;
};

}  // namespace

std::string_view name_of(Effect effect) {
  std::string_view name;
  with_key(effect, [&](const auto& key) { name = key.name; });
  return name;
}

std::string_view doc_of(Effect effect) {
  std::string_view doc;
  with_key(effect, [&](const auto& key) { doc = key.doc; });
  return doc;
}

bool is_switched_off(const EffectSwitches& switches, Effect effect) {
  bool off = false;
  with_key(effect, [&](const auto& key) { off = switches.*key.member == EffectSwitch::off; });
  return off;
}

EffectSet EffectReport::called_for() const {
  EffectSet set;
  for (std::size_t i = 0; i < effect_count; ++i)
    if (findings[i].called_for) set.add(static_cast<Effect>(i));
  return set;
}

EffectSet EffectReport::simulated() const {
  EffectSet set;
  for (std::size_t i = 0; i < effect_count; ++i)
    if (findings[i].simulated()) set.add(static_cast<Effect>(i));
  return set;
}

EffectReport find_effects(const Scene& scene, const RenderSettings& settings,
                          const ImageFacts& images) {
  return Finder(scene, settings, images).find();
}

}  // namespace scenec::ir
