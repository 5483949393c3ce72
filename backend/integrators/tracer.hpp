// What the methods have in common: rays with see-through surfaces, light from chosen lights, light
// that arrives from infinitely far away, and the body a path is in.
#pragma once

#include <array>
#include <cstdint>

#include "backend/film/film.hpp"
#include "backend/materials/resolve.hpp"
#include "backend/render_scene.hpp"
#include "backend/samplers/dimension.hpp"
#include "backend/samplers/sampler.hpp"

namespace scenec::backend {

// Counters of one worker.
struct RayCounters {
  std::uint64_t rays = 0;
};

// The bodies a path is in, innermost last. Outside all of them is air. Beyond eight the outermost
// is forgotten; where bodies do not lie in each other, the one that is entered is the only one.
class MediumStack {
 public:
  void enter(ir::MaterialId material, bool nested) {
    if (!nested) count_ = 0;
    if (count_ == bodies_.size()) {
      for (std::size_t i = 1; i < bodies_.size(); ++i) bodies_[i - 1] = bodies_[i];
      --count_;
    }
    bodies_[count_++] = material;
  }
  void leave(ir::MaterialId material) {
    for (std::size_t i = count_; i-- > 0;) {
      if (bodies_[i] != material) continue;
      for (std::size_t j = i + 1; j < count_; ++j) bodies_[j - 1] = bodies_[j];
      --count_;
      return;
    }
  }
  [[nodiscard]] bool empty() const { return count_ == 0; }
  [[nodiscard]] ir::MaterialId innermost() const { return bodies_[count_ - 1]; }

 private:
  std::array<ir::MaterialId, 8> bodies_{};
  std::size_t count_ = 0;
};

enum class RayKind : std::uint8_t { camera, scattered, shadow };

class Tracer {
 public:
  Tracer(const RenderScene& scene, const ir::RenderSettings& settings, const ir::EffectSet& effects,
         RayCounters& counters)
      : scene_(scene), settings_(settings), effects_(effects), counters_(counters) {}

  // What the picture is simulated with.
  [[nodiscard]] bool with(ir::Effect effect) const { return effects_.has(effect); }
  [[nodiscard]] const ir::EffectSet& effects() const { return effects_; }

  [[nodiscard]] const RenderScene& scene() const { return scene_; }
  [[nodiscard]] const ir::RenderSettings& settings() const { return settings_; }

  // Surfaces with opacity below 1 let rays through at random; lights that are not visible let the
  // camera's rays and shadow rays through.
  [[nodiscard]] bool intersect(const Ray& ray, RayKind kind, std::uint32_t depth,
                               const Sampler& sampler, Hit& hit) const;
  [[nodiscard]] bool occluded(const Ray& ray, std::uint32_t depth, const Sampler& sampler) const;

  // Radiance that a hit gives off to where the ray came from, light shapes included.
  [[nodiscard]] Rgb emitted(const Hit& hit, const Vector3& to_viewer) const;
  // What a ray that leaves the scene sees. `camera`: no scattering before.
  [[nodiscard]] Rgb escaped(const Vector3& direction, bool camera) const;

  // Light from a sampled point of a light at a surface, occlusion tested; black when there is none.
  // `pdf_weight`(light sample, pdf of the bsdf) weighs it against other ways to find that light.
  template <class Weight>
  [[nodiscard]] Rgb direct(const Hit& hit, const Bsdf& bsdf, std::size_t light, std::uint32_t depth,
                           const Sampler& sampler, const Weight& weight) const {
    const std::uint32_t base = dimension::bounce(depth);
    const auto sample =
        scene_.lights.sample(light, hit.point, sampler.get_2d(base + dimension::light_point));
    if (!sample || is_black(sample->radiance) || !gives_light(*sample)) return {};
    if (!with(ir::Effect::refraction) && dot(sample->wi, bsdf.geometric) < 0) return {};
    const BsdfValue value = evaluate(bsdf, sample->wi);
    if (is_black(value.f_cos)) return {};
    const Rgb arriving = visible_radiance(hit, *sample, depth, sampler);
    if (is_black(arriving)) return {};
    return value.f_cos * arriving * (weight(*sample, value.pdf) / sample->pdf);
  }

 private:
  [[nodiscard]] bool keeps(const Hit& hit, RayKind kind, std::uint32_t depth,
                           const Sampler& sampler) const;
  [[nodiscard]] bool gives_light(const LightSample& light) const {
    if (light.emitter != nullptr) return with(ir::Effect::area_lights);
    return light.delta || with(ir::Effect::environment);
  }
  [[nodiscard]] Rgb visible_radiance(const Hit& hit, const LightSample& light, std::uint32_t depth,
                                     const Sampler& sampler) const;

  const RenderScene& scene_;
  const ir::RenderSettings& settings_;
  ir::EffectSet effects_;
  RayCounters& counters_;
};

// Branches of a `.whitted` path that wait. Each one put here is the weaker of two, so few wait at a
// time; when all places are taken the choice is left to chance. Kept by the worker, as setting it
// up for every sample would cost more than many samples do.
struct Branch {
  Ray ray;
  Rgb throughput{1, 1, 1};
  std::uint32_t depth = 0;
  MediumStack media;
};
struct BranchStack {
  std::array<Branch, 24> branches;
  std::size_t count = 0;
};

struct TracedSample {
  Rgb radiance;
  bool covered = false;
  FirstHit first;
};

// The three methods. `ray.direction` is unit.
[[nodiscard]] TracedSample trace_path(const Tracer& tracer, const Ray& ray, const Sampler& sampler);
[[nodiscard]] TracedSample trace_whitted(const Tracer& tracer, const Ray& ray,
                                         const Sampler& sampler, BranchStack& scratch);
[[nodiscard]] TracedSample trace_phong(const Tracer& tracer, const Ray& ray,
                                       const Sampler& sampler);

// For the extra layers.
[[nodiscard]] FirstHit first_hit_of(const Tracer& tracer, const Hit& hit, const Bsdf& bsdf);

}  // namespace scenec::backend
