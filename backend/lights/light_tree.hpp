// A choice among many lights whose cost grows with the logarithm of their number: a tree of bounds
// over where lights are, how much they give and whither.
//
// Domain:     lights at finite places; power above 0.
// Method:     Conty Estevez and Kulla 2018: clusters with a box, a cone of emitting directions and
//             a sum of power, split where the sum of power times area times solid angle is least; a
//             child is chosen in proportion to an upper bound of what it can give to the place.
//             Cosines are bounded by the cluster's sphere and by its box, whichever is tighter: a
//             flat box far off, as lamps of a ceiling are, is seen under a small angle only.
//             Distances are held above the cluster's radius, so that a place within it does not
//             see one light only.
// Error:      the probabilities of all lights for a place sum to at most 1 within depth * 4 u: a
//             cluster whose bound is above what its parts can give may be chosen in vain.
// Degenerate: lights at one place are split by number; a place none of them can light gets none.
// Proof:      tests/unit/backend/lights/light_tree_test.cpp.
#pragma once

#include <cstdint>
#include <vector>

#include "backend/lights/emitter.hpp"
#include "backend/math/bounds.hpp"

namespace scenec::backend {

// A place that is to be lit.
struct LitPlace {
  Point3 point;
  Vector3 normal{0, 0, 0};  // of the side light can come from; zero: from all round
};

// Directions within `cos_spread` of the axis are those of full strength; up to a further
// `cos_fall` there is light.
struct LightCluster {
  Bounds3 box;
  Vector3 axis{0, 0, 1};
  double cos_spread = -1;
  double cos_fall = 0;
  double power = 0;
  bool two_sided = false;
};

class LightTree {
 public:
  struct Leaf {
    LightCluster cluster;
    std::uint32_t light = 0;  // the caller's number
  };

  LightTree() = default;
  explicit LightTree(std::vector<Leaf> leaves);

  [[nodiscard]] bool empty() const { return nodes_.empty(); }
  struct Choice {
    std::uint32_t light = 0;
    double probability = 0;  // 0: none of them reaches the place
  };
  [[nodiscard]] Choice choose(double u, const LitPlace& place) const;
  // Of choosing the light that was given as the `leaf`th.
  [[nodiscard]] double probability(std::size_t leaf, const LitPlace& place) const;

  // More levels than this are never built, so a way down fits into 64 bits.
  static constexpr int most_levels = 60;

  [[nodiscard]] std::uint64_t memory() const {
    return nodes_.capacity() * sizeof(Node) + trails_.capacity() * sizeof(std::uint64_t);
  }

 private:
  // What `importance` reads, ready for use. Children of a node stand beside each other.
  struct Node {
    Point3 center;
    Vector3 half;        // of the box's extent
    double radius2 = 0;  // of the sphere round it
    Vector3 axis;
    double cos_spread = -1, sin_spread = 0;
    double cos_fall = 0;
    double power = 0;
    std::uint32_t child = 0;  // first of two; of a leaf: the light
    bool is_leaf = true;
    bool two_sided = false;
  };
  class Builder;

  [[nodiscard]] static Node node_of(const LightCluster& cluster);
  [[nodiscard]] static double importance(const Node& node, const LitPlace& place);

  std::vector<Node> nodes_;            // root first
  std::vector<std::uint64_t> trails_;  // of each leaf: its way down, one bit a level, lowest first
};

// The cluster of one emitter.
[[nodiscard]] LightCluster cluster_of(const Emitter& emitter);

}  // namespace scenec::backend
