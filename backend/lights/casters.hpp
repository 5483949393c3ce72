// Smooth spheres that throw the light of lamps onto other surfaces: mirrors and clear balls. Light
// that reaches a surface by way of one of them can be aimed at, though the way bends: see
// sphere_paths.hpp.
//
// Domain:     spheres and their images under similarities, outside instances, of one constant
//             smooth material that is opaque to nothing by chance; at most `most` of them, the
//             largest. Emitters whose radiance does not vary.
// Method:     a place asks each caster with a probability that falls with the square of its
//             distance, as what a sphere throws there does; a lamp is chosen by power, a point on
//             it uniformly in area.
// Error:      densities to a few ulp; both who aims and who meets the lamp by chance compute them
//             from the same four numbers.
// Degenerate: places within a sphere, lamps within it, no lamps: nothing to aim at.
// Proof:      tests/unit/backend/light_finding_test.cpp (one mean with and without),
//             tests/unit/backend/lights/casters_test.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "backend/lights/emitter.hpp"
#include "backend/lights/sphere_paths.hpp"
#include "backend/materials/bsdf.hpp"
#include "ir/scene.hpp"

namespace scenec::backend {

// By which way light passes a sphere: off its outside, or in and out again.
enum class CasterWay : std::uint8_t { mirrored, through };

struct Caster {
  Point3 center;
  double radius = 0;
  Vector3 error;  // of points of its surface
  ir::MaterialId material;
  Bsdf bsdf;       // all but what depends on the viewer
  double ior = 1;  // of a clear one
  [[nodiscard]] bool clear() const { return bsdf.kind == BsdfKind::glass; }
};

class CasterTable {
 public:
  static constexpr std::uint32_t none = 0xffffffff;
  static constexpr std::size_t most = 64;

  // `items`: how many there are; `emitters`: all of the scene.
  void finish(std::vector<std::pair<std::uint32_t, Caster>> casters, std::size_t items,
              const std::vector<Emitter>& emitters);

  [[nodiscard]] bool empty() const { return casters_.empty(); }
  [[nodiscard]] const std::vector<Caster>& all() const { return casters_; }
  [[nodiscard]] const Caster& operator[](std::uint32_t caster) const { return casters_[caster]; }
  [[nodiscard]] std::uint64_t memory() const {
    return casters_.capacity() * sizeof(Caster) + of_item_.capacity() * sizeof(std::uint32_t) +
           (power_.capacity() + cumulative_.capacity()) * sizeof(double);
  }
  // The caster an item is, or none.
  [[nodiscard]] std::uint32_t of_item(std::uint32_t item) const {
    return item < of_item_.size() ? of_item_[item] : none;
  }

  // With which probability a place asks a caster. `distance_squared`: from its centre, in radii;
  // `worth`: what the path can still bring, at most 1.
  [[nodiscard]] static double asked(CasterWay way, double distance_squared, double worth) {
    // Where noise times time was least in a room with a mirror and a glass ball; it is flat there.
    const double reach_squared = way == CasterWay::mirrored ? 0.3 : 2;
    return smaller(1, reach_squared * worth / distance_squared);
  }
  struct Lamp {
    std::uint32_t emitter = none;
    double probability = 0;
  };
  [[nodiscard]] Lamp choose_lamp(double u) const;
  // 0: never chosen.
  [[nodiscard]] double probability(std::uint32_t emitter) const { return power_[emitter]; }

 private:
  std::vector<Caster> casters_;
  std::vector<std::uint32_t> of_item_;
  std::vector<double> power_;       // of emitters, in sum 1
  std::vector<double> cumulative_;  // of the same
};

// What is left of light on its way by a caster, and the probability that a path that meets the
// caster takes that way. `impact` as in sphere_paths.hpp. `absorption`: within it, an inverse
// length.
struct CasterShare {
  Rgb carried;
  double probability = 1;
};
[[nodiscard]] CasterShare share_of(const Caster& caster, CasterWay way, double impact,
                                   const Rgb& absorption);

// The ways by a caster from one place: whether there is any, and what each is like.
struct CasterPlace {
  Vector3 axis;     // from the centre to the place, unit
  double distance;  // in radii
};
[[nodiscard]] std::optional<CasterPlace> place_of(const Caster& caster, const Point3& point);

// Area across the path at its end over solid angle at its start.
[[nodiscard]] double spread_of(const Caster& caster, CasterWay way, double from, double to,
                               double impact);

struct CasterRoute {
  double impact = 0;
  UnitVector3 wi;      // from the start
  UnitVector3 arrive;  // at the end, the way light is looked for
  Point3 entry, exit;  // of the caster; the same where it mirrors
  UnitVector3 entry_normal, exit_normal;
};
struct CasterRoutes {
  std::array<CasterRoute, 5> routes;
  int count = 0;
};
// All routes from `from` to `to` by one way.
[[nodiscard]] CasterRoutes routes_by(const Caster& caster, CasterWay way, const Point3& from,
                                     const CasterPlace& start, const Point3& to,
                                     const CasterPlace& end);

}  // namespace scenec::backend
