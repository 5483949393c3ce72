// Light of lamps by way of smooth spheres, aimed at: `.path` asks the casters of a scene at every
// place where it asks the lamps. The two ways a path can meet such light, aiming and chance, are
// weighed by their densities, so that it counts once.
#pragma once

#include "backend/integrators/surface.hpp"
#include "backend/lights/casters.hpp"

namespace scenec::backend {

// Where a path is between a place that could aim by way of a caster and the lamp.
struct CasterChain {
  enum class State : std::uint8_t {
    none,      // nothing could have aimed here
    left,      // a place that asks the casters has been left
    inside,    // in a clear caster, straight from there
    mirrored,  // off a caster, straight from there
    through,   // through a caster, straight from there
  };
  State state = State::none;
  std::uint32_t caster = 0;
  Point3 from;        // the place
  double pdf = 0;     // with which its surface chose the direction
  double worth = 0;   // of the path there
  double impact = 0;  // on the caster
};

template <EffectMask compiled>
class CasterLight {
 public:
  CasterLight(const Tracer<compiled>& tracer, const Sampler& sampler)
      : tracer_(tracer), scene_(tracer.scene()), sampler_(sampler) {}

  [[nodiscard]] bool asked_for() const {
    if constexpr ((compiled & bit_of(ir::Effect::caustics)) == 0) return false;
    return tracer_.template with<ir::Effect::caustics>() &&
           tracer_.template with<ir::Effect::area_lights>() && !scene_.casters.empty() &&
           scene_.lights.finding != LightFinding::chance;
  }

  // Radiance that a surface outside all bodies scatters to the viewer. `weight`(density of aiming,
  // density by chance) divides each way's share. `left`: bounces the path may still make; `worth`:
  // the part of the light found here that the viewer gets.
  template <class Surface, class Weight>
  [[nodiscard]] Rgb aimed(const Hit& hit, const Surface& surface, std::uint32_t depth,
                          std::uint64_t left, double worth, const Weight& weight) const {
    // Steps of the golden section: casters are asked by numbers far apart.
    constexpr double golden = 0.61803398874989485;
    const std::uint32_t base = dimension::bounce(depth);
    double u = sampler_.get_1d(base + dimension::caster);
    Rgb sum;
    for (const Caster& caster : scene_.casters.all()) {
      const double far2 =
          length_squared(hit.point - caster.center) / (caster.radius * caster.radius);
      if (far2 > 1) {
        if (left > 1 && tracer_.template with<ir::Effect::reflection>())
          sum +=
              try_way({CasterWay::mirrored, far2, worth, u}, caster, hit, surface, depth, weight);
        if constexpr ((compiled & bit_of(ir::Effect::refraction)) != 0) {
          if (left > 2 && caster.clear() && tracer_.template with<ir::Effect::refraction>())
            sum +=
                try_way({CasterWay::through, far2, worth, u}, caster, hit, surface, depth, weight);
        }
      }
      u += golden;
      if (u >= 1) u -= 1;
    }
    return sum;
  }

  // The density with which `aimed` would have found a lamp that a path met by chance; 0: never.
  [[nodiscard]] double density(const CasterChain& chain, std::uint32_t emitter, const Hit& lamp,
                               const Vector3& direction) const {
    const Caster& caster = scene_.casters[chain.caster];
    const auto start = place_of(caster, chain.from);
    const auto end = place_of(caster, lamp.point);
    if (!start || !end) return 0;
    const Emitter& e = scene_.lights.emitters[emitter];
    const double chosen = scene_.casters.probability(emitter);
    if (!(chosen > 0)) return 0;
    const CasterWay way = way_of(chain);
    return CasterTable::asked(way, start->distance * start->distance, chain.worth) * chosen *
           area_pdf(e, lamp.point, lamp.geometric_normal) *
           solid_angle_factor(caster, way, *start, *end, chain.impact,
                              std::fabs(dot(lamp.geometric_normal, direction)));
  }
  // The density with which chance took that way, the choice of direction included.
  [[nodiscard]] double by_chance(const CasterChain& chain) const {
    return chain.pdf *
           share_of(scene_.casters[chain.caster], way_of(chain), chain.impact, {}).probability;
  }

  // After a path has been scattered at a hit. `aims`: whether this place asked the casters.
  void follow(CasterChain& chain, const Hit& hit, const BsdfSample& s, bool entering, bool aims,
              double worth, const Ray& arrived) const {
    using State = CasterChain::State;
    if (!s.specular) {
      chain.state = aims && !s.transmitted ? State::left : State::none;
      chain.from = hit.point;
      chain.pdf = s.pdf;
      chain.worth = worth;
      return;
    }
    if (chain.state == State::none) return;
    const std::uint32_t caster =
        hit.instance_count == 0 ? scene_.casters.of_item(hit.item) : CasterTable::none;
    if (chain.state == State::left && caster != CasterTable::none && entering) {
      const Caster& c = scene_.casters[caster];
      chain.caster = caster;
      const Vector3 past = cross(c.center - arrived.origin, arrived.direction);
      chain.impact = smaller(1, length(past) / (length(arrived.direction) * c.radius));
      chain.state = s.transmitted ? State::inside : State::mirrored;
    } else if (chain.state == State::inside && caster == chain.caster && s.transmitted &&
               !entering) {
      chain.state = State::through;
    } else {
      chain.state = State::none;
    }
  }

 private:
  struct Question {
    CasterWay way;
    double distance_squared;  // in radii
    double worth;
    double u;  // decides whether it is asked, and which lamp
  };

  static CasterWay way_of(const CasterChain& chain) {
    return chain.state == CasterChain::State::mirrored ? CasterWay::mirrored : CasterWay::through;
  }

  // From a density per area of the lamp to one per solid angle at the start.
  static double solid_angle_factor(const Caster& caster, CasterWay way, const CasterPlace& start,
                                   const CasterPlace& end, double impact, double cosine) {
    const double factor = spread_of(caster, way, start.distance, end.distance, impact) / cosine;
    return factor <= std::numeric_limits<double>::max() ? factor : 0;
  }

  template <class Surface, class Weight>
  Rgb try_way(const Question& question, const Caster& caster, const Hit& hit,
              const Surface& surface, std::uint32_t depth, const Weight& weight) const {
    const double asked =
        CasterTable::asked(question.way, question.distance_squared, question.worth);
    if (!(question.u < asked)) return {};
    const auto start = place_of(caster, hit.point);
    // Behind the surface nothing is lit, whatever the way.
    if (!start || dot(start->axis, surface.geometric) * start->distance > 1) return {};
    const CasterTable::Lamp lamp = scene_.casters.choose_lamp(question.u / asked);
    if (!(lamp.probability > 0)) return {};
    const Emitter& e = scene_.lights.emitters[lamp.emitter];
    const AreaPoint y =
        sample_area(e, sampler_.get_2d(dimension::bounce(depth) + dimension::light_point));
    const auto end = place_of(caster, y.point);
    if (!(y.pdf > 0) || !end) return {};
    const UnitVector3 outer = normalized(e.flipped && !is_flat(e.shape) ? -y.normal : y.normal);
    const CasterRoutes routes = routes_by(caster, question.way, hit.point, *start, y.point, *end);
    Rgb sum;
    for (int i = 0; i < routes.count; ++i) {
      const CasterRoute& route = routes.routes[static_cast<std::size_t>(i)];
      const double cosine = dot(outer, route.arrive);
      if (!(cosine < 0) && !e.two_sided) continue;
      const double aiming =
          asked * lamp.probability * y.pdf *
          solid_angle_factor(caster, question.way, *start, *end, route.impact, std::fabs(cosine));
      const Rgb scattered = by_route(caster, question.way, route, surface, aiming, weight);
      if (is_black(scattered)) continue;
      count(question.way);
      if (is_free(caster, question.way, route, hit, {y.point, e.error, outer}, depth))
        sum += scattered * e.radiance;
    }
    return sum;
  }

  // What the surface scatters of a radiance of 1 at the route's end, were nothing between.
  template <class Surface, class Weight>
  Rgb by_route(const Caster& caster, CasterWay way, const CasterRoute& route,
               const Surface& surface, double aiming, const Weight& weight) const {
    if (!(aiming > 0) || !(dot(route.wi, surface.geometric) > 0)) return {};
    const BsdfValue value = evaluate(surface, route.wi);
    if (is_black(value.f_cos)) return {};
    const CasterShare share = share_of(caster, way, route.impact, absorption(caster, way));
    return value.f_cos * share.carried * (weight(aiming, value.pdf * share.probability) / aiming);
  }

  [[nodiscard]] Rgb absorption(const Caster& caster, CasterWay way) const {
    if (way == CasterWay::mirrored || !caster.clear() ||
        !tracer_.template with<ir::Effect::absorption>())
      return {};
    const Rgb sigma = absorption_of(scene_, caster.material);
    if (!is_black(sigma)) tracer_.count(ir::Effect::absorption);
    return sigma;
  }
  void count(CasterWay way) const {
    tracer_.count(ir::Effect::caustics);
    tracer_.count(ir::Effect::area_lights);
    tracer_.count(way == CasterWay::mirrored ? ir::Effect::reflection : ir::Effect::refraction);
  }

  bool is_free(const Caster& caster, CasterWay way, const CasterRoute& route, const Hit& hit,
               const SurfacePoint& target, std::uint32_t depth) const {
    const SurfacePoint entry{route.entry, caster.error, route.entry_normal};
    const SurfacePoint exit{route.exit, caster.error, route.exit_normal};
    const auto blocked = [&](const SurfacePoint& a, const SurfacePoint& b) {
      return tracer_.hidden(spawn_segment(a, b), depth, sampler_);
    };
    return !blocked(surface_point(hit), entry) &&
           !(way == CasterWay::through && blocked(entry, exit)) && !blocked(exit, target);
  }

  const Tracer<compiled>& tracer_;
  const RenderScene& scene_;
  const Sampler& sampler_;
};

}  // namespace scenec::backend
