#include "backend/materials/prepared_material.hpp"

#include "backend/materials/fill_bsdf.hpp"

namespace scenec::backend {
namespace {

// Reads inputs that do not vary, and remembers whether one did.
class ConstantInputs {
 public:
  explicit ConstantInputs(const ir::Folding& folding) : folding_(folding) {}

  [[nodiscard]] Rgb color(const ir::ColorInput& input) {
    const auto c = folding_.color(input);
    varied_ = varied_ || !c;
    return c ? Rgb(c->r, c->g, c->b) : Rgb();
  }
  [[nodiscard]] double number(const ir::NumberInput& input) {
    const auto n = folding_.number(input);
    varied_ = varied_ || !n;
    return n.value_or(0);
  }
  [[nodiscard]] bool varied() const { return varied_; }

 private:
  const ir::Folding& folding_;
  bool varied_ = false;
};

double ior_of(const ir::MaterialKind& kind) {
  if (const auto* glass = std::get_if<ir::Dielectric>(&kind)) return glass->ior;
  if (const auto* phong = std::get_if<ir::Phong>(&kind)) return phong->ior;
  return 1;
}

}  // namespace

std::vector<PreparedMaterial> prepare_materials(const ir::Scene& scene,
                                                const ir::ImageFacts& images,
                                                const GgxAlbedo* ggx_albedo) {
  const ir::Folding folding(scene, images);
  std::vector<PreparedMaterial> out(scene.materials.size());
  for (std::uint32_t i = 0; i < out.size(); ++i) {
    const ir::Material& material = scene.materials[ir::MaterialId(i)];
    PreparedMaterial& p = out[i];
    p.ior = ior_of(material.kind);
    p.bsdf.albedo = ggx_albedo;
    if (std::holds_alternative<ir::Mix>(material.kind) || material.common.normal_map.valid())
      continue;
    ConstantInputs inputs(folding);
    fill_bsdf(material.kind, inputs, p.bsdf);
    if (inputs.varied()) continue;
    p.use = PreparedMaterial::Use::constant;
    if (p.bsdf.kind != BsdfKind::diffuse) continue;
    p.use = PreparedMaterial::Use::matt;
    p.albedo = p.bsdf.diffuse;
  }
  return out;
}

}  // namespace scenec::backend
