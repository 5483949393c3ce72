// Where the items of a world stand: each transform in as few bytes as it needs, since a scene may
// place ten million instances. A pure move takes 24 bytes, anything else 192.
#pragma once

#include <cstdint>

#include "backend/geometry/kernel.hpp"
#include "backend/math/transform.hpp"
#include "base/hash.hpp"
#include "ir/transform_table.hpp"

namespace scenec::backend {

class Placements {
 public:
  using Index = std::uint32_t;
  static constexpr Index identity = 0;

  // The identity gives `identity`. At most 2^31 - 1 of either kind.
  Index add(const Transform& world_from_object);
  [[nodiscard]] bool holds(Index index) const;
  // All of them, in their order.
  void feed(Hasher& hasher) const;
  [[nodiscard]] std::uint64_t memory() const {
    return moves_.size() * sizeof(Vector3) + others_.size() * sizeof(Transform);
  }
  // World from object.
  [[nodiscard]] Transform operator[](Index index) const;
  // The same points in object space. Not renormalised: every t stays what it is.
  [[nodiscard]] Ray to_object(Index index, const Ray& ray) const {
    if (index == identity) return ray;
    const std::uint32_t place = (index - 1) >> 1;
    if ((index & 1) != 0) return {ray.origin - moves_[place], ray.direction, ray.t_min, ray.t_max};
    const Transform& t = others_[place];
    return {t.apply_inverse(ray.origin), t.apply_inverse(ray.direction), ray.t_min, ray.t_max};
  }

 private:
  // Index 1 + 2 k: moves_[k]; 2 + 2 k: others_[k].
  ir::PiecewiseArray<Vector3> moves_;
  ir::PiecewiseArray<Transform> others_;
};

}  // namespace scenec::backend
