// From the values of a material's keys to its lobes: all that does not depend on the viewer.
#pragma once

#include "backend/materials/bsdf.hpp"
#include "backend/materials/metals.hpp"
#include "ir/materials.hpp"
#include "ir/roughness.hpp"

namespace scenec::backend {

inline void set_roughness(Bsdf& b, double roughness, BsdfKind smooth, BsdfKind rough) {
  const double alpha = roughness * roughness;
  b.alpha = alpha < ir::specular_alpha ? 0 : smaller(alpha, 1);
  b.kind = b.alpha == 0 ? smooth : rough;
}

// `Inputs` reads colours and numbers: color(ir::ColorInput), number(ir::NumberInput).
template <class Inputs>
struct BsdfFiller {
  Inputs& in;
  Bsdf& b;

  void operator()(const ir::Diffuse& m) const {
    b.kind = BsdfKind::diffuse;
    b.diffuse = in.color(m.color);
  }
  void operator()(const ir::Phong& m) const {
    b.kind = BsdfKind::phong;
    b.diffuse = in.color(m.diffuse);
    b.specular = in.color(m.specular);
    b.reflect = in.color(m.reflect);
    b.refract = in.color(m.refract);
    b.exponent = in.number(m.shininess);
  }
  void operator()(const ir::Mirror& m) const {
    b.kind = BsdfKind::mirror;
    b.specular = in.color(m.color);
  }
  void operator()(const ir::Dielectric& m) const {
    set_roughness(b, in.number(m.roughness), BsdfKind::glass, BsdfKind::rough_glass);
    b.specular = in.color(m.tint);
  }
  void operator()(const ir::Conductor& m) const {
    set_roughness(b, in.number(m.roughness), BsdfKind::metal, BsdfKind::rough_metal);
    if (m.f0) {
      b.specular = in.color(*m.f0);
    } else if (m.preset) {
      const MetalIndices indices = indices_of(*m.preset);
      b.eta = indices.eta;
      b.k = indices.k;
    } else if (m.eta && m.k) {
      b.eta = {m.eta->r, m.eta->g, m.eta->b};
      b.k = {m.k->r, m.k->g, m.k->b};
    }
  }
  void operator()(const ir::Ggx& m) const {
    set_roughness(b, in.number(m.roughness), BsdfKind::smooth_coat, BsdfKind::coat);
    b.diffuse = in.color(m.base);
    b.specular = in.color(m.f0);
  }
  void operator()(const ir::Mix&) const {}  // one of its parts has to be chosen first
};

template <class Inputs>
void fill_bsdf(const ir::MaterialKind& kind, Inputs& in, Bsdf& b) {
  std::visit(BsdfFiller<Inputs>{in, b}, kind);
}

}  // namespace scenec::backend
