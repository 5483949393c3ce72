// From a material of the IR and a hit to the scattering there: textures read, one part of each mix
// chosen, normals turned to the viewer.
#pragma once

#include "backend/geometry/kernel.hpp"
#include "backend/materials/bsdf.hpp"
#include "backend/render_scene.hpp"
#include "ir/effects.hpp"

namespace scenec::backend {

// Where a texture is read: at the hit, or at the middle of the texture for a picture without
// textures.
[[nodiscard]] inline Sample2 texture_place(const Hit& hit, const ir::EffectSet& effects) {
  return effects.has(ir::Effect::textures) ? Sample2{hit.u, hit.v} : Sample2{0.5, 0.5};
}

// `mix` chooses between the parts of mixes. Rough lobes and normal maps are left out where
// `effects` leaves them out.
[[nodiscard]] Bsdf resolve_bsdf(const RenderScene& scene, ir::MaterialId material, const Hit& hit,
                                const Vector3& to_viewer, double mix, const ir::EffectSet& effects);

// Radiance given off towards a side; `outside`: the side the outward normal faces.
[[nodiscard]] Rgb emission_of(const RenderScene& scene, ir::MaterialId material, Sample2 uv,
                              bool outside);
// The probability that a ray is stopped: 0 or 1 with a cutout.
[[nodiscard]] double opacity_of(const RenderScene& scene, ir::MaterialId material, Sample2 uv);

// Absorption coefficient of the body a material bounds.
[[nodiscard]] Rgb absorption_of(const RenderScene& scene, ir::MaterialId material);

}  // namespace scenec::backend
