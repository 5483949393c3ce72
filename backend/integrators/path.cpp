// `.path`: one path a sample, light found both by aiming at lights and by chance, the two weighted
// by the power heuristic (Veach and Guibas 1995). Paths end by chance, by nothing else unless
// max_depth is written: no clamps, no cut-offs.
#include <algorithm>
#include <cmath>

#include "backend/integrators/tracer.hpp"
#include "base/elementary.hpp"

namespace scenec::backend {
namespace {

double power_heuristic(double a, double b) {
  if (std::isinf(a)) return 1;
  const double a2 = a * a;
  return a2 / (a2 + b * b);
}

// Paths of fewer bounces never end by chance.
constexpr std::uint32_t sure_bounces = 3;
// Even a path that loses nothing ends at last.
constexpr double longest_survival = 0.95;

struct PathState {
  Ray ray;
  Rgb throughput{1, 1, 1};
  Rgb radiance;
  double eta_scale = 1;    // radiance scalings undone, for judging what the path can still bring
  double scatter_pdf = 0;  // of the last direction
  bool specular = true;    // the last direction could not have been found by aiming
  bool scattered = false;  // some direction before could have been
  Point3 scatter_point;    // where it started
  std::uint32_t depth = 0;
  MediumStack media;
};

// The density of aiming at a light, from the one with its choice among all.
double aimed_pdf(const Tracer& tracer, std::size_t light, double pdf) {
  if (tracer.with(ir::Effect::many_lights) || !(pdf > 0)) return pdf;
  return pdf / tracer.scene().lights.probability(light);
}

void add_escaped(const Tracer& tracer, PathState& path) {
  const LightTable& lights = tracer.scene().lights;
  const Vector3& d = path.ray.direction;
  if (path.scattered && !tracer.with(ir::Effect::environment)) return;
  if (path.depth == 0 || lights.environments.empty()) {
    path.radiance += path.throughput * tracer.escaped(d, path.depth == 0);
    return;
  }
  for (std::size_t i = 0; i < lights.environments.size(); ++i) {
    const double weight =
        path.specular
            ? 1
            : power_heuristic(path.scatter_pdf, aimed_pdf(tracer, lights.first_environment() + i,
                                                          lights.pdf_of_environment(i, d)));
    path.radiance += path.throughput * lights.environments[i].radiance(d) * weight;
  }
}

void add_emission(const Tracer& tracer, PathState& path, const Hit& hit) {
  if (path.scattered && !tracer.with(ir::Effect::area_lights)) return;
  const Rgb emitted = tracer.emitted(hit, -path.ray.direction);
  if (is_black(emitted)) return;
  double weight = 1;
  if (!path.specular) {
    const std::uint32_t emitter = tracer.scene().emitter_of(hit);
    if (emitter != RenderItem::none) {
      const double pdf = tracer.scene().lights.pdf_of_emitter(emitter, path.scatter_point,
                                                              hit.point, hit.geometric_normal);
      weight =
          power_heuristic(path.scatter_pdf,
                          aimed_pdf(tracer, tracer.scene().lights.first_emitter() + emitter, pdf));
    }
  }
  path.radiance += path.throughput * emitted * weight;
}

// Without a choice among lights every one is asked.
void add_direct_of_all(const Tracer& tracer, PathState& path, const Hit& hit, const Bsdf& bsdf,
                       const Sampler& sampler) {
  const LightTable& lights = tracer.scene().lights;
  const auto weight = [](const LightSample& light, double bsdf_pdf) {
    return light.delta ? 1.0 : power_heuristic(light.pdf, bsdf_pdf);
  };
  for (std::size_t light = 0; light < lights.size(); ++light) {
    if (!(lights.probability(light) > 0)) continue;
    path.radiance += path.throughput * tracer.direct(hit, bsdf, light, path.depth, sampler, weight);
  }
}

void add_direct(const Tracer& tracer, PathState& path, const Hit& hit, const Bsdf& bsdf,
                const Sampler& sampler) {
  if (!tracer.with(ir::Effect::many_lights))
    return add_direct_of_all(tracer, path, hit, bsdf, sampler);
  const double u = sampler.get_1d(dimension::bounce(path.depth) + dimension::light_choice);
  const LightTable::Choice choice = tracer.scene().lights.choose(u);
  if (!(choice.probability > 0)) return;
  const auto weight = [&](const LightSample& light, double bsdf_pdf) {
    return light.delta ? 1.0 : power_heuristic(choice.probability * light.pdf, bsdf_pdf);
  };
  path.radiance += path.throughput *
                   tracer.direct(hit, bsdf, choice.light, path.depth, sampler, weight) *
                   (1 / choice.probability);
}

void absorb(const Tracer& tracer, PathState& path, double distance) {
  if (path.media.empty() || !tracer.with(ir::Effect::absorption)) return;
  const Rgb sigma = absorption_of(tracer.scene(), path.media.innermost());
  if (is_black(sigma)) return;
  path.throughput *=
      Rgb(exp(-sigma.r * distance), exp(-sigma.g * distance), exp(-sigma.b * distance));
}

// False: the path ends.
bool survives(PathState& path, const Sampler& sampler) {
  if (is_black(path.throughput)) return false;
  if (path.depth <= sure_bounces) return true;
  const double p = smaller(longest_survival, max_component(path.throughput) * path.eta_scale);
  if (!(sampler.get_1d(dimension::bounce(path.depth - 1) + dimension::roulette) < p)) return false;
  path.throughput *= 1 / p;
  return true;
}

// Whether the picture is simulated with what the sampled direction shows.
bool follows(const Tracer& tracer, const PathState& path, const BsdfSample& s) {
  if (s.transmitted && !tracer.with(ir::Effect::refraction)) return false;
  if (!s.specular) return true;
  if (!s.transmitted && !tracer.with(ir::Effect::reflection)) return false;
  return !path.scattered || tracer.with(ir::Effect::caustics);
}

bool scatter(const Tracer& tracer, PathState& path, const Hit& hit, const Bsdf& bsdf,
             ir::MaterialId material, const Sampler& sampler) {
  const std::uint32_t base = dimension::bounce(path.depth);
  const BsdfSample s = sample_bsdf(bsdf, sampler.get_1d(base + dimension::lobe),
                                   sampler.get_2d(base + dimension::direction));
  if (is_black(s.weight) || !follows(tracer, path, s)) return false;
  // Light that a matt surface hands to another one: only mirrors and glass may stand between.
  if (path.scattered && !s.specular && !tracer.with(ir::Effect::interreflection)) return false;
  path.throughput *= s.weight;
  path.eta_scale *= s.eta_scale;
  path.scatter_pdf = s.pdf;
  path.specular = s.specular;
  path.scattered = path.scattered || !s.specular;
  path.scatter_point = hit.point;
  path.ray = spawn_ray(hit, s.wi);
  if (s.transmitted) {
    if (bsdf.entering)
      path.media.enter(material, tracer.with(ir::Effect::nested_media));
    else
      path.media.leave(material);
  }
  ++path.depth;
  return true;
}

}  // namespace

TracedSample trace_path(const Tracer& tracer, const Ray& ray, const Sampler& sampler) {
  const RenderScene& scene = tracer.scene();
  const auto max_depth =
      static_cast<std::uint64_t>(tracer.settings().max_depth.value_or(std::int64_t{1} << 32));
  TracedSample out;
  PathState path;
  path.ray = ray;
  for (;;) {
    Hit hit;
    const RayKind kind = path.depth == 0 ? RayKind::camera : RayKind::scattered;
    if (!tracer.intersect(path.ray, kind, path.depth, sampler, hit)) {
      add_escaped(tracer, path);
      break;
    }
    absorb(tracer, path, hit.t);
    add_emission(tracer, path, hit);
    if (path.depth == 0) out.covered = true;
    const std::uint32_t light = scene.items[hit.item].light;
    if (light != RenderItem::none) {
      // Shapes of lights scatter nothing; one that is not visible does not even stop the path.
      if (scene.lights.emitters[light].visible) break;
      path.ray = spawn_ray(hit, path.ray.direction);
      continue;
    }
    if (path.depth >= max_depth) break;
    const ir::MaterialId material = scene.material_of(hit);
    const double mix = sampler.get_1d(dimension::bounce(path.depth) + dimension::material_mix);
    const Bsdf bsdf =
        resolve_bsdf(scene, material, hit, -path.ray.direction, mix, tracer.effects());
    if (path.depth == 0) out.first = first_hit_of(tracer, hit, bsdf);
    const bool lit = !path.scattered || tracer.with(ir::Effect::interreflection);
    if (lit && has_smooth_part(bsdf)) add_direct(tracer, path, hit, bsdf, sampler);
    if (!scatter(tracer, path, hit, bsdf, material, sampler) || !survives(path, sampler)) break;
  }
  out.radiance = path.radiance;
  return out;
}

}  // namespace scenec::backend
