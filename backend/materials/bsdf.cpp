#include "backend/materials/bsdf.hpp"

#include <algorithm>
#include <cmath>

#include "backend/materials/fresnel.hpp"
#include "backend/materials/microfacet.hpp"

namespace scenec::backend {
namespace {

double mean(const Rgb& c) {
  return (c.r + c.g + c.b) / 3;
}

// Reflectance of metal or coat at a facet.
Rgb facet_reflectance(const Bsdf& b, double cos_i) {
  cos_i = std::clamp(cos_i, 0.0, 1.0);
  if (b.eta.r > 0) {
    return {fresnel_conductor(cos_i, b.eta.r, b.k.r), fresnel_conductor(cos_i, b.eta.g, b.k.g),
            fresnel_conductor(cos_i, b.eta.b, b.k.b)};
  }
  return fresnel_schlick(cos_i, b.specular);
}

// The diffuse base seen through the coat, without its albedo and the 1/pi: what the coat lets in
// from wi times what it lets out.
Rgb through_coat(const Bsdf& b, double cos_wi) {
  const Rgb in =
      Rgb(1, 1, 1) - b.albedo->directional(cos_wi, b.alpha).of(b.specular) * b.compensation;
  // The compensation is that of the viewer's direction: for bright coats it may pass 1 elsewhere.
  return Rgb(larger(0, in.r), larger(0, in.g), larger(0, in.b)) * b.coat_out;
}

BsdfValue evaluate_diffuse(const Rgb& albedo, double cos_wi, double probability) {
  return {albedo * (cos_wi / pi), probability * cos_wi / pi};
}

// GGX reflection: value without the choice of lobe.
BsdfValue evaluate_facets(const Bsdf& b, const Vector3& wi) {
  const Vector3 m = normalized(b.wo + wi).vector();
  const double density = ggx_density(m, b.alpha);
  const double facing = dot(b.wo, m);
  const double g2 = ggx_visible_both(b.wo, wi, b.alpha);
  BsdfValue value;
  value.f_cos = facet_reflectance(b, facing) * b.compensation * (density * g2 / (4 * b.wo.z));
  value.pdf = ggx_visible(b.wo, b.alpha) * density / (4 * b.wo.z);
  return value;
}

BsdfValue evaluate_phong(const Bsdf& b, const Vector3& wi) {
  BsdfValue value = evaluate_diffuse(b.diffuse, wi.z, b.lobe_probability[0]);
  if (b.lobe_probability[1] > 0) {
    const double cos_alpha = dot(reflected(b.wo, {0, 0, 1}), wi);
    if (cos_alpha > 0) {
      const double power = pow(cos_alpha, b.exponent);
      value.f_cos += b.specular * ((b.exponent + 2) / (2 * pi) * power * wi.z);
      value.pdf += b.lobe_probability[1] * (b.exponent + 1) / (2 * pi) * power;
    }
  }
  return value;
}

BsdfValue evaluate_rough_glass(const Bsdf& b, const Vector3& wi) {
  const bool reflects = wi.z > 0;
  const double eta = b.ior;
  Vector3 m = reflects ? b.wo + wi : b.wo + wi * eta;
  m = normalized(m).vector();
  if (m.z < 0) m = -m;
  const double o = dot(b.wo, m);
  const double i = dot(wi, m);
  if (!(o > 0) || (reflects ? !(i > 0) : !(i < 0))) return {};
  const double f = fresnel_dielectric(o, eta).reflectance;
  const double density = ggx_density(m, b.alpha);
  const double g2 = ggx_visible_both(b.wo, wi, b.alpha);
  const double visible = ggx_visible(b.wo, b.alpha) * density * o / b.wo.z;
  if (reflects) return {Rgb::gray(f * density * g2 / (4 * b.wo.z)), f * visible / (4 * o)};
  const double denominator = (i + o / eta) * (i + o / eta);
  if (!(denominator > 0)) return {};
  const double value =
      (1 - f) * density * g2 * std::fabs(i * o) / (b.wo.z * denominator) / (eta * eta);
  return {b.specular * value, (1 - f) * visible * std::fabs(i) / denominator};
}

BsdfSample absorbed() {
  return {};
}

// A reflected direction (frame coordinates) made a sample, unless it is below a surface.
BsdfSample reflection(const Bsdf& b, const Vector3& wi, const Rgb& weight) {
  const Vector3 world = b.frame.world_of(wi);
  if (!(wi.z > 0) || !(dot(world, b.geometric) > 0)) return absorbed();
  BsdfSample s;
  s.wi = normalized(world).vector();
  s.weight = weight;
  return s;
}

BsdfSample specular_reflection(const Bsdf& b, const Rgb& weight) {
  BsdfSample s = reflection(b, reflected(b.wo, {0, 0, 1}), weight);
  s.specular = true;
  return s;
}

BsdfSample specular_transmission(const Bsdf& b, const Rgb& weight, double cos_t) {
  const Vector3 wi = refracted(b.wo, {0, 0, 1}, b.wo.z, b.ior, cos_t);
  const Vector3 world = b.frame.world_of(wi);
  if (!(dot(world, b.geometric) < 0)) return absorbed();
  BsdfSample s;
  s.wi = normalized(world).vector();
  s.weight = weight * (1 / (b.ior * b.ior));
  s.specular = true;
  s.transmitted = true;
  s.eta_scale = b.ior * b.ior;
  return s;
}

BsdfSample sample_glass(const Bsdf& b, double lobe) {
  const DielectricFresnel f = fresnel_dielectric(b.wo.z, b.ior);
  if (lobe < f.reflectance) return specular_reflection(b, {1, 1, 1});
  return specular_transmission(b, b.specular, f.cos_t);
}

BsdfSample sample_rough_glass(const Bsdf& b, double lobe, Sample2 u) {
  const Vector3 m = sample_ggx_normal(b.wo, b.alpha, u);
  const double o = dot(b.wo, m);
  if (!(o > 0)) return absorbed();
  const DielectricFresnel f = fresnel_dielectric(smaller(1, o), b.ior);
  BsdfSample s;
  Vector3 wi;
  if (lobe < f.reflectance) {
    wi = reflected(b.wo, m);
    s = reflection(b, wi, {1, 1, 1});
    if (is_black(s.weight)) return s;
  } else {
    wi = refracted(b.wo, m, o, b.ior, f.cos_t);
    const Vector3 world = b.frame.world_of(wi);
    if (!(wi.z < 0) || !(dot(world, b.geometric) < 0)) return absorbed();
    s.wi = normalized(world).vector();
    s.weight = b.specular * (1 / (b.ior * b.ior));
    s.transmitted = true;
    s.eta_scale = b.ior * b.ior;
  }
  s.weight *= ggx_visible_both(b.wo, wi, b.alpha) / ggx_visible(b.wo, b.alpha);
  s.pdf = evaluate_rough_glass(b, wi).pdf;
  return s.pdf > 0 ? s : absorbed();
}

BsdfSample sample_diffuse(const Bsdf& b, Sample2 u) {
  const Vector3 wi = sample_cosine_hemisphere(u).vector();
  BsdfSample s = reflection(b, wi, b.diffuse);
  s.pdf = wi.z / pi;
  return s;
}

// A sample of one of several lobes: weight and density of all smooth ones together.
BsdfSample combined(const Bsdf& b, const Vector3& wi) {
  BsdfSample s = reflection(b, wi, {1, 1, 1});
  if (is_black(s.weight)) return s;
  const BsdfValue value = evaluate(b, s.wi);
  if (!(value.pdf > 0)) return absorbed();
  s.pdf = value.pdf;
  s.weight = value.f_cos / value.pdf;
  return s;
}

BsdfSample sample_phong(const Bsdf& b, double lobe, Sample2 u) {
  const auto& p = b.lobe_probability;
  if (lobe < p[0]) return combined(b, sample_cosine_hemisphere(u).vector());
  if (lobe < p[0] + p[1]) {
    const double cos_alpha = pow(u.u, 1 / (b.exponent + 1));
    const double sin_alpha = std::sqrt(larger(0, 1 - cos_alpha * cos_alpha));
    const SinCos phi = sin_cos_of_turns(u.v);
    const Frame about = frame_about(UnitVector3::assume_unit(reflected(b.wo, {0, 0, 1})));
    return combined(b,
                    about.world_of(Vector3{sin_alpha * phi.cos, sin_alpha * phi.sin, cos_alpha}));
  }
  if (lobe < p[0] + p[1] + p[2] || !(p[3] > 0)) {
    return p[2] > 0 ? specular_reflection(b, b.reflect / p[2]) : absorbed();
  }
  const DielectricFresnel f = fresnel_dielectric(b.wo.z, b.ior);
  if (f.cos_t == 0) return specular_reflection(b, b.refract / p[3]);
  return specular_transmission(b, b.refract / p[3], f.cos_t);
}

BsdfSample sample_coat(const Bsdf& b, double lobe, Sample2 u) {
  if (lobe >= b.lobe_share) return combined(b, sample_cosine_hemisphere(u).vector());
  if (b.kind == BsdfKind::smooth_coat)
    return specular_reflection(b, facet_reflectance(b, b.wo.z) / b.lobe_share);
  return combined(b, reflected(b.wo, sample_ggx_normal(b.wo, b.alpha, u)));
}

}  // namespace

void finish(Bsdf& b) {
  b.compensation = {1, 1, 1};
  const bool has_facets = b.kind == BsdfKind::rough_metal || b.kind == BsdfKind::coat;
  if (has_facets && b.albedo->lost_light == LostLight::returned) {
    const Rgb normal = facet_reflectance(b, 1);
    const double full = b.albedo->directional(b.wo.z, b.alpha).full();
    b.compensation = Rgb(1, 1, 1) + normal * ((1 - full) / full);
  }
  if (b.kind == BsdfKind::coat || b.kind == BsdfKind::smooth_coat) {
    const Rgb out = b.albedo->directional(b.wo.z, b.alpha).of(b.specular) * b.compensation;
    const Rgb average = b.albedo->average(b.alpha).of(b.specular) * b.compensation;
    const auto share = [](double o, double a) { return a < 1 ? larger(0, 1 - o) / (1 - a) : 0.0; };
    b.coat_out = {share(out.r, average.r), share(out.g, average.g), share(out.b, average.b)};
    const double coat = mean(out);
    const double base = mean(b.diffuse) * larger(0, 1 - coat);
    b.lobe_share = base > 0 ? std::clamp(coat / (coat + base), 0.1, 0.9) : 1;
  }
  if (b.kind == BsdfKind::phong) {
    // Weights above 1 in all would gain energy: they are scaled down together, a channel each.
    const Rgb sum = b.diffuse + b.specular + b.reflect + b.refract;
    const Rgb scale{sum.r > 1 ? 1 / sum.r : 1, sum.g > 1 ? 1 / sum.g : 1,
                    sum.b > 1 ? 1 / sum.b : 1};
    for (Rgb* lobe : {&b.diffuse, &b.specular, &b.reflect, &b.refract}) *lobe *= scale;
    const double total = mean(b.diffuse) + mean(b.specular) + mean(b.reflect) + mean(b.refract);
    if (!(total > 0)) {
      b.kind = BsdfKind::none;
      return;
    }
    b.lobe_probability = {mean(b.diffuse) / total, mean(b.specular) / total,
                          mean(b.reflect) / total, mean(b.refract) / total};
  }
}

bool has_smooth_part(const Bsdf& b) {
  switch (b.kind) {
    case BsdfKind::none:
    case BsdfKind::mirror:
    case BsdfKind::glass:
    case BsdfKind::metal:
      return false;
    case BsdfKind::phong:
      return b.lobe_probability[0] > 0 || b.lobe_probability[1] > 0;
    case BsdfKind::diffuse:
    case BsdfKind::rough_glass:
    case BsdfKind::rough_metal:
    case BsdfKind::coat:
    case BsdfKind::smooth_coat:
      return true;
  }
  return false;
}

BsdfValue evaluate(const Bsdf& b, const Vector3& wi_world) {
  const Vector3 wi = b.frame.local_of(wi_world);
  const double side = dot(wi_world, b.geometric);
  if (b.kind == BsdfKind::rough_glass) {
    return wi.z * side > 0 ? evaluate_rough_glass(b, wi) : BsdfValue{};
  }
  if (!(wi.z > 0) || !(side > 0)) return {};
  switch (b.kind) {
    case BsdfKind::diffuse:
      return evaluate_diffuse(b.diffuse, wi.z, 1);
    case BsdfKind::phong:
      return evaluate_phong(b, wi);
    case BsdfKind::rough_metal:
      return evaluate_facets(b, wi);
    case BsdfKind::coat: {
      BsdfValue value = evaluate_facets(b, wi);
      value.pdf *= b.lobe_share;
      const BsdfValue base =
          evaluate_diffuse(b.diffuse * through_coat(b, wi.z), wi.z, 1 - b.lobe_share);
      return {value.f_cos + base.f_cos, value.pdf + base.pdf};
    }
    case BsdfKind::smooth_coat:
      return evaluate_diffuse(b.diffuse * through_coat(b, wi.z), wi.z, 1 - b.lobe_share);
    default:
      return {};
  }
}

BsdfSample sample_bsdf(const Bsdf& b, double lobe, Sample2 u) {
  switch (b.kind) {
    case BsdfKind::none:
      return absorbed();
    case BsdfKind::diffuse:
      return sample_diffuse(b, u);
    case BsdfKind::phong:
      return sample_phong(b, lobe, u);
    case BsdfKind::mirror:
      return specular_reflection(b, b.specular);
    case BsdfKind::metal:
      return specular_reflection(b, facet_reflectance(b, b.wo.z));
    case BsdfKind::glass:
      return sample_glass(b, lobe);
    case BsdfKind::rough_glass:
      return sample_rough_glass(b, lobe, u);
    case BsdfKind::rough_metal:
      return combined(b, reflected(b.wo, sample_ggx_normal(b.wo, b.alpha, u)));
    case BsdfKind::coat:
    case BsdfKind::smooth_coat:
      return sample_coat(b, lobe, u);
  }
  return absorbed();
}

Rgb smooth_reflectance(const Bsdf& b, double cos_i) {
  return b.kind == BsdfKind::mirror ? b.specular : facet_reflectance(b, cos_i);
}

SpecularRays specular_rays(const Bsdf& b) {
  SpecularRays out;
  const auto add = [&](const BsdfSample& s) {
    if (!is_black(s.weight))
      out.rays[static_cast<std::size_t>(out.count++)] = {s.wi, s.weight, s.transmitted};
  };
  switch (b.kind) {
    case BsdfKind::mirror:
      add(specular_reflection(b, b.specular));
      break;
    case BsdfKind::metal:
    case BsdfKind::smooth_coat:
      add(specular_reflection(b, facet_reflectance(b, b.wo.z)));
      break;
    case BsdfKind::glass: {
      const DielectricFresnel f = fresnel_dielectric(b.wo.z, b.ior);
      if (f.reflectance < 1)
        add(specular_transmission(b, b.specular * (1 - f.reflectance), f.cos_t));
      if (f.reflectance > 0) add(specular_reflection(b, Rgb::gray(f.reflectance)));
      break;
    }
    case BsdfKind::phong: {
      const DielectricFresnel f = fresnel_dielectric(b.wo.z, b.ior);
      Rgb mirrored = b.reflect;
      if (f.cos_t == 0)
        mirrored += b.refract;
      else
        add(specular_transmission(b, b.refract, f.cos_t));
      add(specular_reflection(b, mirrored));
      break;
    }
    default:
      break;
  }
  return out;
}

Rgb albedo_of(const Bsdf& b) {
  switch (b.kind) {
    case BsdfKind::none:
      return {};
    case BsdfKind::diffuse:
      return b.diffuse;
    case BsdfKind::phong:
      return b.diffuse + b.specular + b.reflect + b.refract;
    case BsdfKind::mirror:
    case BsdfKind::glass:
    case BsdfKind::rough_glass:
      return b.specular;
    case BsdfKind::metal:
    case BsdfKind::rough_metal:
      return facet_reflectance(b, b.wo.z);
    case BsdfKind::coat:
    case BsdfKind::smooth_coat: {
      const Rgb coat = b.albedo->directional(b.wo.z, b.alpha).of(b.specular) * b.compensation;
      return coat + b.diffuse * (Rgb(1, 1, 1) - coat);
    }
  }
  return {};
}

}  // namespace scenec::backend
