// The GGX distribution of facets and Smith's height-correlated shadowing, in the shading frame
// (+z).
//
// Domain:     alpha in [1e-3, 1]; unit directions.
// Method:     sines from x^2 + y^2, never from 1 - cos^2 (numerics anchors, rows 8 and 9); visible
//             normals by spherical caps (Dupuy and Benyoub 2023).
// Error:      relative 1e-14 of the formulas.
// Degenerate: grazing directions: shadowing goes to 0, quotients G2/G1 stay in [0, 1].
// Proof:      tests/unit/backend/materials/microfacet_test.cpp (S06, S08, P01).
#pragma once

#include <cmath>

#include "backend/math/sampling.hpp"
#include "backend/math/vec.hpp"
#include "base/elementary.hpp"
#include "ir/roughness.hpp"

namespace scenec::backend {

using ir::specular_alpha;

// The density of facets with normal m, per unit of projected area.
[[nodiscard]] inline double ggx_density(const Vector3& m, double alpha) {
  const double t = m.z * m.z + (m.x * m.x + m.y * m.y) / (alpha * alpha);
  return 1 / (pi * alpha * alpha * t * t);
}

// Smith's Lambda.
[[nodiscard]] inline double ggx_lambda(const Vector3& w, double alpha) {
  const double tan2 = (w.x * w.x + w.y * w.y) / (w.z * w.z);
  return (std::sqrt(1 + alpha * alpha * tan2) - 1) / 2;
}
[[nodiscard]] inline double ggx_visible(const Vector3& w, double alpha) {
  return 1 / (1 + ggx_lambda(w, alpha));
}
[[nodiscard]] inline double ggx_visible_both(const Vector3& wo, const Vector3& wi, double alpha) {
  return 1 / (1 + ggx_lambda(wo, alpha) + ggx_lambda(wi, alpha));
}

// A facet normal seen from wo (wo.z > 0), with density pdf_ggx_normal.
[[nodiscard]] inline Vector3 sample_ggx_normal(const Vector3& wo, double alpha, Sample2 u) {
  const Vector3 stretched = normalized(Vector3{wo.x * alpha, wo.y * alpha, wo.z}).vector();
  const SinCos phi = sin_cos_of_turns(u.u);
  const double z = (1 - u.v) * (1 + stretched.z) - stretched.z;
  const double r = std::sqrt(larger(0, 1 - z * z));
  const Vector3 h{r * phi.cos + stretched.x, r * phi.sin + stretched.y, z + stretched.z};
  return normalized(Vector3{h.x * alpha, h.y * alpha, larger(0, h.z)}).vector();
}
[[nodiscard]] inline double pdf_ggx_normal(const Vector3& wo, const Vector3& m, double alpha) {
  const double facing = dot(wo, m);
  return facing > 0 ? ggx_visible(wo, alpha) * facing * ggx_density(m, alpha) / wo.z : 0;
}

}  // namespace scenec::backend
