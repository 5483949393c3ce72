#include <cmath>

#include "backend/integrators/phong-inl.hpp"
#include "base/elementary.hpp"

namespace scenec::backend {

PhongTerms phong_terms(const RenderScene& scene, ir::MaterialId id, const TexturePlace& at) {
  const ir::Material& material = scene.scene->materials[id];
  const TextureEvaluator& t = scene.textures;
  if (const auto* m = std::get_if<ir::Phong>(&material.kind)) {
    return {t.color(m->diffuse, at), t.color(m->specular, at), t.number(m->shininess, at)};
  }
  if (const auto* m = std::get_if<ir::Diffuse>(&material.kind))
    return {t.color(m->color, at), {}, 0};
  if (const auto* m = std::get_if<ir::Mirror>(&material.kind))
    return {t.color(m->color, at), {}, 0};
  if (const auto* m = std::get_if<ir::Dielectric>(&material.kind))
    return {t.color(m->tint, at), {}, 0};
  if (const auto* m = std::get_if<ir::Ggx>(&material.kind)) return {t.color(m->base, at), {}, 0};
  if (const auto* m = std::get_if<ir::Conductor>(&material.kind)) {
    return {m->f0 ? t.color(*m->f0, at) : Rgb(1, 1, 1), {}, 0};
  }
  const auto& mix = std::get<ir::Mix>(material.kind);
  const double w = t.number(mix.weight, at);
  const PhongTerms a = phong_terms(scene, mix.a, at);
  const PhongTerms b = phong_terms(scene, mix.b, at);
  return {a.diffuse * (1 - w) + b.diffuse * w, a.specular * (1 - w) + b.specular * w,
          a.shininess * (1 - w) + b.shininess * w};
}

// Most scenes have whole exponents, and repeated multiplication is what pow does best; pow itself
// keeps the course's rule for 0.
Rgb phong_shade(const PhongTerms& m, const Vector3& n, const Vector3& to_viewer,
                const Vector3& to_light, const Rgb& light) {
  const double n_l = dot(n, to_light);
  const Vector3 mirrored = n * (2 * n_l) - to_light;
  const double v_r = dot(to_viewer, mirrored);
  const double matt = n_l > 0 ? n_l : 0;
  const double gloss = is_black(m.specular) ? 0 : pow(v_r > 0 ? v_r : 0, m.shininess);
  return light * (m.diffuse * matt + m.specular * gloss);
}

}  // namespace scenec::backend
