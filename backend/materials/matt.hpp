// Lambert's surface on its own: what most surfaces of most scenes are. The same lobe as the diffuse
// kind of Bsdf, without the members of the others.
//
// Domain:     as Bsdf: the viewer is on the outer side of both normals.
// Method:     value albedo / pi; directions with density cos / pi.
// Error:      4 ulp.
// Degenerate: light never passes through the geometric surface.
// Proof:      tests/unit/backend/materials/bsdf_test.cpp, furnace_test.cpp.
#pragma once

#include "backend/materials/bsdf.hpp"

namespace scenec::backend {

struct MattSurface {
  UnitVector3 shading;    // turned to the viewer
  UnitVector3 geometric;  // turned to the viewer
  bool entering = true;
  Rgb albedo;
};

[[nodiscard]] inline BsdfValue evaluate(const MattSurface& s, const Vector3& wi_world) {
  const double z = dot(wi_world, s.shading);
  if (!(z > 0) || !(dot(wi_world, s.geometric) > 0)) return {};
  const double pdf = z * (1 / pi);
  return {s.albedo * pdf, pdf};
}

[[nodiscard]] inline BsdfSample sample_bsdf(const MattSurface& s, double, Sample2 u) {
  const UnitVector3 wi = sample_cosine_hemisphere(u);
  BsdfSample out;
  // Unit to 8 ulp, as both are.
  out.wi = frame_about(s.shading).world_of(wi.vector());
  if (!(wi.z() > 0) || !(dot(out.wi, s.geometric) > 0)) return {};
  out.pdf = wi.z() * (1 / pi);
  out.weight = s.albedo;
  return out;
}

[[nodiscard]] inline bool has_smooth_part(const MattSurface& s) {
  return !is_black(s.albedo);
}
[[nodiscard]] inline Rgb albedo_of(const MattSurface& s) {
  return s.albedo;
}

}  // namespace scenec::backend
