// The kernels that are compiled: for each method a short list of sets of effects. A picture is
// rendered by the first kernel whose set holds all effects it is simulated with; what the kernel
// could simulate beyond them is its surplus, and stays switched off while it runs.
//
// Promise: which kernel of the list runs cannot change one bit of the picture
// (tests/unit/runtime/effects_test.cpp).
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string_view>

#include "backend/backend.hpp"
#include "ir/effects.hpp"

namespace scenec::backend {

// A set of effects as bits, for templates.
using EffectMask = std::uint32_t;

[[nodiscard]] constexpr EffectMask bit_of(ir::Effect effect) {
  return EffectMask{1} << static_cast<unsigned>(effect);
}
[[nodiscard]] constexpr EffectMask mask_of(std::initializer_list<ir::Effect> effects) {
  EffectMask mask = 0;
  for (const ir::Effect effect : effects) mask |= bit_of(effect);
  return mask;
}
[[nodiscard]] EffectMask mask_of(const ir::EffectSet& effects);
[[nodiscard]] ir::EffectSet set_of(EffectMask mask);

// Beside the effects: a kernel that takes the time of what it does and counts what its rays test.
inline constexpr EffectMask probing_kernel = EffectMask{1} << 31;
static_assert(ir::effect_count < 31);

namespace kernel_masks {
using enum ir::Effect;
inline constexpr EffectMask path_full = (EffectMask{1} << ir::effect_count) - 1;
inline constexpr EffectMask whitted_full = path_full;
inline constexpr EffectMask phong_full = path_full;
// The lens costs one test a sample, so every kernel has it.
// Light between matt surfaces.
inline constexpr EffectMask path_matt =
    mask_of({shadows, interreflection, area_lights, environment, depth_of_field});
// Rough surfaces beside them, and the smooth ones that no light needs to pass.
inline constexpr EffectMask path_opaque =
    path_matt | mask_of({glossy, reflection, caustics, many_lights});
// Clear bodies too; nothing varies over a surface.
inline constexpr EffectMask path_plain =
    path_opaque | mask_of({refraction, absorption, nested_media});
inline constexpr EffectMask whitted_matt =
    mask_of({shadows, area_lights, environment, depth_of_field});
inline constexpr EffectMask whitted_plain =
    whitted_matt | mask_of({glossy, reflection, refraction, absorption, nested_media, many_lights});
inline constexpr EffectMask path_probing = path_full | probing_kernel;
inline constexpr EffectMask whitted_probing = whitted_full | probing_kernel;
inline constexpr EffectMask phong_probing = phong_full | probing_kernel;
inline constexpr EffectMask phong_plain = mask_of({glossy, many_lights, depth_of_field});
}  // namespace kernel_masks

struct KernelInfo {
  ir::Method method = ir::Method::path;
  std::string_view name;
  EffectMask mask = 0;
};
}  // namespace scenec::backend
