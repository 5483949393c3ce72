// How much light a GGX surface reflects in all (single scattering), by cosine and roughness: what
// energy compensation and layering are made of.
//
// Domain:     mu in [0, 1], alpha in [0, 1].
// Method:     a 32 x 16 table over (mu, roughness = sqrt(alpha)) of the two integrals of Schlick's
//             Fresnel, E(f0) = f0 * base + share, by a fixed 16 x 16 quadrature over visible
//             normals; bilinear between.
// Error:      5e-3 absolute.
// Degenerate: alpha 0: a smooth surface (base + share = 1); mu 0 takes the first row.
// Proof:      tests/unit/backend/materials/furnace_test.cpp (S10).
#pragma once

#include <array>
#include <cstdint>

#include "backend/math/color.hpp"

namespace scenec::backend {

// What becomes of the light that single scattering between facets loses.
enum class LostLight : std::uint8_t {
  returned,  // energy compensation
  left_out,  // for pricing it: rough metals and coats come out too dark
};

class GgxAlbedo {
 public:
  struct Terms {
    double base = 1;                                            // coefficient of f0
    double share = 0;                                           // what even a black f0 reflects
    [[nodiscard]] double full() const { return base + share; }  // for f0 = 1
    [[nodiscard]] Rgb of(const Rgb& f0) const { return f0 * base + Rgb::gray(share); }
  };
  GgxAlbedo();
  LostLight lost_light = LostLight::returned;
  [[nodiscard]] Terms directional(double mu, double alpha) const;
  // The cosine-weighted mean over the hemisphere.
  [[nodiscard]] Terms average(double alpha) const;

 private:
  static constexpr int cosines = 32;
  static constexpr int roughnesses = 16;
  std::array<std::array<Terms, cosines>, roughnesses> table_{};
  std::array<Terms, roughnesses> average_{};
};

}  // namespace scenec::backend
