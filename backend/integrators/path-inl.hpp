// `.path`: one path a sample, light found both by aiming at lights and by chance, the two weighted
// by the power heuristic (Veach and Guibas 1995). Paths end by chance, by nothing else unless
// max_depth is written: no clamps, no cut-offs.
#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "backend/integrators/casters-inl.hpp"
#include "backend/integrators/surface.hpp"
#include "base/elementary.hpp"

namespace scenec::backend {

[[nodiscard]] inline double power_heuristic(double a, double b) {
  if (std::isinf(a)) return 1;
  const double a2 = a * a;
  return a2 / (a2 + b * b);
}
// The weight of light found by aiming at it, and by chance, from the two densities.
[[nodiscard]] inline double weight_of_aiming(LightFinding finding, double aimed, double by_chance) {
  if (finding == LightFinding::both) [[likely]]
    return power_heuristic(aimed, by_chance);
  return finding == LightFinding::aiming ? 1 : 0;
}
[[nodiscard]] inline double weight_of_chance(LightFinding finding, double by_chance, double aimed) {
  if (finding == LightFinding::both) [[likely]]
    return power_heuristic(by_chance, aimed);
  return finding == LightFinding::aiming && aimed > 0 ? 0 : 1;
}

template <EffectMask compiled>
class PathTracer {
 public:
  PathTracer(const Tracer<compiled>& tracer, const Sampler& sampler)
      : tracer_(tracer),
        scene_(tracer.scene()),
        sampler_(sampler),
        casters_(tracer, sampler),
        asks_casters_(casters_.asked_for()),
        max_depth_(static_cast<std::uint64_t>(
            tracer.settings().max_depth.value_or(std::int64_t{1} << 32))) {}

  TracedSample trace(const Ray& ray) {
    ray_ = ray;
    while (step()) {
    }
    out_.radiance = radiance_;
    return out_;
  }

 private:
  // Even a path that loses nothing ends at last.
  static constexpr double longest_survival = 0.95;

  template <ir::Effect effect>
  [[nodiscard]] bool with() const {
    return tracer_.template with<effect>();
  }

  // Follows one ray; false when the path ends.
  bool step() {
    Hit hit;
    if (!tracer_.intersect(ray_, kind_, depth_, sampler_, hit)) {
      add_escaped();
      return false;
    }
    if constexpr ((compiled & bit_of(ir::Effect::refraction)) != 0) {
      if (!media_.empty()) throughput_ *= transmittance(tracer_, media_, hit.t);
    }
    length_ += hit.t;
    tracer_.widen(hit, ray_.direction, length_);
    const RenderItem& item = scene_.items[hit.item];
    const ir::MaterialId material =
        item.light != RenderItem::none ? ir::MaterialId{} : scene_.material_of(hit);
    add_emission(hit, item, material);
    if (depth_ == 0) out_.covered = true;
    if (item.light != RenderItem::none) {
      // Shapes of lights scatter nothing; one that is not visible does not even stop the path.
      if (scene_.lights.emitters[item.light].visible) return false;
      ray_ = spawn_ray(hit, ray_.direction);
      return true;
    }
    if (depth_ >= max_depth_) return false;
    const Vector3 to_viewer = -ray_.direction;
    const PreparedMaterial& prepared = scene_.materials[material.value()];
    if (prepared.use == PreparedMaterial::Use::matt) {
      const MattSurface surface =
          tracer_.timed(RenderStage::materials, [&] { return matt_at(prepared, hit, to_viewer); });
      return meet(hit, surface, surface.shading, material);
    }
    const Bsdf bsdf = bsdf_at(tracer_, media_, material, hit, to_viewer, sampler_, depth_);
    return meet(hit, bsdf, bsdf.frame.z, material);
  }

  template <class Surface>
  bool meet(const Hit& hit, const Surface& surface, const UnitVector3& normal,
            ir::MaterialId material) {
    if (depth_ == 0 && tracer_.job().wants_first_hit)
      out_.first = first_hit_of(hit, surface, normal, material);
    const bool lit = !scattered_ || with<ir::Effect::interreflection>();
    if (lit && has_smooth_part(surface)) add_direct(hit, surface, normal);
    const bool aims = asks_casters_ && lit && has_smooth_part(surface) && media_.empty();
    if (aims) add_thrown(hit, surface);
    return scatter(hit, surface, normal, material, aims) && survives();
  }

  // The density of aiming at a light among all.
  [[nodiscard]] double chosen(std::size_t light) const {
    return with<ir::Effect::many_lights>() ? scene_.lights.probability(light, scatter_place_) : 1;
  }

  void add_escaped() {
    const LightTable& lights = scene_.lights;
    const Vector3& d = ray_.direction;
    if (scattered_) {
      if (!with<ir::Effect::environment>()) return;
      tracer_.count(ir::Effect::environment);
    }
    if (depth_ == 0 || lights.environments.empty()) {
      radiance_ += throughput_ * tracer_.escaped(d, depth_ == 0);
      return;
    }
    for (std::size_t i = 0; i < lights.environments.size(); ++i) {
      const std::size_t light = lights.first_environment() + i;
      double weight = 1;
      if (!specular_ && !lights.is_constant_environment(light))
        weight = weight_of_chance(lights.finding, scatter_pdf_,
                                  chosen(light) * lights.environments[i].pdf(d));
      radiance_ += throughput_ * lights.environments[i].radiance(d) * weight;
    }
  }

  void add_emission(const Hit& hit, const RenderItem& item, ir::MaterialId material) {
    if (scattered_ && !with<ir::Effect::area_lights>()) return;
    const Rgb emitted = tracer_.emitted(hit, item, material, -ray_.direction);
    if (is_black(emitted)) return;
    if (scattered_) tracer_.count(ir::Effect::area_lights);
    double weight = 1;
    if (asks_casters_ && (chain_.state == CasterChain::State::mirrored ||
                          chain_.state == CasterChain::State::through)) {
      weight = weight_of_thrown(hit);
    } else if (!specular_) {
      const std::uint32_t emitter = scene_.emitter_of(hit);
      if (emitter != RenderItem::none) {
        const LightTable& lights = scene_.lights;
        const double pdf = pdf_emitter(lights.emitters[emitter], scatter_place_.point, hit.point,
                                       hit.geometric_normal);
        weight = weight_of_chance(lights.finding, scatter_pdf_,
                                  chosen(lights.first_emitter() + emitter) * pdf);
      }
    }
    radiance_ += throughput_ * emitted * weight;
  }

  template <class Surface>
  void add_direct(const Hit& hit, const Surface& surface, const UnitVector3& normal) {
    const LightTable& lights = scene_.lights;
    if (scattered_) tracer_.count(ir::Effect::interreflection);
    if (!with<ir::Effect::many_lights>()) {
      // Without a choice among lights every one is asked.
      const auto weight = [&](const LightSample& light, double bsdf_pdf) {
        return light.delta ? 1.0 : weight_of_aiming(lights.finding, light.pdf, bsdf_pdf);
      };
      for (std::size_t light = 0; light < lights.size(); ++light) {
        if (!lights.can_be_drawn(light)) continue;
        radiance_ += throughput_ * tracer_.direct(hit, surface, light, depth_, sampler_, weight);
      }
      return;
    }
    tracer_.count(ir::Effect::many_lights);
    const double u = sampler_.get_1d(dimension::bounce(depth_) + dimension::light_choice);
    const LightTable::Choice choice = tracer_.timed(
        RenderStage::lights, [&] { return lights.choose(u, lit_place(hit, surface, normal)); });
    if (!(choice.probability > 0)) return;
    const auto weight = [&](const LightSample& light, double bsdf_pdf) {
      return light.delta
                 ? 1.0
                 : weight_of_aiming(lights.finding, choice.probability * light.pdf, bsdf_pdf);
    };
    radiance_ += throughput_ *
                 tracer_.direct(hit, surface, choice.light, depth_, sampler_, weight) *
                 (1 / choice.probability);
  }

  // How much of what the path finds the viewer gets.
  [[nodiscard]] double worth() const { return smaller(1, max_component(throughput_) * eta_scale_); }

  // Light of lamps by way of smooth spheres.
  template <class Surface>
  void add_thrown(const Hit& hit, const Surface& surface) {
    const auto weight = [&](double aimed, double by_chance) {
      return weight_of_aiming(scene_.lights.finding, aimed, by_chance);
    };
    radiance_ +=
        throughput_ * casters_.aimed(hit, surface, depth_, max_depth_ - depth_, worth(), weight);
  }
  // Of a lamp that was met by way of a caster.
  [[nodiscard]] double weight_of_thrown(const Hit& lamp) const {
    const std::uint32_t emitter = scene_.emitter_of(lamp);
    if (emitter == RenderItem::none) return 1;
    return weight_of_chance(scene_.lights.finding, casters_.by_chance(chain_),
                            casters_.density(chain_, emitter, lamp, ray_.direction));
  }

  bool survives() {
    if (is_black(throughput_)) return false;
    if (depth_ <= scene_.sure_bounces) return true;
    const double p = smaller(longest_survival, worth());
    if (!(sampler_.get_1d(dimension::bounce(depth_ - 1) + dimension::roulette) < p)) return false;
    throughput_ *= 1 / p;
    return true;
  }

  // Whether the picture is simulated with what the sampled direction shows.
  [[nodiscard]] bool follows(const BsdfSample& s) const {
    if (s.transmitted && !with<ir::Effect::refraction>()) return false;
    if (!s.specular) {
      // Light that a matt surface hands to another one: only mirrors and glass may stand between.
      return !scattered_ || with<ir::Effect::interreflection>();
    }
    if (!s.transmitted) {
      if (!with<ir::Effect::reflection>()) return false;
      tracer_.count(ir::Effect::reflection);
    }
    if (!scattered_) return true;
    if (!with<ir::Effect::caustics>()) return false;
    tracer_.count(ir::Effect::caustics);
    return true;
  }

  template <class Surface>
  bool scatter(const Hit& hit, const Surface& surface, const UnitVector3& normal,
               ir::MaterialId material, bool aims) {
    const std::uint32_t base = dimension::bounce(depth_);
    constexpr bool one_lobe = std::is_same_v<Surface, MattSurface>;
    const double lobe = one_lobe ? 0 : sampler_.get_1d(base + dimension::lobe);
    const BsdfSample s = tracer_.timed(RenderStage::materials, [&] {
      return sample_bsdf(surface, lobe, sampler_.get_2d(base + dimension::direction));
    });
    if (is_black(s.weight) || !follows(s)) return false;
    const double worth_before = worth();
    throughput_ *= s.weight;
    eta_scale_ *= s.eta_scale;
    scatter_pdf_ = s.pdf;
    specular_ = s.specular;
    scattered_ = scattered_ || !s.specular;
    scatter_place_ = lit_place(hit, surface, normal);
    if (asks_casters_) casters_.follow(chain_, hit, s, surface.entering, aims, worth_before, ray_);
    ray_ = spawn_ray(hit, s.wi);
    kind_ = kind_of(s);
    if (s.transmitted) cross(tracer_, media_, material, surface.entering);
    ++depth_;
    return true;
  }

  static RayKind kind_of(const BsdfSample& s) {
    if (s.transmitted) return RayKind::refracted;
    return s.specular ? RayKind::reflected : RayKind::bounced;
  }

  // What light a place can receive: of an opaque surface, that of one side.
  static LitPlace lit_place(const Hit& hit, const MattSurface&, const UnitVector3& normal) {
    return {hit.point, normal.vector()};
  }
  static LitPlace lit_place(const Hit& hit, const Bsdf& bsdf, const UnitVector3& normal) {
    return {hit.point, is_clear(bsdf) ? Vector3{} : normal.vector()};
  }

  const Tracer<compiled>& tracer_;
  const RenderScene& scene_;
  const Sampler& sampler_;
  CasterLight<compiled> casters_;
  bool asks_casters_;
  std::uint64_t max_depth_;
  Ray ray_;
  RayKind kind_ = RayKind::camera;
  Rgb throughput_{1, 1, 1};
  Rgb radiance_;
  double length_ = 0;       // of the path so far
  double eta_scale_ = 1;    // radiance scalings undone, for judging what the path can still bring
  double scatter_pdf_ = 0;  // of the last direction
  bool specular_ = true;    // the last direction could not have been found by aiming
  bool scattered_ = false;  // some direction before could have been
  LitPlace scatter_place_;  // where it started
  std::uint32_t depth_ = 0;
  CasterChain chain_;
  MediumStack media_;
  TracedSample out_;
};

}  // namespace scenec::backend
