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

std::uint64_t LightTable::memory() const {
  std::uint64_t bytes = deltas.capacity() * sizeof(DeltaLight) +
                        emitters.capacity() * sizeof(Emitter) +
                        environments.capacity() * sizeof(Environment) +
                        (power_.capacity() + cumulative_.capacity()) * sizeof(double) +
                        leaf_.capacity() * sizeof(std::uint32_t) + tree_.memory();
  for (const Environment& environment : environments) bytes += environment.memory();
  return bytes;
}

void LightTable::finish(double scene_radius, LightSelection selection) {
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
  for (double& p : power_) p = sum > 0 ? p / sum : 0;
  leaf_.assign(power_.size(), no_leaf);
  tree_ = {};
  if (selection == LightSelection::tree) build_tree();
  cumulative_.clear();
  double running = 0;
  for (std::size_t i = 0; i < power_.size(); ++i) {
    running += leaf_[i] == no_leaf ? power_[i] : 0;
    cumulative_.push_back(running);
  }
  tree_share_ = tree_.empty() ? 0 : running > 0 ? 0.5 : 1;
}

void LightTable::build_tree() {
  std::vector<LightTree::Leaf> leaves;
  const auto add = [&](std::size_t light, const LightCluster& cluster) {
    if (!can_be_drawn(light) || !cluster.box.finite()) return;
    leaf_[light] = static_cast<std::uint32_t>(leaves.size());
    leaves.push_back({cluster, static_cast<std::uint32_t>(light)});
  };
  for (std::size_t i = 0; i < deltas.size(); ++i) {
    const DeltaLight& l = deltas[i];
    if (l.kind == DeltaLight::Kind::directional || !l.inverse_square) continue;
    LightCluster c;
    c.box.grow(l.position);
    c.power = 4 * pi * luminance(l.value);
    if (l.kind == DeltaLight::Kind::spot) {
      c.axis = l.direction.vector();
      c.cos_spread = l.cos_full;
      // Beyond the full cone, up to the edge: the cosine of the difference.
      c.cos_fall = cos(acos(l.cos_edge) - acos(l.cos_full));
    }
    add(i, c);
  }
  for (std::size_t i = 0; i < emitters.size(); ++i)
    add(first_emitter() + i, cluster_of(emitters[i]));
  tree_ = LightTree(std::move(leaves));
}

double LightTable::probability(std::size_t light, const LitPlace& place) const {
  if (leaf_[light] != no_leaf) return tree_share_ * tree_.probability(leaf_[light], place);
  return cumulative_.back() > 0 ? (1 - tree_share_) * power_[light] / cumulative_.back() : 0;
}

LightTable::Choice LightTable::choose(double u, const LitPlace& place) const {
  if (power_.empty()) return {};
  if (u < tree_share_) {
    const LightTree::Choice c = tree_.choose(smaller(u / tree_share_, 1 - 0x1p-53), place);
    return {c.light, tree_share_ * c.probability};
  }
  Choice c = choose_by_power((u - tree_share_) / (1 - tree_share_));
  c.probability *= 1 - tree_share_;
  return c;
}

LightTable::Choice LightTable::choose_by_power(double u) const {
  if (!(cumulative_.back() > 0)) return {};
  const double scaled = u * cumulative_.back();
  const auto above = std::upper_bound(cumulative_.begin(), cumulative_.end(), scaled);
  auto light = static_cast<std::size_t>(above - cumulative_.begin());
  // Rounding of u * sum can reach the sum itself.
  while (light >= power_.size() || power_[light] == 0 || leaf_[light] != no_leaf) --light;
  return {light, power_[light] / cumulative_.back()};
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
