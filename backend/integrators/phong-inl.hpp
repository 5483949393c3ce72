// `.phong`: what the course's programs compute, and nothing else. The normal is not turned to the
// viewer, the specular term is not gated by N.L, pow(x, 0) is 1; no falloff, shadows, bounces,
// emission or 1/pi; the background only on a miss; the light's value is intensity times color.
#pragma once

#include "backend/integrators/tracer.hpp"

namespace scenec::backend {

struct PhongTerms {
  Rgb diffuse;
  Rgb specular;
  double shininess = 0;
};

// Materials of other kinds show their colour as a matt one: enough to see what stands where.
[[nodiscard]] PhongTerms phong_terms(const RenderScene& scene, ir::MaterialId material,
                                     const TexturePlace& at);
[[nodiscard]] Rgb phong_shade(const PhongTerms& terms, const Vector3& normal,
                              const Vector3& to_viewer, const Vector3& to_light, const Rgb& light);

template <EffectMask compiled>
TracedSample trace_phong(const Tracer<compiled>& tracer, const Ray& ray, const Sampler& sampler) {
  const RenderScene& scene = tracer.scene();
  const ir::Color& background = tracer.settings().background;
  TracedSample out;
  Hit hit;
  Ray next = ray;
  // Shapes of lights are not part of the course's scenes.
  for (;;) {
    if (!tracer.intersect(next, RayKind::camera, 0, sampler, hit)) {
      out.radiance = {background.r, background.g, background.b};
      return out;
    }
    if (scene.items[hit.item].light == RenderItem::none) break;
    next = spawn_ray(hit, ray.direction);
    hit = Hit{};
  }
  out.covered = true;
  tracer.widen(hit, ray.direction, distance(ray.origin, hit.point));
  PhongTerms terms = phong_terms(scene, scene.material_of(hit), tracer.texture_place(hit));
  if (!tracer.template with<ir::Effect::glossy>()) terms.specular = {};
  const Vector3 n = hit.shading_normal.vector();
  const Vector3 to_viewer = -ray.direction;
  for (const DeltaLight& light : scene.lights.deltas) {
    Vector3 to_light = -light.direction.vector();
    if (light.kind != DeltaLight::Kind::directional)
      to_light = normalized(light.position - hit.point).vector();
    Rgb value = light.value;
    if (light.kind == DeltaLight::Kind::spot) value *= spot_share(light, -to_light);
    out.radiance += phong_shade(terms, n, to_viewer, to_light, value);
  }
  out.first.hit = true;
  out.first.uncertified = hit.uncertified;
  out.first.albedo = terms.diffuse;
  out.first.normal = n;
  out.first.position = hit.point;
  out.first.depth = distance(ray.origin, hit.point);
  out.first.u = hit.u;
  out.first.v = hit.v;
  out.first.item = hit.item;
  const ir::MaterialId material = scene.material_of(hit);
  out.first.material = material.valid() ? material.value() : 0;
  return out;
}

}  // namespace scenec::backend
