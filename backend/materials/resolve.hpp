// From a material of the IR and a hit to the scattering there: textures read, one part of each mix
// chosen, normals turned to the viewer.
#pragma once

#include "backend/geometry/kernel.hpp"
#include "backend/materials/bsdf.hpp"
#include "backend/materials/fresnel.hpp"
#include "backend/render_scene.hpp"

namespace scenec::backend {

// Both normals on the viewer's side.
struct TurnedNormals {
  UnitVector3 shading;
  UnitVector3 geometric;
  bool entering = true;  // the viewer is outside
};

// A shading normal for which the mirror direction does not go below the surface: where it would,
// the mirror direction is lifted just above and the normal laid between it and the viewer (as
// Cycles does; without it polygon meshes get black rims).
[[nodiscard]] UnitVector3 valid_normal(const UnitVector3& shading, const UnitVector3& geometric,
                                       const Vector3& to_viewer);

[[nodiscard]] inline TurnedNormals turned_normals(const Hit& hit, const UnitVector3& shading,
                                                  const Vector3& to_viewer) {
  TurnedNormals n;
  n.entering = dot(hit.geometric_normal, to_viewer) >= 0;
  n.geometric = n.entering ? hit.geometric_normal : -hit.geometric_normal;
  n.shading = n.entering ? shading : -shading;
  if (!(n.shading == n.geometric)) n.shading = valid_normal(n.shading, n.geometric, to_viewer);
  return n;
}

// Where textures are read at a hit. A place without extent in u or v (a pole) has no end there.
[[nodiscard]] TexturePlace texture_place_of(const Hit& hit);

// How a material is to be looked at.
struct ResolveOptions {
  TexturePlace at;
  double mix = 0;  // chooses between the parts of mixes
  bool normal_maps = true;
  bool rough_lobes = true;
};

// The scattering, but for the index behind the surface over the one before it, which the bodies
// round it decide: `ior` is then set, and complete() called.
[[nodiscard]] Bsdf resolve_bsdf(const RenderScene& scene, ir::MaterialId material, const Hit& hit,
                                const Vector3& to_viewer, const ResolveOptions& options);

// Radiance given off towards a side; `outside`: the side the outward normal faces.
[[nodiscard]] Rgb emission_of(const RenderScene& scene, ir::MaterialId material,
                              const TexturePlace& at, bool outside);
// The probability that a ray is stopped: 0 or 1 with a cutout.
[[nodiscard]] double opacity_of(const RenderScene& scene, ir::MaterialId material,
                                const TexturePlace& at);

// Absorption coefficient of the body a material bounds.
[[nodiscard]] Rgb absorption_of(const RenderScene& scene, ir::MaterialId material);

}  // namespace scenec::backend
