// What a method sees of a hit: the surface's scattering with the bodies on both sides of it.
#pragma once

#include "backend/integrators/tracer.hpp"

namespace scenec::backend {

// Sets the index across the surface from the bodies the path is in.
template <EffectMask compiled>
void set_interface(const Tracer<compiled>& tracer, const MediumStack& media,
                   ir::MaterialId material, double body_ior, Bsdf& b) {
  if (!tracer.template with<ir::Effect::nested_media>() || media.empty()) return;
  tracer.count(ir::Effect::nested_media);
  const auto relative = media.relative_ior(material, body_ior, b.entering);
  if (!relative) {
    // The boundary of a body inside another one that was entered later: nothing is there to see.
    b.kind = BsdfKind::glass;
    b.specular = {1, 1, 1};
    b.ior = 1;
    return;
  }
  b.ior = *relative;
  settle_kind(b);
  if (b.kind == BsdfKind::rough_glass && !tracer.template with<ir::Effect::glossy>())
    b.kind = BsdfKind::none;
}

template <EffectMask compiled>
Bsdf resolved_bsdf(const Tracer<compiled>& tracer, const MediumStack& media,
                   ir::MaterialId material, const Hit& hit, const Vector3& to_viewer,
                   const Sampler& sampler, std::uint32_t depth) {
  const PreparedMaterial& prepared = tracer.scene().materials[material.value()];
  ResolveOptions options{tracer.texture_place(hit), 0,
                         tracer.template with<ir::Effect::normal_maps>(),
                         tracer.template with<ir::Effect::glossy>()};
  if (prepared.use == PreparedMaterial::Use::varied) {
    options.mix = sampler.get_1d(dimension::bounce(depth) + dimension::material_mix);
    const auto& common = tracer.scene().scene->materials[material].common;
    if (common.normal_map.valid()) tracer.count(ir::Effect::normal_maps);
    if (!std::holds_alternative<ir::Mix>(tracer.scene().scene->materials[material].kind))
      tracer.count(ir::Effect::textures);
  }
  Bsdf b = resolve_bsdf(tracer.scene(), material, hit, to_viewer, options);
  if (is_clear(b)) set_interface(tracer, media, material, prepared.ior, b);
  if (is_rough(b)) tracer.count(ir::Effect::glossy);
  finish(b);
  return b;
}

// The scattering of any material but a matt one.
template <EffectMask compiled>
Bsdf bsdf_at(const Tracer<compiled>& tracer, const MediumStack& media, ir::MaterialId material,
             const Hit& hit, const Vector3& to_viewer, const Sampler& sampler,
             std::uint32_t depth) {
  return tracer.timed(RenderStage::materials, [&] {
    return resolved_bsdf(tracer, media, material, hit, to_viewer, sampler, depth);
  });
}

inline MattSurface matt_at(const PreparedMaterial& material, const Hit& hit,
                           const Vector3& to_viewer) {
  const TurnedNormals n = turned_normals(hit, hit.shading_normal, to_viewer);
  return {n.shading, n.geometric, n.entering, material.albedo};
}

// After light has passed a surface.
template <EffectMask compiled>
void cross(const Tracer<compiled>& tracer, MediumStack& media, ir::MaterialId material,
           bool entering) {
  tracer.count(ir::Effect::refraction);
  if (!entering) return media.leave(material);
  if (!media.enter(material, tracer.scene().materials[material.value()].ior,
                   tracer.template with<ir::Effect::nested_media>()))
    tracer.count_forgotten_medium();
}

// What is left of light after `distance` in the innermost body.
template <EffectMask compiled>
Rgb transmittance(const Tracer<compiled>& tracer, const MediumStack& media, double distance) {
  if (media.empty() || !tracer.template with<ir::Effect::absorption>()) return {1, 1, 1};
  const Rgb sigma = absorption_of(tracer.scene(), media.innermost());
  if (is_black(sigma)) return {1, 1, 1};
  tracer.count(ir::Effect::absorption);
  return {exp(-sigma.r * distance), exp(-sigma.g * distance), exp(-sigma.b * distance)};
}

}  // namespace scenec::backend
