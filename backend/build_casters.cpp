// Which items throw the light of lamps: smooth spheres of one material.
#include <utility>
#include <vector>

#include "backend/build.hpp"

namespace scenec::backend {
namespace {

// Whether light leaves the surface in exactly one or two directions, the same all over it.
bool is_smooth(const RenderScene& scene, ir::MaterialId id) {
  const PreparedMaterial& material = scene.materials[id.value()];
  if (material.use != PreparedMaterial::Use::constant || scene.facts.emissive(id) ||
      scene.facts.transparent(id))
    return false;
  const BsdfKind kind = material.bsdf.kind;
  return kind == BsdfKind::mirror || kind == BsdfKind::metal ||
         (kind == BsdfKind::glass && material.ior > 1);
}

}  // namespace

void add_casters(RenderScene& scene) {
  std::vector<std::pair<std::uint32_t, Caster>> casters;
  const std::vector<ir::Item>& items = scene.scene->items;
  for (std::uint32_t number = 0; number < items.size(); ++number) {
    const ir::Item& item = items[number];
    if (!std::holds_alternative<Id<ir::Sphere>>(item.shape) || !item.material.valid() ||
        !is_smooth(scene, item.material))
      continue;
    const Emitter sphere =
        emitters_of(scene, item.shape, transform_of(*scene.scene, item.transform)).front();
    if (sphere.shape != EmitterShape::sphere || !(sphere.radius > 0)) continue;
    const PreparedMaterial& material = scene.materials[item.material.value()];
    const Vector3 reach{sphere.radius, sphere.radius, sphere.radius};
    // Roundings of the point and of the transforms its surface is traced through.
    const Vector3 error = (abs(as_vector(sphere.origin)) + reach) * gamma(32);
    casters.emplace_back(number, Caster{sphere.origin, sphere.radius, error, item.material,
                                        material.bsdf, material.ior});
  }
  scene.casters.finish(std::move(casters), scene.items.size(), scene.lights.emitters);
}

}  // namespace scenec::backend
