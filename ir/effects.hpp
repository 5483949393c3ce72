// Which effects a picture can depend on, and why: found from the scene alone, before any ray. An
// effect is called for unless its absence is proved; every answer names its witness or its proof.
//
// Method:  constants are folded first (folding.hpp), then what the camera's picture can reach is
//          walked: placed items, protos through their instances with the material that replaces
//          theirs, the parts of mixes whose weight lets them show, lights that give light.
// Promise: an effect that is not called for cannot change one bit of the picture; the kernels that
//          leave it out are held to that by tests.
#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>

#include "ir/folding.hpp"
#include "ir/render_settings.hpp"
#include "ir/scene.hpp"

namespace scenec::ir {

inline constexpr std::size_t effect_count =
    std::tuple_size_v<std::remove_cvref_t<decltype(Schema<EffectSwitches>::keys)>>;

// In the order of the keys of `render.effects`, which name and describe them.
enum class Effect : std::uint8_t {
  shadows,
  reflection,
  refraction,
  absorption,
  glossy,
  interreflection,
  caustics,
  textures,
  alpha,
  normal_maps,
  area_lights,
  environment,
  many_lights,
  depth_of_field,
  nested_media
};

[[nodiscard]] std::string_view name_of(Effect effect);
[[nodiscard]] std::string_view doc_of(Effect effect);
[[nodiscard]] bool is_switched_off(const EffectSwitches& switches, Effect effect);

class EffectSet {
 public:
  constexpr EffectSet() = default;
  [[nodiscard]] static EffectSet all() {
    EffectSet set;
    set.bits_.set();
    return set;
  }
  EffectSet& add(Effect effect) {
    bits_.set(static_cast<std::size_t>(effect));
    return *this;
  }
  EffectSet& remove(Effect effect) {
    bits_.reset(static_cast<std::size_t>(effect));
    return *this;
  }
  [[nodiscard]] bool has(Effect effect) const { return bits_[static_cast<std::size_t>(effect)]; }
  [[nodiscard]] bool contains(const EffectSet& other) const {
    return (other.bits_ & ~bits_).none();
  }
  [[nodiscard]] EffectSet without(const EffectSet& other) const {
    EffectSet set;
    set.bits_ = bits_ & ~other.bits_;
    return set;
  }
  [[nodiscard]] std::size_t size() const { return bits_.count(); }
  friend bool operator==(const EffectSet&, const EffectSet&) = default;

 private:
  std::bitset<effect_count> bits_;
};

struct EffectFinding {
  bool called_for = false;
  bool switched_off = false;  // by the author: the picture is biased where it was called for
  std::string reason;         // what calls for it, or the proof that nothing does
  OriginId witness;           // where that stands, if it stands somewhere

  [[nodiscard]] bool simulated() const { return called_for && !switched_off; }
};

struct EffectReport {
  std::array<EffectFinding, effect_count> findings;

  [[nodiscard]] const EffectFinding& of(Effect effect) const {
    return findings[static_cast<std::size_t>(effect)];
  }
  [[nodiscard]] EffectSet called_for() const;
  [[nodiscard]] EffectSet simulated() const;
};

// `settings`: the scene's, or the scene's with the command line's changes.
[[nodiscard]] EffectReport find_effects(const Scene& scene, const RenderSettings& settings,
                                        const ImageFacts& images = {});

}  // namespace scenec::ir
