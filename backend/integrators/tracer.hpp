// What the methods have in common: rays with see-through surfaces, light from chosen lights, light
// that arrives from infinitely far away. Templates on the effects a kernel is compiled with; which
// of those a picture is simulated with is known when it begins.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "backend/cameras/pixel_cone.hpp"
#include "backend/film/film.hpp"
#include "backend/integrators/kernel_set.hpp"
#include "backend/integrators/media.hpp"
#include "backend/integrators/probe_counters.hpp"
#include "backend/materials/matt.hpp"
#include "backend/materials/resolve.hpp"
#include "backend/render_scene.hpp"
#include "backend/samplers/dimension.hpp"
#include "backend/samplers/sampler.hpp"

namespace scenec::backend {

// Counters of one worker. `effects`: how often code ran that only this effect calls for.
struct RayCounters {
  RayCounts rays{};
  std::array<std::uint64_t, ir::effect_count> effects{};
  std::uint64_t forgotten_media = 0;
  ProbeCounters* probe = nullptr;  // of a probing kernel

  void count(RayKind kind) { ++rays[static_cast<std::size_t>(kind)]; }
  void count(ir::Effect effect) { ++effects[static_cast<std::size_t>(effect)]; }
};

[[nodiscard]] constexpr bool is_scattered(RayKind kind) {
  return kind == RayKind::reflected || kind == RayKind::refracted || kind == RayKind::bounced;
}

// What the tiles of one picture share.
struct TraceJob {
  const RenderScene& scene;
  const ir::RenderSettings& settings;
  EffectMask effects = 0;  // simulated
  HitDetail detail = HitDetail::texture;
  bool wants_first_hit = true;
  PixelCone cone;  // a point where no texture asks for more
};

template <EffectMask compiled>
class Tracer {
 public:
  Tracer(const TraceJob& job, RayCounters& counters)
      : job_(job),
        scene_(job.scene),
        effects_(job.effects & compiled),
        filters_(scene_.lights.any_invisible() ||
                 (with<ir::Effect::alpha>() && scene_.facts.any_transparent())),
        counters_(counters) {}

  // What the picture is simulated with.
  template <ir::Effect effect>
  [[nodiscard]] bool with() const {
    if constexpr ((compiled & bit_of(effect)) == 0) return false;
    return (effects_ & bit_of(effect)) != 0;
  }
  [[nodiscard]] EffectMask effects() const { return effects_; }
  [[nodiscard]] const TraceJob& job() const { return job_; }
  [[nodiscard]] const RenderScene& scene() const { return scene_; }
  [[nodiscard]] const ir::RenderSettings& settings() const { return job_.settings; }
  void count(ir::Effect effect) const { counters_.count(effect); }
  void count_forgotten_medium() const { ++counters_.forgotten_media; }

  // Surfaces with opacity below 1 let rays through at random; lights that are not visible let the
  // camera's rays and shadow rays through.
  [[nodiscard]] bool intersect(const Ray& ray, RayKind kind, std::uint32_t depth,
                               const Sampler& sampler, Hit& hit) const {
    counters_.count(kind);
    if (!filters_) return closest(kind, ray, hit, {});
    const auto keep = [&](const Hit& candidate) { return keeps(candidate, kind, depth, sampler); };
    return closest(kind, ray, hit, HitFilter(keep));
  }
  [[nodiscard]] bool occluded(const Ray& ray, std::uint32_t depth, const Sampler& sampler) const {
    if (!with<ir::Effect::shadows>()) return false;
    count(ir::Effect::shadows);
    return hidden(ray, depth, sampler);
  }
  // As above where it is no matter of shadows: for ways that a path could take itself.
  [[nodiscard]] bool hidden(const Ray& ray, std::uint32_t depth, const Sampler& sampler) const {
    counters_.count(RayKind::shadow);
    if (!filters_) return any(ray, {});
    const auto keep = [&](const Hit& candidate) {
      return keeps(candidate, RayKind::shadow, depth, sampler);
    };
    return any(ray, HitFilter(keep));
  }

  // Does the work; a probing kernel takes the time.
  template <class F>
  [[nodiscard]] auto timed(RenderStage stage, F&& work) const {
    if constexpr ((compiled & probing_kernel) == 0) {
      return work();
    } else {
      const StageClock clock(*counters_.probe, stage);
      return work();
    }
  }

  [[nodiscard]] TexturePlace texture_place(const Hit& hit) const {
    return with<ir::Effect::textures>() ? texture_place_of(hit) : TexturePlace(0.5, 0.5);
  }
  // Sets how wide the pixel's cone is at a hit, `length` of path from the camera.
  void widen(Hit& hit, const Vector3& direction, double length) const {
    if (job_.cone.is_point()) [[likely]]
      return;
    const double cosine = std::fabs(dot(hit.geometric_normal, direction));
    hit.width = job_.cone.width_at(length) / larger(cosine, PixelCone::least_cosine);
  }

  // Radiance that a hit gives off to where the ray came from, light shapes included.
  [[nodiscard]] Rgb emitted(const Hit& hit, const RenderItem& item, ir::MaterialId material,
                            const Vector3& to_viewer) const {
    if (item.light != RenderItem::none) {
      const Emitter& e = scene_.lights.emitters[item.light];
      return e.two_sided || dot(hit.geometric_normal, to_viewer) > 0 ? e.radiance : Rgb{};
    }
    if (!scene_.facts.emissive(material)) return {};
    return emission_of(scene_, material, texture_place(hit),
                       dot(hit.geometric_normal, to_viewer) > 0);
  }
  // What a ray that leaves the scene sees. `camera`: no scattering before.
  [[nodiscard]] Rgb escaped(const Vector3& direction, bool camera) const {
    const ir::Color& c = job_.settings.background;
    if (scene_.lights.environments.empty()) return {c.r, c.g, c.b};
    if (camera && job_.settings.background_written) return {c.r, c.g, c.b};
    return scene_.lights.environment_radiance(direction);
  }

  // Light from a sampled point of a light at a surface, occlusion tested; black when there is none.
  // `pdf_weight`(light sample, pdf of the bsdf) weighs it against other ways to find that light.
  template <class Surface, class Weight>
  [[nodiscard]] Rgb direct(const Hit& hit, const Surface& surface, std::size_t light,
                           std::uint32_t depth, const Sampler& sampler,
                           const Weight& weight) const {
    const std::uint32_t base = dimension::bounce(depth);
    LightSample sample;
    const bool drawn = timed(RenderStage::lights, [&] {
      return scene_.lights.sample(light, hit.point, sampler.get_2d(base + dimension::light_point),
                                  sample);
    });
    if (!drawn || is_black(sample.radiance) || !gives_light(sample)) return {};
    if (!with<ir::Effect::refraction>() && dot(sample.wi, surface.geometric) < 0) return {};
    const BsdfValue value =
        timed(RenderStage::materials, [&] { return evaluate(surface, sample.wi); });
    if (is_black(value.f_cos)) return {};
    const Rgb arriving = visible_radiance(hit, sample, depth, sampler);
    if (is_black(arriving)) return {};
    return value.f_cos * arriving * (weight(sample, value.pdf) / sample.pdf);
  }

 private:
  [[nodiscard]] bool closest(RayKind kind, const Ray& ray, Hit& hit,
                             const HitFilter& filter) const {
    return closest(kind, ray, hit, filter, job_.detail);
  }
  [[nodiscard]] bool closest([[maybe_unused]] RayKind kind, const Ray& ray, Hit& hit,
                             const HitFilter& filter, HitDetail detail) const {
    if constexpr ((compiled & probing_kernel) != 0)
      counters_.probe->count_tests(kind, scene_.accel, ray, filter);
    return timed(stage_of(kind), [&] { return scene_.accel.intersect(ray, hit, filter, detail); });
  }
  [[nodiscard]] bool any(const Ray& ray, const HitFilter& filter) const {
    if constexpr ((compiled & probing_kernel) != 0)
      counters_.probe->count_tests(RayKind::shadow, scene_.accel, ray, filter);
    return timed(stage_of(RayKind::shadow), [&] { return scene_.accel.occluded(ray, filter); });
  }

  [[nodiscard]] bool keeps(const Hit& hit, RayKind kind, std::uint32_t depth,
                           const Sampler& sampler) const {
    const RenderItem& item = scene_.items[hit.item];
    if (item.light != RenderItem::none)
      return is_scattered(kind) || scene_.lights.emitters[item.light].visible;
    if (!with<ir::Effect::alpha>()) return true;
    count(ir::Effect::alpha);
    const double opacity = opacity_of(scene_, scene_.material_of(hit), texture_place(hit));
    if (opacity >= 1) return true;
    if (!(opacity > 0)) return false;
    // Each surface a ray passes takes a number of its own: told apart by what and where it is.
    const std::uint64_t key = path_key(hit.instances.data(), hit.instance_count, hit.item);
    const std::uint64_t what = key ^ (static_cast<std::uint64_t>(hit.primitive) << 32) ^
                               std::bit_cast<std::uint64_t>(hit.t) ^
                               (kind == RayKind::shadow ? 0x9e3779b97f4a7c15ULL : 0);
    return sampler.random(dimension::bounce(depth) + dimension::opacity, what) < opacity;
  }

  [[nodiscard]] bool gives_light(const LightSample& light) const {
    if (light.emitter != nullptr) {
      if (!with<ir::Effect::area_lights>()) return false;
      count(ir::Effect::area_lights);
      return true;
    }
    if (light.delta) return true;
    if (!with<ir::Effect::environment>()) return false;
    count(ir::Effect::environment);
    return true;
  }

  [[nodiscard]] Rgb visible_radiance(const Hit& hit, const LightSample& light, std::uint32_t depth,
                                     const Sampler& sampler) const {
    if (light.infinite)
      return occluded(spawn_ray(hit, light.wi), depth, sampler) ? Rgb{} : light.radiance;
    const Ray segment = light.emitter != nullptr
                            ? spawn_segment(surface_point(hit),
                                            {light.target, light.target_error, light.target_normal})
                            : spawn_segment(surface_point(hit), light.target);
    if (occluded(segment, depth, sampler)) return {};
    if (light.emitter == nullptr || !light.emitter->textured) return light.radiance;
    return textured_radiance(hit, light);
  }
  // The radiance there varies: look at the light's surface itself, past what hides nothing.
  [[nodiscard]] Rgb textured_radiance(const Hit& hit, const LightSample& light) const {
    Hit seen;
    counters_.count(RayKind::light);
    const auto on_emitter = [&](const Hit& candidate) {
      const std::uint32_t emitter = scene_.emitter_of(candidate);
      return emitter != RenderItem::none && &scene_.lights.emitters[emitter] == light.emitter;
    };
    const Ray ray = spawn_ray(hit, light.wi);
    if (!closest(RayKind::light, ray, seen, HitFilter(on_emitter), HitDetail::texture)) return {};
    if (!on_emitter(seen)) return {};
    const ir::MaterialId material = scene_.material_of(seen);
    // Where the light itself is see-through, its surface is there with that probability only; the
    // shadow ray has not been asked, as it ends before the surface.
    const double opacity =
        with<ir::Effect::alpha>() ? opacity_of(scene_, material, texture_place(seen)) : 1;
    return emitted(seen, scene_.items[seen.item], material, -light.wi) * opacity;
  }

  const TraceJob& job_;
  const RenderScene& scene_;
  EffectMask effects_;
  bool filters_;
  RayCounters& counters_;
};

// Branches of a `.whitted` path that wait. Each one put here is the weaker of two, so few wait at a
// time; when all places are taken the choice is left to chance. Kept by the worker, as setting it
// up for every sample would cost more than many samples do.
struct Branch {
  Ray ray;
  Rgb throughput{1, 1, 1};
  double length = 0;  // from the camera
  std::uint32_t depth = 0;
  RayKind kind = RayKind::camera;
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

// For the extra layers.
template <class Surface>
[[nodiscard]] FirstHit first_hit_of(const Hit& hit, const Surface& surface,
                                    const UnitVector3& normal, ir::MaterialId material) {
  FirstHit first;
  first.hit = true;
  first.uncertified = hit.uncertified;
  first.albedo = albedo_of(surface);
  first.normal = normal.vector();
  first.position = hit.point;
  first.depth = hit.t;
  first.u = hit.u;
  first.v = hit.v;
  first.item = hit.item;
  first.material = material.valid() ? material.value() : 0;
  return first;
}

}  // namespace scenec::backend
