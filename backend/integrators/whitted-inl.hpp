// `.whitted`: light that comes straight from lights, seen directly or by way of mirrors and glass;
// no light between matt or glossy surfaces. Mirrors and glass are followed in all their directions
// while they matter; fainter branches are chosen by chance, so nothing is cut off.
#pragma once

#include <array>
#include <cmath>
#include <utility>

#include "backend/integrators/surface.hpp"

namespace scenec::backend {

template <EffectMask compiled>
class WhittedTracer {
 public:
  WhittedTracer(const Tracer<compiled>& tracer, const Sampler& sampler, BranchStack& waiting)
      : tracer_(tracer),
        scene_(tracer.scene()),
        sampler_(sampler),
        waiting_(waiting),
        max_depth_(static_cast<std::uint64_t>(
            tracer.settings().max_depth.value_or(std::int64_t{1} << 32))) {}

  TracedSample trace(const Ray& ray) {
    waiting_.count = 0;
    Branch branch;
    branch.ray = ray;
    for (;;) {
      while (step(branch)) {
      }
      if (waiting_.count == 0) return out_;
      branch = waiting_.branches[--waiting_.count];
    }
  }

 private:
  // Branches are all followed while the path keeps this share of its light; below, one is chosen.
  static constexpr double sure_share = 1.0 / 64;
  // Up to this many lights every one is asked at every surface; of more, one is chosen.
  static constexpr std::size_t all_lights = 16;
  // Mirrors that lose nothing would be followed for ever.
  static constexpr std::uint32_t longest_sure = 32;
  static constexpr double longest_survival = 0.95;

  template <ir::Effect effect>
  [[nodiscard]] bool with() const {
    return tracer_.template with<effect>();
  }

  // Follows one ray; false when the branch ends.
  bool step(Branch& branch) {
    Hit hit;
    if (!tracer_.intersect(branch.ray, branch.kind, branch.depth, sampler_, hit)) {
      out_.radiance += branch.throughput * tracer_.escaped(branch.ray.direction, branch.depth == 0);
      return false;
    }
    branch.length += hit.t;
    tracer_.widen(hit, branch.ray.direction, branch.length);
    if (branch.depth == 0) out_.covered = true;
    if (!branch.media.empty()) branch.throughput *= transmittance(tracer_, branch.media, hit.t);
    const Vector3 to_viewer = -branch.ray.direction;
    const RenderItem& item = scene_.items[hit.item];
    const ir::MaterialId material =
        item.light != RenderItem::none ? ir::MaterialId{} : scene_.material_of(hit);
    out_.radiance += branch.throughput * tracer_.emitted(hit, item, material, to_viewer);
    if (item.light != RenderItem::none) {
      if (scene_.lights.emitters[item.light].visible) return false;
      branch.ray = spawn_ray(hit, branch.ray.direction);
      return true;
    }
    if (branch.depth >= max_depth_) return false;
    const PreparedMaterial& prepared = scene_.materials[material.value()];
    if (prepared.use == PreparedMaterial::Use::matt) {
      const MattSurface surface =
          tracer_.timed(RenderStage::materials, [&] { return matt_at(prepared, hit, to_viewer); });
      meet(branch, hit, surface, surface.shading, material);
      return false;
    }
    const Bsdf bsdf =
        bsdf_at(tracer_, branch.media, material, hit, to_viewer, sampler_, branch.depth);
    meet(branch, hit, bsdf, bsdf.frame.z, material);
    return follow(branch, hit, bsdf, material);
  }

  template <class Surface>
  void meet(const Branch& branch, const Hit& hit, const Surface& surface, const UnitVector3& normal,
            ir::MaterialId material) {
    if (branch.depth == 0 && !out_.first.hit && tracer_.job().wants_first_hit)
      out_.first = first_hit_of(hit, surface, normal, material);
    if (has_smooth_part(surface))
      out_.radiance += branch.throughput * direct(branch, hit, surface, normal);
  }

  template <class Surface>
  [[nodiscard]] Rgb direct(const Branch& branch, const Hit& hit, const Surface& surface,
                           const UnitVector3& normal) const {
    const auto whole = [](const LightSample&, double) { return 1.0; };
    const LightTable& lights = scene_.lights;
    const bool many = lights.size() > all_lights && with<ir::Effect::many_lights>();
    Rgb sum;
    if (many) {
      tracer_.count(ir::Effect::many_lights);
      const double u = sampler_.get_1d(dimension::bounce(branch.depth) + dimension::light_choice);
      const LightTable::Choice choice = tracer_.timed(
          RenderStage::lights, [&] { return lights.choose(u, {hit.point, normal.vector()}); });
      if (choice.probability > 0) {
        sum = tracer_.direct(hit, surface, choice.light, branch.depth, sampler_, whole) *
              (1 / choice.probability);
      }
    }
    for (std::size_t light = many ? lights.first_environment() : 0; light < lights.size();
         ++light) {
      // Constant environments cannot be drawn: they are asked in any case.
      if (many && !lights.is_constant_environment(light)) continue;
      sum += tracer_.direct(hit, surface, light, branch.depth, sampler_, whole);
    }
    return sum;
  }

  // Those that the picture is simulated with.
  [[nodiscard]] SpecularRays followed(const SpecularRays& all) const {
    SpecularRays kept;
    for (int i = 0; i < all.count; ++i) {
      const SpecularRay& ray = all.rays[static_cast<std::size_t>(i)];
      if (ray.transmitted ? with<ir::Effect::refraction>() : with<ir::Effect::reflection>())
        kept.rays[static_cast<std::size_t>(kept.count++)] = ray;
    }
    return kept;
  }

  // The next ray of the branch; the weaker of two waits.
  bool follow(Branch& branch, const Hit& hit, const Bsdf& bsdf, ir::MaterialId material) {
    SpecularRays rays =
        followed(tracer_.timed(RenderStage::materials, [&] { return specular_rays(bsdf); }));
    if (rays.count == 0) return false;
    if (rays.count == 2 &&
        max_component(rays.rays[0].weight) < max_component(rays.rays[1].weight)) {
      std::swap(rays.rays[0], rays.rays[1]);
    }
    const Rgb before = branch.throughput;
    const std::uint32_t base = dimension::bounce(branch.depth);
    if (rays.count == 2) {
      const double weak = max_component(before * rays.rays[1].weight);
      if (weak >= sure_share && waiting_.count < waiting_.branches.size()) {
        Branch& other = waiting_.branches[waiting_.count++];
        other = branch;
        advance(other, rays.rays[1], hit, bsdf, material);
      } else {
        const double a = max_component(rays.rays[0].weight);
        const double b = max_component(rays.rays[1].weight);
        const double first = a / (a + b);
        const bool takes_first = sampler_.get_1d(base + dimension::lobe) < first;
        branch.throughput *= takes_first ? 1 / first : 1 / (1 - first);
        if (!takes_first) std::swap(rays.rays[0], rays.rays[1]);
      }
    }
    advance(branch, rays.rays[0], hit, bsdf, material);
    const double share = max_component(branch.throughput);
    if (!(share > 0)) return false;
    if (share >= sure_share && branch.depth < longest_sure) return true;
    const double p = smaller(longest_survival, share / sure_share);
    if (!(sampler_.get_1d(base + dimension::roulette) < p)) return false;
    branch.throughput *= 1 / p;
    return true;
  }

  void advance(Branch& branch, const SpecularRay& next, const Hit& hit, const Bsdf& bsdf,
               ir::MaterialId material) const {
    branch.throughput *= next.weight;
    branch.ray = spawn_ray(hit, next.wi);
    branch.kind = next.transmitted ? RayKind::refracted : RayKind::reflected;
    if (next.transmitted)
      cross(tracer_, branch.media, material, bsdf.entering);
    else
      tracer_.count(ir::Effect::reflection);
    ++branch.depth;
  }

  const Tracer<compiled>& tracer_;
  const RenderScene& scene_;
  const Sampler& sampler_;
  BranchStack& waiting_;
  std::uint64_t max_depth_;
  TracedSample out_;
};

}  // namespace scenec::backend
