// The scattering of light at one point of one material, after textures and mixes are resolved: a
// small value, no allocation, a switch on its kind.
//
// Domain:     the viewer is on the outer side of `frame.z` and of `geometric` (both are turned to
// it). Method:     lobes: Lambert; modified Phong (Lafortune and Willems 1994) normalised by
//             (n + 2) / 2 pi; GGX with Smith's height-correlated shadowing and compensation of
//             multiple scattering (Turquin 2019); Walter et al. 2007 for rough glass; diffuse under
//             a coat scaled by what the coat lets in and out (Kulla and Conty 2017). Radiance that
//             crosses an interface is scaled by the square of the relative index.
// Error:      no lobe gains energy beyond the table's 5e-3.
// Degenerate: light never passes through the geometric surface: reflected directions stay on the
//             viewer's side of it, transmitted ones leave on the other.
// Proof:      tests/unit/backend/materials/{bsdf,furnace}_test.cpp.
#pragma once

#include <array>
#include <cstdint>

#include "backend/materials/ggx_albedo.hpp"
#include "backend/math/color.hpp"
#include "backend/math/frame.hpp"
#include "backend/math/sampling.hpp"

namespace scenec::backend {

enum class BsdfKind : std::uint8_t {
  none,
  diffuse,
  phong,
  mirror,
  glass,
  rough_glass,
  metal,
  rough_metal,
  coat,
  smooth_coat,
};

struct Bsdf {
  BsdfKind kind = BsdfKind::none;
  bool entering = true;   // the viewer is outside: crossing the surface enters the body
  Frame frame;            // z: shading normal, turned to the viewer
  UnitVector3 geometric;  // turned to the viewer
  Vector3 wo;             // to the viewer, in the frame; wo.z > 0
  Rgb diffuse;            // albedo of the matt part
  Rgb specular;           // phong: lobe; mirror: reflectance; glass: tint; metal and coat: f0
  Rgb reflect, refract;   // phong: weights of the mirror and the refracted direction
  Rgb eta, k;             // metal: measured; eta 0 says that f0 is used
  double alpha = 0;
  double exponent = 1;    // phong
  double ior = 1;         // behind the surface over before it, as seen from the viewer
  Rgb compensation;       // metal, coat: factor for multiple scattering
  Rgb coat_out;           // coat: what the coat lets out towards the viewer, over its mean
  double lobe_share = 1;  // probability of the specular lobe (coat), of the phong lobe's group
  std::array<double, 4> lobe_probability{};  // phong: diffuse, specular, reflect, refract
  const GgxAlbedo* albedo = nullptr;
};

// Glass whose sides have the same index neither bends nor reflects: it has no facets either. Asked
// again when the index changes, as that of a bubble does in glass.
inline void settle_kind(Bsdf& bsdf) {
  if (bsdf.kind != BsdfKind::glass && bsdf.kind != BsdfKind::rough_glass) return;
  bsdf.kind = bsdf.alpha > 0 && bsdf.ior != 1 ? BsdfKind::rough_glass : BsdfKind::glass;
}
// Fills what follows from the other members (compensation, probabilities). Call once.
void finish(Bsdf& bsdf);
// Whether an interface that lets light through is part of it.
[[nodiscard]] inline bool is_clear(const Bsdf& bsdf) {
  return bsdf.kind == BsdfKind::glass || bsdf.kind == BsdfKind::rough_glass ||
         (bsdf.kind == BsdfKind::phong && bsdf.refract.r + bsdf.refract.g + bsdf.refract.b > 0);
}
// Whether it has a lobe that is neither Lambert's nor exactly specular.
[[nodiscard]] inline bool is_rough(const Bsdf& bsdf) {
  return bsdf.kind == BsdfKind::rough_glass || bsdf.kind == BsdfKind::rough_metal ||
         bsdf.kind == BsdfKind::coat ||
         (bsdf.kind == BsdfKind::phong && bsdf.specular.r + bsdf.specular.g + bsdf.specular.b > 0);
}

struct BsdfValue {
  Rgb f_cos;       // f * |cos wi|
  double pdf = 0;  // of sample_bsdf giving wi, exactly specular lobes left out
};
// For a direction in world space; exactly specular lobes give 0.
[[nodiscard]] BsdfValue evaluate(const Bsdf& bsdf, const Vector3& wi_world);

struct BsdfSample {
  Vector3 wi;      // world, unit
  Rgb weight;      // f * |cos wi| / pdf; black: absorbed
  double pdf = 0;  // meaningless for exactly specular lobes
  bool specular = false;
  bool transmitted = false;
  double eta_scale = 1;  // the square of the relative index that radiance was scaled by, inverted
};
[[nodiscard]] BsdfSample sample_bsdf(const Bsdf& bsdf, double lobe, Sample2 u);

// Whether evaluate() can give anything but 0.
[[nodiscard]] bool has_smooth_part(const Bsdf& bsdf);

// What a smooth mirror or metal reflects of light whose angle of incidence has this cosine.
[[nodiscard]] Rgb smooth_reflectance(const Bsdf& bsdf, double cos_i);

// The exactly specular directions with their weights, for a tracer that follows all of them.
struct SpecularRay {
  Vector3 wi;
  Rgb weight;
  bool transmitted = false;
};
struct SpecularRays {
  std::array<SpecularRay, 2> rays;
  int count = 0;
};
[[nodiscard]] SpecularRays specular_rays(const Bsdf& bsdf);

// Reflectance under even light, roughly: the albedo layer, and the choice between lobes.
[[nodiscard]] Rgb albedo_of(const Bsdf& bsdf);

}  // namespace scenec::backend
