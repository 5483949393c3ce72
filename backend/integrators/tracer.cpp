#include "backend/integrators/tracer.hpp"

#include <bit>

namespace scenec::backend {

bool Tracer::keeps(const Hit& hit, RayKind kind, std::uint32_t depth,
                   const Sampler& sampler) const {
  const RenderItem& item = scene_.items[hit.item];
  if (item.light != RenderItem::none)
    return kind == RayKind::scattered || scene_.lights.emitters[item.light].visible;
  if (!with(ir::Effect::alpha)) return true;
  const double opacity = opacity_of(scene_, scene_.material_of(hit), texture_place(hit, effects_));
  if (opacity >= 1) return true;
  if (!(opacity > 0)) return false;
  // Each surface a ray passes takes a number of its own: told apart by what and where it is.
  const std::uint64_t key = path_key(hit.instances.data(), hit.instance_count, hit.item);
  const std::uint64_t what = key ^ (static_cast<std::uint64_t>(hit.primitive) << 32) ^
                             std::bit_cast<std::uint64_t>(hit.t) ^
                             (kind == RayKind::shadow ? 0x9e3779b97f4a7c15ULL : 0);
  return sampler.random(dimension::bounce(depth) + dimension::opacity, what) < opacity;
}

bool Tracer::intersect(const Ray& ray, RayKind kind, std::uint32_t depth, const Sampler& sampler,
                       Hit& hit) const {
  ++counters_.rays;
  const auto keep = [&](const Hit& candidate) { return keeps(candidate, kind, depth, sampler); };
  return scene_.accel.intersect(ray, hit, HitFilter(keep));
}

bool Tracer::occluded(const Ray& ray, std::uint32_t depth, const Sampler& sampler) const {
  if (!with(ir::Effect::shadows)) return false;
  ++counters_.rays;
  const auto keep = [&](const Hit& candidate) {
    return keeps(candidate, RayKind::shadow, depth, sampler);
  };
  return scene_.accel.occluded(ray, HitFilter(keep));
}

Rgb Tracer::emitted(const Hit& hit, const Vector3& to_viewer) const {
  const bool outside = dot(hit.geometric_normal, to_viewer) > 0;
  const RenderItem& item = scene_.items[hit.item];
  if (item.light != RenderItem::none) {
    const Emitter& e = scene_.lights.emitters[item.light];
    return outside || e.two_sided ? e.radiance : Rgb{};
  }
  return emission_of(scene_, scene_.material_of(hit), texture_place(hit, effects_), outside);
}

Rgb Tracer::escaped(const Vector3& direction, bool camera) const {
  const ir::Color& c = settings_.background;
  if (scene_.lights.environments.empty()) return {c.r, c.g, c.b};
  if (camera && settings_.background_written) return {c.r, c.g, c.b};
  return scene_.lights.environment_radiance(direction);
}

Rgb Tracer::visible_radiance(const Hit& hit, const LightSample& light, std::uint32_t depth,
                             const Sampler& sampler) const {
  if (light.infinite)
    return occluded(spawn_ray(hit, light.wi), depth, sampler) ? Rgb{} : light.radiance;
  const Ray segment = light.target_normal ? spawn_segment(hit, light.target, light.target_error,
                                                          *light.target_normal)
                                          : spawn_segment(hit, light.target);
  if (occluded(segment, depth, sampler)) return {};
  if (light.emitter == nullptr || !light.emitter->textured) return light.radiance;
  // The radiance there varies: look at the light's surface itself, past what hides nothing.
  Ray ray = spawn_ray(hit, light.wi);
  Hit seen;
  ++counters_.rays;
  const auto on_emitter = [&](const Hit& candidate) {
    const std::uint32_t emitter = scene_.emitter_of(candidate);
    return emitter != RenderItem::none && &scene_.lights.emitters[emitter] == light.emitter;
  };
  if (!scene_.accel.intersect(ray, seen, HitFilter(on_emitter))) return {};
  if (!on_emitter(seen)) return {};
  const ir::MaterialId material = scene_.material_of(seen);
  // Where the light itself is see-through, its surface is there with that probability only; the
  // shadow ray has not been asked, as it ends before the surface.
  const double opacity =
      with(ir::Effect::alpha) ? opacity_of(scene_, material, texture_place(seen, effects_)) : 1;
  return emitted(seen, -light.wi) * opacity;
}

FirstHit first_hit_of(const Tracer& tracer, const Hit& hit, const Bsdf& bsdf) {
  FirstHit first;
  first.hit = true;
  first.albedo = albedo_of(bsdf);
  first.normal = bsdf.frame.z.vector();
  first.position = hit.point;
  first.depth = hit.t;
  first.u = hit.u;
  first.v = hit.v;
  first.item = hit.item;
  const ir::MaterialId material = tracer.scene().material_of(hit);
  first.material = material.valid() ? material.value() : 0;
  return first;
}

}  // namespace scenec::backend
