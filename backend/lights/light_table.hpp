// All lights of a scene behind one choice: a light is drawn by what it can give to the place that
// is lit, then a direction to it.
//
// Domain:     any number of lights; one without power is never drawn (P13).
// Method:     lights at finite places: a tree (light_tree.hpp). Far ones, and those that do not get
//             weaker on their way: by power, from a cumulative table. Where there are both kinds,
//             each is asked half the time.
// Error:      probabilities sum to at most 1 within n u (light_tree.hpp).
// Degenerate: no lights, or no power: nothing is drawn. A point light at the reference point itself
//             gives no sample (P09). Constant environments are never drawn, as every direction
//             finds them; `sample` serves them when asked by number.
// Proof:      tests/unit/backend/lights/lights_test.cpp.
#pragma once

#include <optional>
#include <vector>

#include "backend/lights/emitter.hpp"
#include "backend/lights/environment.hpp"
#include "backend/lights/light_tree.hpp"
#include "ir/lights.hpp"

namespace scenec::backend {

// A light without extent: point, spot or directional.
struct DeltaLight {
  enum class Kind : std::uint8_t { point, spot, directional };
  Kind kind = Kind::point;
  bool inverse_square = true;
  Point3 position;
  UnitVector3 direction;  // of travel; axis of the cone
  double cos_edge = -1;   // nothing beyond
  double cos_full = -1;   // full strength within
  Rgb value;              // intensity, or irradiance
};
[[nodiscard]] std::optional<DeltaLight> delta_light_of(const ir::LightKind& light);
// The share of a spot's intensity in a direction of travel.
[[nodiscard]] double spot_share(const DeltaLight& light, const Vector3& travel);

struct LightSample {
  Vector3 wi;          // unit, to the light
  Rgb radiance;        // arriving, before visibility; for lights without extent: irradiance at wi
  double pdf = 1;      // per solid angle, the choice of light left out
  bool delta = false;  // no other way to meet this light
  bool infinite = false;
  Point3 target;
  Vector3 target_error;
  UnitVector3 target_normal;         // where the target lies on a surface
  const Emitter* emitter = nullptr;  // that surface
};

// How a light is chosen: by what the tree says it can give to the place, or by its power alone.
enum class LightSelection : std::uint8_t { tree, power };

// How `.path` finds lights that can both be aimed at and be met by chance. Each way alone has the
// same mean, with more noise: for the tests that hold the two together.
enum class LightFinding : std::uint8_t { both, aiming, chance };

class LightTable {
 public:
  std::vector<DeltaLight> deltas;
  std::vector<Emitter> emitters;
  std::vector<Environment> environments;
  LightFinding finding = LightFinding::both;

  // After the lists are filled: measures powers. `scene_radius`: of what can be lit.
  void finish(double scene_radius, LightSelection selection = LightSelection::tree);

  [[nodiscard]] std::size_t size() const { return power_.size(); }
  [[nodiscard]] bool can_be_drawn(std::size_t light) const { return power_[light] > 0; }
  // Whether a light has a shape that rays pass.
  [[nodiscard]] bool any_invisible() const { return any_invisible_; }
  // Of being chosen for a place; 0: never.
  [[nodiscard]] double probability(std::size_t light, const LitPlace& place) const;
  [[nodiscard]] std::size_t first_emitter() const { return deltas.size(); }
  [[nodiscard]] std::size_t first_environment() const { return deltas.size() + emitters.size(); }
  [[nodiscard]] bool is_constant_environment(std::size_t light) const {
    return light >= first_environment() && environments[light - first_environment()].is_constant();
  }
  struct Choice {
    std::size_t light = 0;
    double probability = 0;  // 0: none
  };
  [[nodiscard]] Choice choose(double u, const LitPlace& place) const;
  // False: no light from there.
  [[nodiscard]] bool sample(std::size_t light, const Point3& from, Sample2 u,
                            LightSample& out) const;
  [[nodiscard]] Rgb environment_radiance(const Vector3& direction) const;
  [[nodiscard]] std::uint64_t memory() const;  // bytes

 private:
  [[nodiscard]] static bool sample_delta(const DeltaLight& light, const Point3& from,
                                         LightSample& out);

  static constexpr std::uint32_t no_leaf = 0xffffffff;

  [[nodiscard]] Choice choose_by_power(double u) const;
  void build_tree();

  std::vector<double> power_;        // deltas, emitters, environments; in sum 1
  std::vector<std::uint32_t> leaf_;  // in the tree; no_leaf: in the table
  std::vector<double> cumulative_;   // power of those in the table
  double tree_share_ = 0;            // probability of asking the tree
  LightTree tree_;
  bool any_invisible_ = false;
};

}  // namespace scenec::backend
