// Lints about the finished scene: what is legal, and so placed or scaled that rounding decides what
// is seen. Each says the measured quantity and what to do. Called when nothing is wrong; an
// `@allow` round the item keeps it quiet.
#pragma once

#include "frontend/session.hpp"
#include "ir/scene.hpp"

namespace scenec::frontend {

// All of them: objects tiny for their distance, lights inside opaque shapes, thin gaps, coincident
// dielectrics. Takes a time about proportional to the number of items: what could need all pairs
// looks at neighbours in an order and gives up on the rest after a fixed number of comparisons an
// item.
void lint_scene(Session& session);

// ---- what its parts share

// Distance between neighbouring single-precision numbers of that size; meshes and bounds are kept
// in single precision.
[[nodiscard]] double float_spacing(double magnitude);

// Whether light passes the surface: dielectrics, refracting Phong, anything with opacity.
class Transparency {
 public:
  explicit Transparency(const ir::Scene& scene);
  [[nodiscard]] bool refracts(ir::MaterialId id) const { return of(id) == Kind::refracts; }
  [[nodiscard]] bool blocks_light(ir::MaterialId id) const { return of(id) == Kind::opaque; }

 private:
  enum class Kind : std::uint8_t { opaque, passes, refracts };
  [[nodiscard]] Kind of(ir::MaterialId id) const {
    return id.valid() ? kinds_[id.value()] : Kind::passes;
  }
  std::vector<Kind> kinds_;
};

// Thin gaps and coincident dielectrics among items of one space.
void lint_gaps(Session& session, const std::vector<ir::Item>& items,
               const Transparency& transparency);

}  // namespace scenec::frontend
