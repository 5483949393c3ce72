#include "backend/lights/casters.hpp"

#include <algorithm>
#include <cmath>

#include "backend/materials/fresnel.hpp"
#include "backend/math/frame.hpp"
#include "base/elementary.hpp"

namespace scenec::backend {
namespace {

// Farther away than this, in radii, a sphere throws nothing that counts.
constexpr double farthest = 0x1p100;

double strength(const Emitter& e) {
  if (e.textured || !(e.area > 0)) return 0;
  const double power = e.area * (e.radiance.r + e.radiance.g + e.radiance.b);
  return power > 0 && std::isfinite(power) ? power : 0;
}

// A point of the sphere at an angle from the axis, towards `side`.
struct OnSphere {
  Vector3 normal;
  Point3 point;
};
OnSphere on_sphere(const Caster& c, const Vector3& axis, const Vector3& side, double cosine,
                   double sine) {
  const UnitVector3 n = normalized(axis * cosine + side * sine);
  return {n.vector(), c.center + n.vector() * c.radius};
}

}  // namespace

void CasterTable::finish(std::vector<std::pair<std::uint32_t, Caster>> casters, std::size_t items,
                         const std::vector<Emitter>& emitters) {
  casters_.clear();
  double sum = 0;
  for (const Emitter& e : emitters) sum += strength(e);
  if (!(sum > 0) || !std::isfinite(sum)) return;
  if (casters.size() > most) {
    // The largest ones; of equal ones the first.
    std::stable_sort(casters.begin(), casters.end(), [](const auto& a, const auto& b) {
      return a.second.radius > b.second.radius;
    });
    casters.resize(most);
  }
  if (casters.empty()) return;
  of_item_.assign(items, none);
  for (auto& [item, caster] : casters) {
    of_item_[item] = static_cast<std::uint32_t>(casters_.size());
    casters_.push_back(std::move(caster));
  }
  double so_far = 0;
  for (const Emitter& e : emitters) {
    power_.push_back(strength(e) / sum);
    so_far += power_.back();
    cumulative_.push_back(so_far);
  }
}

CasterTable::Lamp CasterTable::choose_lamp(double u) const {
  const auto found =
      std::upper_bound(cumulative_.begin(), cumulative_.end(), u * cumulative_.back());
  if (found == cumulative_.end()) return {};
  const auto index = static_cast<std::uint32_t>(found - cumulative_.begin());
  return {index, power_[index]};
}

CasterShare share_of(const Caster& caster, CasterWay way, double impact, const Rgb& absorption) {
  const double cosine = std::sqrt(larger(0, 1 - impact * impact));
  if (!caster.clear()) return {smooth_reflectance(caster.bsdf, cosine), 1};
  const DielectricFresnel f = fresnel_dielectric(cosine, caster.ior);
  if (way == CasterWay::mirrored) return {Rgb::gray(f.reflectance), f.reflectance};
  const double passed = (1 - f.reflectance) * (1 - f.reflectance);
  Rgb carried = caster.bsdf.specular * caster.bsdf.specular * passed;
  if (!is_black(absorption)) {
    const double chord = 2 * f.cos_t * caster.radius;
    carried *=
        Rgb{exp(-absorption.r * chord), exp(-absorption.g * chord), exp(-absorption.b * chord)};
  }
  return {carried, passed};
}

std::optional<CasterPlace> place_of(const Caster& caster, const Point3& point) {
  const Vector3 way = point - caster.center;
  const double far = length(way);
  const double distance = far / caster.radius;
  if (!(distance > 1) || !(distance < farthest)) return std::nullopt;
  return CasterPlace{way / far, distance};
}

double spread_of(const Caster& caster, CasterWay way, double from, double to, double impact) {
  const double spread = way == CasterWay::mirrored ? mirrored_spread(from, to, impact)
                                                   : spread_through(from, to, impact, caster.ior);
  return spread * (caster.radius * caster.radius);
}

CasterRoutes routes_by(const Caster& caster, CasterWay way, const Point3& from,
                       const CasterPlace& start, const Point3& to, const CasterPlace& end) {
  CasterRoutes out;
  const Vector3 normal = cross(start.axis, end.axis);
  const double sine = length(normal);
  const SphereEnds ends{start.distance, end.distance, dot(start.axis, end.axis), sine};
  // Towards the other end; in line with it any direction serves.
  const Vector3 side = sine > 0 ? cross(normal / sine, start.axis)
                                : frame_about(UnitVector3::assume_unit(start.axis)).x.vector();
  Impacts impacts;
  if (way == CasterWay::through) {
    impacts = impacts_through(ends, caster.ior);
  } else if (const auto one = mirrored_impact(ends)) {
    impacts.values[0] = *one;
    impacts.count = 1;
  }
  for (int i = 0; i < impacts.count; ++i) {
    const double b = impacts.values[static_cast<std::size_t>(i)];
    const double b2 = b * b;
    const double cosine = std::sqrt(larger(0, 1 - b2));
    // The angle from the axis to the entry: of incidence less that at the start.
    const double from_cos = std::sqrt(start.distance * start.distance - b2);
    const double entry_cos = (cosine * from_cos + b2) / start.distance;
    const double entry_sin =
        b * (start.distance * start.distance - 1) / ((from_cos + cosine) * start.distance);
    const OnSphere entry = on_sphere(caster, start.axis, side, entry_cos, entry_sin);
    OnSphere exit = entry;
    if (way == CasterWay::through) {
      // Half a turn less twice the angle within.
      const double n2 = caster.ior * caster.ior;
      const double in_cos = 1 - 2 * b2 / n2;
      const double in_sin = -2 * b * std::sqrt(n2 - b2) / n2;
      exit = on_sphere(caster, start.axis, side, -(entry_cos * in_cos - entry_sin * in_sin),
                       -(entry_sin * in_cos + entry_cos * in_sin));
    }
    CasterRoute& route = out.routes[static_cast<std::size_t>(out.count++)];
    route.impact = b;
    route.wi = normalized(entry.point - from);
    route.arrive = normalized(to - exit.point);
    route.entry = entry.point;
    route.exit = exit.point;
    route.entry_normal = UnitVector3::assume_unit(entry.normal);
    route.exit_normal = UnitVector3::assume_unit(exit.normal);
  }
  return out;
}

}  // namespace scenec::backend
