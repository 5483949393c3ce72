#include "backend/lights/light_table.hpp"

#include <algorithm>
#include <cmath>

#include "base/elementary.hpp"

namespace scenec::backend {
namespace {

Rgb rgb_of(const ir::Color& c) {
  return {c.r, c.g, c.b};
}
Point3 point_of(const ir::Point3& p) {
  return {p.x, p.y, p.z};
}
UnitVector3 unit_of(const ir::Direction& d) {
  return normalized(Vector3{d.x, d.y, d.z});
}

template <class L>
Rgb intensity_of(const L& light) {
  return rgb_of(light.color) * (light.intensity ? *light.intensity
                                : light.power   ? light.power->value / (4 * pi)
                                                : 0);
}

}  // namespace

std::optional<DeltaLight> delta_light_of(const ir::LightKind& kind) {
  DeltaLight out;
  if (const auto* point = std::get_if<ir::PointLight>(&kind)) {
    out.position = point_of(point->position);
    out.inverse_square = point->decay == ir::Decay::inverse_square;
    out.value = intensity_of(*point);
    return out;
  }
  if (const auto* spot = std::get_if<ir::SpotLight>(&kind)) {
    out.kind = DeltaLight::Kind::spot;
    out.position = point_of(spot->position);
    out.direction = unit_of(spot->direction);
    out.inverse_square = spot->decay == ir::Decay::inverse_square;
    const double half = std::fmin(spot->angle.value / 2, pi);
    out.cos_edge = cos(half);
    out.cos_full = cos(std::fmax(0, half - spot->falloff.value));
    out.value = intensity_of(*spot);
    return out;
  }
  if (const auto* far = std::get_if<ir::DirectionalLight>(&kind)) {
    out.kind = DeltaLight::Kind::directional;
    out.direction = unit_of(far->direction);
    out.value = rgb_of(far->color) * far->irradiance;
    return out;
  }
  return std::nullopt;
}

double spot_share(const DeltaLight& light, const Vector3& travel) {
  const double c = dot(travel, light.direction);
  if (c < light.cos_edge) return 0;
  if (c >= light.cos_full) return 1;
  const double t = (c - light.cos_edge) / (light.cos_full - light.cos_edge);
  return t * t * (3 - 2 * t);
}

void LightTable::finish(double scene_radius) {
  const double disk = pi * scene_radius * scene_radius;
  power_.clear();
  for (const DeltaLight& l : deltas) {
    double factor = 4 * pi;
    if (l.kind == DeltaLight::Kind::directional) factor = disk;
    if (l.kind == DeltaLight::Kind::spot) factor = 2 * pi * (1 - (l.cos_edge + l.cos_full) / 2);
    // Without decay the light does not get weaker on its way: as much arrives as from far away.
    if (l.kind != DeltaLight::Kind::directional && !l.inverse_square) factor = disk;
    power_.push_back(luminance(l.value) * factor);
  }
  for (const Emitter& e : emitters) {
    power_.push_back(e.area > 0 ? luminance(e.radiance) * e.area * pi * (e.two_sided ? 2 : 1) : 0);
  }
  // Even light from everywhere is found best by the surface's own directions: aiming at it adds
  // noise.
  for (const Environment& e : environments)
    power_.push_back(e.is_constant() ? 0 : luminance(e.mean()) * pi * disk);
  any_invisible_ =
      std::any_of(emitters.begin(), emitters.end(), [](const Emitter& e) { return !e.visible; });
  double sum = 0;
  for (double& p : power_) {
    if (!(p > 0) || !std::isfinite(p)) p = 0;
    sum += p;
  }
  cumulative_.clear();
  double running = 0;
  for (double& p : power_) {
    p = sum > 0 ? p / sum : 0;
    running += p;
    cumulative_.push_back(running);
  }
}

double LightTable::probability(std::size_t light, const LitPlace&) const {
  return power_[light];
}

LightTable::Choice LightTable::choose(double u, const LitPlace&) const {
  if (cumulative_.empty() || !(cumulative_.back() > 0)) return {};
  const double scaled = u * cumulative_.back();
  const auto above = std::upper_bound(cumulative_.begin(), cumulative_.end(), scaled);
  auto light = static_cast<std::size_t>(above - cumulative_.begin());
  // Rounding of u * sum can reach the sum itself.
  while (light >= power_.size() || power_[light] == 0) --light;
  return {light, power_[light]};
}

bool LightTable::sample_delta(const DeltaLight& light, const Point3& from, LightSample& s) {
  s.delta = true;
  if (light.kind == DeltaLight::Kind::directional) {
    s.wi = -light.direction.vector();
    s.radiance = light.value;
    s.infinite = true;
    return true;
  }
  const Vector3 way = light.position - from;
  const double distance2 = length_squared(way);
  if (!(distance2 > 0)) return false;
  s.wi = normalized(way).vector();
  s.radiance = light.inverse_square ? light.value / distance2 : light.value;
  if (light.kind == DeltaLight::Kind::spot) s.radiance *= spot_share(light, -s.wi);
  s.target = light.position;
  return true;
}

bool LightTable::sample(std::size_t light, const Point3& from, Sample2 u, LightSample& s) const {
  if (light < deltas.size()) return sample_delta(deltas[light], from, s);
  light -= deltas.size();
  if (light < emitters.size()) {
    const Emitter& e = emitters[light];
    EmitterSample chosen;
    if (!sample_emitter(e, from, u, chosen)) return false;
    if (!e.two_sided && !(dot(chosen.wi, chosen.normal) < 0)) return false;
    s.wi = chosen.wi.vector();
    s.radiance = e.radiance;
    s.pdf = chosen.pdf;
    s.target = chosen.point;
    s.target_error = chosen.error;
    s.target_normal = chosen.normal;
    s.emitter = &e;
    return true;
  }
  const Environment& environment = environments[light - emitters.size()];
  const Environment::Choice chosen = environment.sample(u);
  if (!(chosen.pdf > 0)) return false;
  s.wi = chosen.wi.vector();
  s.radiance = environment.radiance(s.wi);
  s.pdf = chosen.pdf;
  s.infinite = true;
  return true;
}

Rgb LightTable::environment_radiance(const Vector3& direction) const {
  Rgb sum;
  for (const Environment& environment : environments) sum += environment.radiance(direction);
  return sum;
}

}  // namespace scenec::backend
