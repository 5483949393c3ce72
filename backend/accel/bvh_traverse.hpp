// Walking a Bvh along a ray, nearest child first, without recursion.
//
// Domain:     a traceable ray; directions may have zero, subnormal or huge components.
// Method:     slab test by reciprocal; both slab distances widened by gamma(16) relative, at least
//             the 2 gamma(3) of Ize 2013, so that neither the boxes' nor the kernels' roundings
//             lose a hit; NaN (origin on a slab plane of a parallel ray) counts as inside.
// Error:      a box may be visited in vain, never left out.
// Degenerate: an empty tree visits nothing.
// Proof:      tests/unit/backend/accel/bvh_test.cpp: the same bits as brute force.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "backend/accel/bvh.hpp"
#include "backend/geometry/kernel.hpp"

namespace scenec::backend {

class RayBoxTest {
 public:
  explicit RayBoxTest(const Ray& ray)
      : origin_(ray.origin),
        inverse_{1 / ray.direction.x, 1 / ray.direction.y, 1 / ray.direction.z},
        negative_{std::signbit(ray.direction.x), std::signbit(ray.direction.y),
                  std::signbit(ray.direction.z)} {}

  // Whether [t_min, t_max] meets the box; `entry` is where, for ordering and later pruning.
  [[nodiscard]] bool meets(const Bounds3& box, double t_min, double t_max, double& entry) const {
    double near = -Bounds3::infinity;
    double far = Bounds3::infinity;
    narrow(negative_[0] ? box.max.x : box.min.x, negative_[0] ? box.min.x : box.max.x, origin_.x,
           inverse_.x, near, far);
    narrow(negative_[1] ? box.max.y : box.min.y, negative_[1] ? box.min.y : box.max.y, origin_.y,
           inverse_.y, near, far);
    narrow(negative_[2] ? box.max.z : box.min.z, negative_[2] ? box.min.z : box.max.z, origin_.z,
           inverse_.z, near, far);
    near -= std::fabs(near) * gamma(16);
    far += std::fabs(far) * gamma(16);
    entry = near > t_min ? near : t_min;
    // An infinite near (or far) of the wrong sign has become NaN and fails here, as it should.
    return near <= far && near <= t_max && far >= t_min;
  }

 private:
  static void narrow(double enter, double leave, double origin, double inverse, double& near,
                     double& far) {
    const double t0 = (enter - origin) * inverse;
    const double t1 = (leave - origin) * inverse;
    near = t0 > near ? t0 : near;  // false for NaN
    far = t1 < far ? t1 : far;
  }

  Point3 origin_;
  Vector3 inverse_;
  std::array<bool, 3> negative_;
};

// Calls leaf(first, count), entries of `bvh.order()`, for every leaf whose box meets the ray up to
// `t_max`, which the callee may lower meanwhile. Stops, and returns true, when `leaf` returns true.
template <class Leaf>
bool visit_leaves(const Bvh& bvh, const RayBoxTest& test, double t_min, const double& t_max,
                  Leaf&& leaf) {
  struct Pending {
    std::uint32_t node;
    double entry;
  };
  std::array<Pending, Bvh::max_depth + 1> stack;
  const BvhNode* nodes = bvh.nodes().data();
  double entry = 0;
  if (bvh.empty() || !test.meets(nodes[0].box, t_min, t_max, entry)) return false;
  std::size_t size = 0;
  std::uint32_t current = 0;
  while (true) {
    const BvhNode& node = nodes[current];
    if (node.count != 0) {
      if (leaf(node.first, node.count)) return true;
    } else {
      const std::uint32_t a = current + 1;
      const std::uint32_t b = node.first;
      double entry_a = 0;
      double entry_b = 0;
      const bool meets_a = test.meets(nodes[a].box, t_min, t_max, entry_a);
      const bool meets_b = test.meets(nodes[b].box, t_min, t_max, entry_b);
      if (meets_a && meets_b) {
        const bool a_first = entry_a <= entry_b;
        stack[size++] = a_first ? Pending{b, entry_b} : Pending{a, entry_a};
        current = a_first ? a : b;
        continue;
      }
      if (meets_a || meets_b) {
        current = meets_a ? a : b;
        continue;
      }
    }
    do {
      if (size == 0) return false;
      --size;
    } while (!(stack[size].entry <= t_max));
    current = stack[size].node;
  }
}

}  // namespace scenec::backend
