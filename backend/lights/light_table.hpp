// All lights of a scene behind one choice: a light is drawn with a probability in proportion to its
// power, then a direction to it.
//
// Domain:     any number of lights; one without power is never drawn (P13).
// Method:     cumulative table, binary search.
// Error:      probabilities sum to 1 within n u.
// Degenerate: no lights, or no power: nothing is drawn. A point light at the reference point itself
//             gives no sample (P09). Constant environments are never drawn, as every direction
//             finds them; `sample` serves them when asked by number.
// Proof:      tests/unit/backend/lights/light_table_test.cpp.
#pragma once

#include <optional>
#include <vector>

#include "backend/lights/emitter.hpp"
#include "backend/lights/environment.hpp"
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
  std::optional<UnitVector3> target_normal;  // the target lies on a surface
  const Emitter* emitter = nullptr;
};

class LightTable {
 public:
  std::vector<DeltaLight> deltas;
  std::vector<Emitter> emitters;
  std::vector<Environment> environments;

  // After the lists are filled: measures powers. `scene_radius`: of what can be lit.
  void finish(double scene_radius);

  [[nodiscard]] std::size_t size() const { return probability_.size(); }
  // Of being chosen; 0: never.
  [[nodiscard]] double probability(std::size_t light) const { return probability_[light]; }
  [[nodiscard]] std::size_t first_emitter() const { return deltas.size(); }
  [[nodiscard]] std::size_t first_environment() const { return deltas.size() + emitters.size(); }
  [[nodiscard]] bool is_constant_environment(std::size_t light) const {
    return light >= first_environment() && environments[light - first_environment()].is_constant();
  }
  struct Choice {
    std::size_t light = 0;
    double probability = 0;  // 0: none
  };
  [[nodiscard]] Choice choose(double u) const;
  [[nodiscard]] std::optional<LightSample> sample(std::size_t light, const Point3& from,
                                                  Sample2 u) const;
  // Density per solid angle, with the choice of light, of hitting this emitter's point.
  [[nodiscard]] double pdf_of_emitter(std::size_t emitter, const Point3& from, const Point3& point,
                                      const UnitVector3& normal) const;
  [[nodiscard]] double pdf_of_environment(std::size_t environment, const Vector3& direction) const;
  [[nodiscard]] Rgb environment_radiance(const Vector3& direction) const;

 private:
  [[nodiscard]] std::optional<LightSample> sample_delta(const DeltaLight& light,
                                                        const Point3& from) const;

  std::vector<double> probability_;  // deltas, emitters, environments
  std::vector<double> cumulative_;
};

}  // namespace scenec::backend
