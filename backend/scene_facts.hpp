// Facts about materials that hold wherever they are used, mixes included.
#pragma once

#include <vector>

#include "ir/scene.hpp"

namespace scenec::backend {

class MaterialFacts {
 public:
  MaterialFacts() = default;
  explicit MaterialFacts(const ir::Scene& scene);

  [[nodiscard]] bool emissive(ir::MaterialId id) const { return facts_[id.value()].emissive; }
  // Opacity may be below 1 somewhere.
  [[nodiscard]] bool transparent(ir::MaterialId id) const { return facts_[id.value()].transparent; }
  // Some light goes into the body below the surface, as into glass.
  [[nodiscard]] bool clear(ir::MaterialId id) const { return facts_[id.value()].clear; }
  // Emission or opacity varies over the surface.
  [[nodiscard]] bool textured_emission(ir::MaterialId id) const {
    return facts_[id.value()].textured_emission;
  }
  [[nodiscard]] bool two_sided(ir::MaterialId id) const { return facts_[id.value()].two_sided; }
  // Opacity may be below 1 somewhere in the scene.
  [[nodiscard]] bool any_transparent() const { return any_transparent_; }
  // Any material that needs the GGX tables.
  [[nodiscard]] bool any_facets() const { return any_facets_; }

 private:
  struct Facts {
    bool known = false;
    bool emissive = false;
    bool transparent = false;
    bool clear = false;
    bool textured_emission = false;
    bool two_sided = false;
  };
  Facts find(const ir::Scene& scene, ir::MaterialId id);

  std::vector<Facts> facts_;
  bool any_facets_ = false;
  bool any_transparent_ = false;
};

}  // namespace scenec::backend
