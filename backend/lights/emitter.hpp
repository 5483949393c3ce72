// Pieces of surface that give off light, with one way each to choose a point on them as seen from a
// place. All are in world space: transforms of their shapes are baked in.
//
// Domain:     area > 0; any reference point.
// Method:     uniform in area, except spheres seen from outside: uniform in the cone they fill, by
//             the form of 1 - cos that keeps its digits for far ones (numerics anchors, row 7). Of
//             a sphere that an opaque plane cuts, places on the side of the smaller part can only
//             see that part: there it alone is aimed at, uniform in area.
// Error:      the sampled point's distance from the surface is bounded by `error`.
// Degenerate: reference in the plane of a flat piece: density 0, no sample; reference on or inside
//             a sphere: uniform in area; reference on the plane that cuts a sphere, to rounding: as
//             if there were no plane.
// Proof:      tests/unit/backend/lights/lights_test.cpp (P03-P05, P08), cut_sphere_test.cpp.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "backend/math/color.hpp"
#include "backend/math/sampling.hpp"
#include "backend/math/vec.hpp"
#include "ir/values.hpp"

namespace scenec::backend {

// origin, a, b, c of the emitter mean:
enum class EmitterShape : std::uint8_t {
  triangle,       // corner, two edges
  parallelogram,  // corner, two edges
  ellipse,        // centre, two conjugate half axes
  sphere,         // centre; `radius`
  cut_sphere,     // centre; `radius`; see cut_by_plane
  ellipsoid,      // centre, images of the three unit vectors
  tube,           // base centre, two conjugate half axes of the base, way to the top
};

struct Emitter {
  EmitterShape shape = EmitterShape::triangle;
  bool two_sided = false;
  bool flipped = false;   // emits against a x b (mirrored shapes)
  bool visible = true;    // to camera rays
  bool textured = false;  // radiance varies: ask the material
  ir::MaterialId material;
  Point3 origin;
  Vector3 a, b, c;
  double radius = 0;
  double area = 0;
  UnitVector3 normal;  // of flat shapes: the side that emits
  Vector3 error;       // bound on the distance of sampled points from the surface
  Rgb radiance;        // constant, or the mean when textured
};
[[nodiscard]] constexpr bool is_flat(EmitterShape shape) {
  return shape == EmitterShape::triangle || shape == EmitterShape::parallelogram ||
         shape == EmitterShape::ellipse;
}

// The sphere, where an opaque plane n . p = offset leaves a cap of at most half its radius on one
// side: then `a` is the unit way to the cap, `b` = {height of the cap, a . p of the plane, 0}. The
// smallest cap stays. Nothing happens where the plane passes the sphere by, or cuts deeper: a cone
// is as good there.
void cut_by_plane(Emitter& sphere, const Vector3& normal, double offset);

// Computes `area` (of a cut sphere its cap; 0 for what is too small to be chosen),
// `normal` and `error`.
void measure(Emitter& emitter);

struct EmitterSample {
  Point3 point;
  Vector3 error;
  UnitVector3 normal;  // outer side
  UnitVector3 wi;      // from the reference point
  double pdf = 0;      // per solid angle at the reference point
};

// A point of the surface by itself, whatever it is seen from.
struct AreaPoint {
  Point3 point;
  Vector3 normal;  // outer side, not unit
  double pdf = 0;  // per area; 0: none
};
[[nodiscard]] AreaPoint sample_area(const Emitter& emitter, Sample2 u);
// The density with which sample_area gives a point, whose outer normal is `normal`.
[[nodiscard]] double area_pdf(const Emitter& emitter, const Point3& point,
                              const UnitVector3& normal);

namespace emitter_detail {
// The place of a flat shape for two numbers in [0, 1).
[[nodiscard]] inline Point3 flat_point(const Emitter& e, Sample2 u) {
  const Sample2 at = e.shape == EmitterShape::parallelogram ? u
                     : e.shape == EmitterShape::triangle    ? sample_uniform_triangle(u)
                                                            : sample_concentric_disk(u);
  return e.origin + (e.a * at.u + e.b * at.v);
}
[[nodiscard]] bool sample_curved(const Emitter& emitter, const Point3& from, Sample2 u,
                                 EmitterSample& out);
[[nodiscard]] double pdf_curved(const Emitter& emitter, const Point3& from, const Point3& point,
                                const UnitVector3& normal);

[[nodiscard]] inline double solid_angle_pdf(double area_density, double distance, double cosine) {
  const double pdf = area_density * (distance * distance) / cosine;
  return pdf <= std::numeric_limits<double>::max() ? pdf : 0;
}
}  // namespace emitter_detail

// False: nothing to be seen from there.
[[nodiscard]] inline bool sample_emitter(const Emitter& e, const Point3& from, Sample2 u,
                                         EmitterSample& out) {
  if (!is_flat(e.shape)) return emitter_detail::sample_curved(e, from, u, out);
  if (!(e.area > 0)) return false;
  out.point = emitter_detail::flat_point(e, u);
  const Vector3 way = out.point - from;
  const double distance = length(way);
  if (!(distance > 0)) return false;
  out.wi = UnitVector3::assume_unit(way / distance);
  out.normal = e.normal;
  out.error = e.error;
  out.pdf = emitter_detail::solid_angle_pdf(1 / e.area, distance, std::fabs(dot(out.wi, e.normal)));
  return out.pdf > 0;
}
[[nodiscard]] inline std::optional<EmitterSample> sample_emitter(const Emitter& e,
                                                                 const Point3& from, Sample2 u) {
  EmitterSample s;
  return sample_emitter(e, from, u, s) ? std::optional(s) : std::nullopt;
}
// The density with which sample_emitter gives the direction from `from` to `point` on the emitter,
// whose outer normal there is `normal`.
[[nodiscard]] inline double pdf_emitter(const Emitter& e, const Point3& from, const Point3& point,
                                        const UnitVector3& normal) {
  if (!is_flat(e.shape)) return emitter_detail::pdf_curved(e, from, point, normal);
  const Vector3 way = point - from;
  const double distance = length(way);
  return emitter_detail::solid_angle_pdf(1 / e.area, distance,
                                         std::fabs(dot(way, normal)) / distance);
}

}  // namespace scenec::backend
