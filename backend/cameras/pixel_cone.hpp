// How much a pixel sees at a distance: a cone about its rays (Amanatides 1984), followed along the
// length of paths. Mirrors and glass neither narrow nor widen it, nor does scattering, so that what
// is seen by way of them is filtered too little rather than too much. Its width is half a pixel:
// the film's own filter adds the rest. It does not depend on the number of samples, so that a
// picture can be gone on with.
#pragma once

namespace scenec::backend {

struct PixelCone {
  // Footprints of less than this cosine are taken for it: longer ones blur too much across.
  static constexpr double least_cosine = 0.125;

  double start = 0;   // width at the camera
  double spread = 0;  // width a unit of length

  [[nodiscard]] bool is_point() const { return start == 0 && spread == 0; }
  [[nodiscard]] double width_at(double length) const { return start + spread * length; }
};

}  // namespace scenec::backend
