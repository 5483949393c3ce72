#include "backend/materials/resolve.hpp"

#include <cmath>

#include "backend/materials/fill_bsdf.hpp"
#include "backend/materials/microfacet.hpp"

namespace scenec::backend {
namespace {

Rgb rgb_of(const ir::Color& c) {
  return {c.r, c.g, c.b};
}

struct Part {
  const ir::Material* material;
  ir::TextureId normal_map;  // of the part, else of the nearest mix round it
  double ior;
};

Part choose_part(const RenderScene& scene, ir::MaterialId id, const TexturePlace& at, double u) {
  ir::TextureId normal_map;
  for (;;) {
    const ir::Material& material = scene.scene->materials[id];
    if (material.common.normal_map.valid()) normal_map = material.common.normal_map;
    const auto* mix = std::get_if<ir::Mix>(&material.kind);
    if (mix == nullptr) return {&material, normal_map, scene.materials[id.value()].ior};
    const double weight = scene.textures.number(mix->weight, at);
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
  const Rgb c = scene.textures.value(map, texture_place_of(hit), TextureUse::data).color;
  const Frame frame = frame_about(hit.shading_normal, hit.dp_du);
  return frame.world_of(normalized(Vector3{2 * c.r - 1, 2 * c.g - 1, 2 * c.b - 1}));
}

// A picture without blurred reflection shows what is left of the material.
void leave_out_rough_lobes(Bsdf& b) {
  b.kind = b.kind == BsdfKind::coat                                             ? BsdfKind::diffuse
           : b.kind == BsdfKind::rough_glass || b.kind == BsdfKind::rough_metal ? BsdfKind::none
                                                                                : b.kind;
  if (b.kind == BsdfKind::phong) b.specular = {};
}

struct InputsAt {
  const TextureEvaluator& textures;
  const TexturePlace& at;

  [[nodiscard]] Rgb color(const ir::ColorInput& input) const { return textures.color(input, at); }
  [[nodiscard]] double number(const ir::NumberInput& input) const {
    return textures.number(input, at);
  }
};

}  // namespace

TexturePlace texture_place_of(const Hit& hit) {
  TexturePlace at(hit.u, hit.v);
  if (!(hit.width > 0)) return at;
  at.width_u = hit.width / length(hit.dp_du);
  at.width_v = hit.width / length(hit.dp_dv);
  return at;
}

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

Bsdf resolve_bsdf(const RenderScene& scene, ir::MaterialId id, const Hit& hit,
                  const Vector3& to_viewer, const ResolveOptions& options) {
  const PreparedMaterial& prepared = scene.materials[id.value()];
  Bsdf b = prepared.bsdf;
  UnitVector3 shading = hit.shading_normal;
  double ior = prepared.ior;
  if (prepared.use == PreparedMaterial::Use::varied) {
    const Part part = choose_part(scene, id, options.at, options.mix);
    InputsAt inputs{scene.textures, options.at};
    fill_bsdf(part.material->kind, inputs, b);
    ior = part.ior;
    if (options.normal_maps && part.normal_map.valid())
      shading = mapped_normal(scene, hit, part.normal_map);
  }
  const TurnedNormals normals = turned_normals(hit, shading, to_viewer);
  b.entering = normals.entering;
  b.geometric = normals.geometric;
  b.frame = frame_about(normals.shading);
  b.wo = b.frame.local_of(to_viewer);
  // Grazing views, by rounding: a direction in the surface itself has no mirror image.
  b.wo.z = larger(b.wo.z, unit_roundoff);
  b.ior = b.entering ? ior : 1 / ior;
  settle_kind(b);
  if (!options.rough_lobes) leave_out_rough_lobes(b);
  return b;
}

Rgb emission_of(const RenderScene& scene, ir::MaterialId id, const TexturePlace& at, bool outside) {
  if (!scene.facts.emissive(id)) return {};
  const ir::Material& material = scene.scene->materials[id];
  Rgb sum;
  if (outside || material.common.two_sided)
    sum = scene.textures.color(material.common.emission, at);
  if (const auto* mix = std::get_if<ir::Mix>(&material.kind)) {
    const double weight = scene.textures.number(mix->weight, at);
    sum += emission_of(scene, mix->a, at, outside) * (1 - weight) +
           emission_of(scene, mix->b, at, outside) * weight;
  }
  return sum;
}

double opacity_of(const RenderScene& scene, ir::MaterialId id, const TexturePlace& at) {
  if (!scene.facts.transparent(id)) return 1;
  const ir::Material& material = scene.scene->materials[id];
  double opacity = scene.textures.number(material.common.opacity, at);
  if (material.common.cutout) opacity = opacity < *material.common.cutout ? 0 : 1;
  if (const auto* mix = std::get_if<ir::Mix>(&material.kind)) {
    const double weight = scene.textures.number(mix->weight, at);
    opacity *=
        opacity_of(scene, mix->a, at) * (1 - weight) + opacity_of(scene, mix->b, at) * weight;
  }
  return opacity;
}

Rgb absorption_of(const RenderScene& scene, ir::MaterialId id) {
  const auto* glass = std::get_if<ir::Dielectric>(&scene.scene->materials[id].kind);
  return glass != nullptr ? rgb_of(glass->absorption) : Rgb{};
}

}  // namespace scenec::backend
