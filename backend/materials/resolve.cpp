#include "backend/materials/resolve.hpp"

#include <cmath>

#include "backend/materials/fresnel.hpp"
#include "backend/materials/metals.hpp"
#include "backend/materials/microfacet.hpp"

namespace scenec::backend {
namespace {

Rgb rgb_of(const ir::Color& c) {
  return {c.r, c.g, c.b};
}

struct Part {
  const ir::Material* material;
  ir::TextureId normal_map;  // of the part, else of the nearest mix round it
};

Part choose_part(const RenderScene& scene, ir::MaterialId id, Sample2 uv, double u) {
  ir::TextureId normal_map;
  for (;;) {
    const ir::Material& material = scene.scene->materials[id];
    if (material.common.normal_map.valid()) normal_map = material.common.normal_map;
    const auto* mix = std::get_if<ir::Mix>(&material.kind);
    if (mix == nullptr) return {&material, normal_map};
    const double weight = scene.textures.number(mix->weight, uv);
    // What is left of u within the chosen part is uniform again, for mixes of mixes.
    if (u < weight) {
      id = mix->b;
      u = u / weight;
    } else {
      id = mix->a;
      u = weight < 1 ? (u - weight) / (1 - weight) : 0;
    }
  }
}

UnitVector3 mapped_normal(const RenderScene& scene, const Hit& hit, ir::TextureId map) {
  const Rgb c = scene.textures.value(map, {hit.u, hit.v}, TextureUse::data).color;
  const Frame frame = frame_about(hit.shading_normal, hit.dp_du);
  return frame.world_of(normalized(Vector3{2 * c.r - 1, 2 * c.g - 1, 2 * c.b - 1}));
}

// A shading normal for which the mirror direction does not go below the surface: where it would,
// the mirror direction is lifted just above and the normal laid between it and the viewer (as
// Cycles does; without it polygon meshes get black rims).
UnitVector3 valid_normal(const UnitVector3& shading, const UnitVector3& geometric,
                         const Vector3& to_viewer) {
  const Vector3 mirrored = reflected(to_viewer, shading);
  // Cycles' height of the lifted direction: 0.01, or less where the viewer itself is that low.
  constexpr double lift = 0.01;
  const double lowest = smaller(0.9 * dot(to_viewer, geometric), lift);
  const double height = dot(mirrored, geometric);
  if (height >= lowest && dot(to_viewer, shading) > 0) return shading;
  const UnitVector3 lifted = normalized(mirrored + geometric.vector() * (lowest - height));
  const UnitVector3 normal = normalized(lifted.vector() + to_viewer, geometric);
  return dot(normal, to_viewer) > 0 ? normal : geometric;
}

void set_frame(Bsdf& b, const RenderScene& scene, const Hit& hit, const Vector3& to_viewer,
               ir::TextureId normal_map) {
  b.entering = dot(hit.geometric_normal, to_viewer) >= 0;
  b.geometric = b.entering ? hit.geometric_normal : -hit.geometric_normal;
  UnitVector3 shading = hit.shading_normal;
  if (normal_map.valid()) shading = mapped_normal(scene, hit, normal_map);
  if (!b.entering) shading = -shading;
  if (!(shading == b.geometric)) shading = valid_normal(shading, b.geometric, to_viewer);
  b.frame = frame_about(shading);
  b.wo = b.frame.local_of(to_viewer);
  // Grazing views, by rounding: a direction in the surface itself has no mirror image.
  b.wo.z = larger(b.wo.z, unit_roundoff);
}

void set_roughness(Bsdf& b, double roughness, BsdfKind smooth, BsdfKind rough) {
  const double alpha = roughness * roughness;
  b.alpha = alpha < specular_alpha ? 0 : smaller(alpha, 1);
  b.kind = b.alpha == 0 ? smooth : rough;
}

// A picture without blurred reflection shows what is left of the material.
void leave_out_rough_lobes(Bsdf& b) {
  b.kind = b.kind == BsdfKind::coat                                             ? BsdfKind::diffuse
           : b.kind == BsdfKind::rough_glass || b.kind == BsdfKind::rough_metal ? BsdfKind::none
                                                                                : b.kind;
  if (b.kind == BsdfKind::phong) b.specular = {};
}

struct Filler {
  const RenderScene& scene;
  Sample2 uv;
  Bsdf& b;

  [[nodiscard]] Rgb color(const ir::ColorInput& input) const {
    return scene.textures.color(input, uv);
  }
  [[nodiscard]] double number(const ir::NumberInput& input) const {
    return scene.textures.number(input, uv);
  }

  void operator()(const ir::Diffuse& m) const {
    b.kind = BsdfKind::diffuse;
    b.diffuse = color(m.color);
  }
  void operator()(const ir::Phong& m) const {
    b.kind = BsdfKind::phong;
    b.diffuse = color(m.diffuse);
    b.specular = color(m.specular);
    b.reflect = color(m.reflect);
    b.refract = color(m.refract);
    b.exponent = number(m.shininess);
    b.ior = b.entering ? m.ior : 1 / m.ior;
  }
  void operator()(const ir::Mirror& m) const {
    b.kind = BsdfKind::mirror;
    b.specular = color(m.color);
  }
  void operator()(const ir::Dielectric& m) const {
    set_roughness(b, number(m.roughness), BsdfKind::glass, BsdfKind::rough_glass);
    b.specular = color(m.tint);
    b.ior = b.entering ? m.ior : 1 / m.ior;
    // Nothing bends and nothing is reflected: no facets either.
    if (m.ior == 1) b.kind = BsdfKind::glass;
  }
  void operator()(const ir::Conductor& m) const {
    set_roughness(b, number(m.roughness), BsdfKind::metal, BsdfKind::rough_metal);
    if (m.f0) {
      b.specular = color(*m.f0);
    } else if (m.preset) {
      const MetalIndices indices = indices_of(*m.preset);
      b.eta = indices.eta;
      b.k = indices.k;
    } else if (m.eta && m.k) {
      b.eta = rgb_of(*m.eta);
      b.k = rgb_of(*m.k);
    }
  }
  void operator()(const ir::Ggx& m) const {
    set_roughness(b, number(m.roughness), BsdfKind::smooth_coat, BsdfKind::coat);
    b.diffuse = color(m.base);
    b.specular = color(m.f0);
  }
  void operator()(const ir::Mix&) const {}  // choose_part never ends at one
};

}  // namespace

Bsdf resolve_bsdf(const RenderScene& scene, ir::MaterialId material, const Hit& hit,
                  const Vector3& to_viewer, double mix, const ir::EffectSet& effects) {
  const Sample2 uv = texture_place(hit, effects);
  const Part part = choose_part(scene, material, uv, mix);
  Bsdf b;
  b.albedo = scene.ggx_albedo ? &*scene.ggx_albedo : nullptr;
  set_frame(b, scene, hit, to_viewer,
            effects.has(ir::Effect::normal_maps) ? part.normal_map : ir::TextureId());
  std::visit(Filler{scene, uv, b}, part.material->kind);
  if (!effects.has(ir::Effect::glossy)) leave_out_rough_lobes(b);
  finish(b);
  return b;
}

Rgb emission_of(const RenderScene& scene, ir::MaterialId id, Sample2 uv, bool outside) {
  if (!scene.facts.emissive(id)) return {};
  const ir::Material& material = scene.scene->materials[id];
  Rgb sum;
  if (outside || material.common.two_sided)
    sum = scene.textures.color(material.common.emission, uv);
  if (const auto* mix = std::get_if<ir::Mix>(&material.kind)) {
    const double weight = scene.textures.number(mix->weight, uv);
    sum += emission_of(scene, mix->a, uv, outside) * (1 - weight) +
           emission_of(scene, mix->b, uv, outside) * weight;
  }
  return sum;
}

double opacity_of(const RenderScene& scene, ir::MaterialId id, Sample2 uv) {
  if (!scene.facts.transparent(id)) return 1;
  const ir::Material& material = scene.scene->materials[id];
  double opacity = scene.textures.number(material.common.opacity, uv);
  if (material.common.cutout) opacity = opacity < *material.common.cutout ? 0 : 1;
  if (const auto* mix = std::get_if<ir::Mix>(&material.kind)) {
    const double weight = scene.textures.number(mix->weight, uv);
    opacity *=
        opacity_of(scene, mix->a, uv) * (1 - weight) + opacity_of(scene, mix->b, uv) * weight;
  }
  return opacity;
}

Rgb absorption_of(const RenderScene& scene, ir::MaterialId id) {
  const auto* glass = std::get_if<ir::Dielectric>(&scene.scene->materials[id].kind);
  return glass != nullptr ? rgb_of(glass->absorption) : Rgb{};
}

}  // namespace scenec::backend
