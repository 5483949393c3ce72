// `.phong`: what the course's programs compute, and nothing else. The normal is not turned to the
// viewer, the specular term is not gated by N.L, pow(x, 0) is 1; no falloff, shadows, bounces,
// emission or 1/pi; the background only on a miss; the light's value is intensity times color.
#include <cmath>

#include "backend/integrators/tracer.hpp"
#include "base/elementary.hpp"

namespace scenec::backend {
namespace {

struct PhongTerms {
  Rgb diffuse;
  Rgb specular;
  double shininess = 0;
};

// Materials of other kinds show their colour as a matt one: enough to see what stands where.
PhongTerms terms_of(const RenderScene& scene, ir::MaterialId id, Sample2 uv) {
  const ir::Material& material = scene.scene->materials[id];
  const TextureEvaluator& t = scene.textures;
  if (const auto* m = std::get_if<ir::Phong>(&material.kind)) {
    return {t.color(m->diffuse, uv), t.color(m->specular, uv), t.number(m->shininess, uv)};
  }
  if (const auto* m = std::get_if<ir::Diffuse>(&material.kind))
    return {t.color(m->color, uv), {}, 0};
  if (const auto* m = std::get_if<ir::Mirror>(&material.kind))
    return {t.color(m->color, uv), {}, 0};
  if (const auto* m = std::get_if<ir::Dielectric>(&material.kind))
    return {t.color(m->tint, uv), {}, 0};
  if (const auto* m = std::get_if<ir::Ggx>(&material.kind)) return {t.color(m->base, uv), {}, 0};
  if (const auto* m = std::get_if<ir::Conductor>(&material.kind)) {
    return {m->f0 ? t.color(*m->f0, uv) : Rgb(1, 1, 1), {}, 0};
  }
  const auto& mix = std::get<ir::Mix>(material.kind);
  const double w = t.number(mix.weight, uv);
  const PhongTerms a = terms_of(scene, mix.a, uv);
  const PhongTerms b = terms_of(scene, mix.b, uv);
  return {a.diffuse * (1 - w) + b.diffuse * w, a.specular * (1 - w) + b.specular * w,
          a.shininess * (1 - w) + b.shininess * w};
}

// Most scenes have whole exponents, and repeated multiplication is what pow does best; pow itself
// keeps the course's rule for 0.
Rgb shade(const PhongTerms& m, const Vector3& n, const Vector3& to_viewer, const Vector3& to_light,
          const Rgb& light) {
  const double n_l = dot(n, to_light);
  const Vector3 mirrored = n * (2 * n_l) - to_light;
  const double v_r = dot(to_viewer, mirrored);
  const double matt = n_l > 0 ? n_l : 0;
  const double gloss = is_black(m.specular) ? 0 : pow(v_r > 0 ? v_r : 0, m.shininess);
  return light * (m.diffuse * matt + m.specular * gloss);
}

}  // namespace

TracedSample trace_phong(const Tracer& tracer, const Ray& ray, const Sampler& sampler) {
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
  PhongTerms terms = terms_of(scene, scene.material_of(hit), texture_place(hit, tracer.effects()));
  if (!tracer.with(ir::Effect::glossy)) terms.specular = {};
  const Vector3 n = hit.shading_normal.vector();
  const Vector3 to_viewer = -ray.direction;
  for (const DeltaLight& light : scene.lights.deltas) {
    Vector3 to_light = -light.direction.vector();
    if (light.kind != DeltaLight::Kind::directional)
      to_light = normalized(light.position - hit.point).vector();
    Rgb value = light.value;
    if (light.kind == DeltaLight::Kind::spot) value *= spot_share(light, -to_light);
    out.radiance += shade(terms, n, to_viewer, to_light, value);
  }
  out.first.hit = true;
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
