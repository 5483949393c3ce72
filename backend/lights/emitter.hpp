// Pieces of surface that give off light, with one way each to choose a point on them as seen from a
// place. All are in world space: transforms of their shapes are baked in.
//
// Domain:     area > 0; any reference point.
// Method:     uniform in area, except spheres seen from outside: uniform in the cone they fill, by
//             the form of 1 - cos that keeps its digits for far ones (numerics anchors, row 7).
// Error:      the sampled point's distance from the surface is bounded by `error`.
// Degenerate: reference in the plane of a flat piece: density 0, no sample; reference on or inside
// a
//             sphere: uniform in area.
// Proof:      tests/unit/backend/lights/emitter_test.cpp (P03-P05, P08).
#pragma once

#include <cstdint>
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
  Rgb radiance;  // constant, or the mean when textured
};

// Computes `area`; 0 for what is too small to be chosen.
void measure(Emitter& emitter);

struct EmitterSample {
  Point3 point;
  Vector3 error;
  UnitVector3 normal;  // outer side
  UnitVector3 wi;      // from the reference point
  double pdf = 0;      // per solid angle at the reference point
};
[[nodiscard]] std::optional<EmitterSample> sample_emitter(const Emitter& emitter,
                                                          const Point3& from, Sample2 u);
// The density with which sample_emitter gives the direction from `from` to `point` on the emitter,
// whose outer normal there is `normal`.
[[nodiscard]] double pdf_emitter(const Emitter& emitter, const Point3& from, const Point3& point,
                                 const UnitVector3& normal);

}  // namespace scenec::backend
