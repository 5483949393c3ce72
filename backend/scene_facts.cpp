#include "backend/scene_facts.hpp"

namespace scenec::backend {

MaterialFacts::MaterialFacts(const ir::Scene& scene) {
  facts_.resize(scene.materials.size());
  for (std::uint32_t i = 0; i < facts_.size(); ++i) {
    any_transparent_ = find(scene, ir::MaterialId(i)).transparent || any_transparent_;
    const ir::MaterialKind& kind = scene.materials[ir::MaterialId(i)].kind;
    any_facets_ = any_facets_ || std::holds_alternative<ir::Ggx>(kind) ||
                  std::holds_alternative<ir::Conductor>(kind);
  }
}

MaterialFacts::Facts MaterialFacts::find(const ir::Scene& scene, ir::MaterialId id) {
  if (facts_[id.value()].known) return facts_[id.value()];
  const ir::Material& material = scene.materials[id];
  const ir::MaterialCommon& common = material.common;
  Facts facts;
  facts.known = true;
  facts.emissive = common.emission.texture.valid() || common.emission.value != ir::black;
  facts.transparent = common.opacity.texture.valid() || common.opacity.value < 1;
  facts.clear = std::holds_alternative<ir::Dielectric>(material.kind);
  facts.textured_emission = common.emission.texture.valid() || facts.transparent;
  facts.two_sided = common.two_sided;
  if (const auto* mix = std::get_if<ir::Mix>(&material.kind)) {
    // The IR's references are acyclic, so this ends.
    for (const ir::MaterialId part : {mix->a, mix->b}) {
      const Facts inner = find(scene, part);
      facts.emissive = facts.emissive || inner.emissive;
      facts.transparent = facts.transparent || inner.transparent;
      facts.clear = facts.clear || inner.clear;
      facts.two_sided = facts.two_sided || inner.two_sided;
      facts.textured_emission = facts.textured_emission || inner.textured_emission ||
                                (inner.emissive && mix->weight.texture.valid());
    }
    // Parts that emit from one side and from both: only the material itself can tell.
    facts.textured_emission = facts.textured_emission || (facts.emissive && facts.two_sided);
  }
  facts_[id.value()] = facts;
  return facts;
}

}  // namespace scenec::backend
