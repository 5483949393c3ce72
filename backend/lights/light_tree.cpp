#include "backend/lights/light_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "backend/math/frame.hpp"
#include "base/assert.hpp"
#include "base/elementary.hpp"

namespace scenec::backend {
namespace {

double clamped_acos(double c) {
  return acos(std::clamp(c, -1.0, 1.0));
}

// cos(max(0, a - b)) from cosines and sines of angles in [0, pi].
double cos_of_difference(double cos_a, double sin_a, double cos_b, double sin_b) {
  return cos_a > cos_b ? 1 : cos_a * cos_b + sin_a * sin_b;
}
double sin_of_difference(double cos_a, double sin_a, double cos_b, double sin_b) {
  return cos_a > cos_b ? 0 : sin_a * cos_b - cos_a * sin_b;
}
double sine_of(double cosine) {
  return std::sqrt(larger(0, 1 - cosine * cosine));
}

// From a place to a box, `way` to its centre.
double distance_to_box(const Vector3& way, const Vector3& half) {
  const Vector3 a = abs(way);
  const Vector3 out{larger(0, a.x - half.x), larger(0, a.y - half.y), larger(0, a.z - half.z)};
  return std::sqrt(length_squared(out));
}
// No direction to a point of the box has a larger cosine with the unit vector `n`; `along`: n .
// way.
double cos_within_box(double along, const Vector3& n, const Vector3& half, double nearest) {
  return std::clamp((along + dot(abs(n), half)) / nearest, 0.0, 1.0);
}

// The smallest cone round two (Barequet and Elber 2005).
void unite_cones(LightCluster& a, const LightCluster& b) {
  const double spread_a = clamped_acos(a.cos_spread);
  const double spread_b = clamped_acos(b.cos_spread);
  const double between = clamped_acos(dot(a.axis, b.axis));
  if (smaller(between + spread_b, pi) <= spread_a) return;
  if (smaller(between + spread_a, pi) <= spread_b) {
    a.axis = b.axis;
    a.cos_spread = b.cos_spread;
    return;
  }
  const double spread = (spread_a + between + spread_b) / 2;
  const Vector3 round = cross(a.axis, b.axis);
  if (spread >= pi || !(length_squared(round) > 0)) {
    a.cos_spread = -1;
    return;
  }
  // The axis of a, turned towards that of b.
  const SinCos turn = sin_cos(spread - spread_a);
  const Vector3 across = normalized(cross(round, a.axis)).vector();
  a.axis = normalized(a.axis * turn.cos + across * turn.sin).vector();
  a.cos_spread = cos(spread);
}

LightCluster unite(const LightCluster& a, const LightCluster& b) {
  if (!(a.power > 0)) return b;
  if (!(b.power > 0)) return a;
  LightCluster c = a;
  c.box.grow(b.box);
  c.power = a.power + b.power;
  c.cos_fall = smaller(a.cos_fall, b.cos_fall);
  c.two_sided = a.two_sided || b.two_sided;
  unite_cones(c, b);
  return c;
}

// The measure of a cone's directions, each weighed by what it gives (Conty Estevez and Kulla).
double measure_of(const LightCluster& c) {
  const double spread = clamped_acos(c.cos_spread);
  const double fall = smaller(spread + clamped_acos(c.cos_fall), pi);
  const double sine = sine_of(c.cos_spread);
  return 2 * pi * (1 - c.cos_spread) +
         pi / 2 * (2 * fall * sine - cos(spread - 2 * fall) - 2 * spread * sine + c.cos_spread);
}

double cost_of(const LightCluster& c, double stretch) {
  const Vector3 e = c.box.extent();
  const double area = e.x * e.y + e.y * e.z + e.z * e.x;
  return c.power * measure_of(c) * stretch * area;
}

}  // namespace

LightCluster cluster_of(const Emitter& e) {
  LightCluster c;
  c.power = luminance(e.radiance) * e.area * pi * (e.two_sided ? 2 : 1);
  c.two_sided = e.two_sided;
  const auto grow = [&](const Point3& middle, const Vector3& reach) {
    c.box.grow(middle - reach);
    c.box.grow(middle + reach);
  };
  const auto reach_of = [](const Vector3& a, const Vector3& b, const Vector3& d) {
    const auto one = [](double x, double y, double z) { return std::sqrt(x * x + y * y + z * z); };
    return Vector3{one(a.x, b.x, d.x), one(a.y, b.y, d.y), one(a.z, b.z, d.z)};
  };
  const Vector3 none{0, 0, 0};
  switch (e.shape) {
    case EmitterShape::parallelogram:
      c.box.grow(e.origin + e.a + e.b);
      [[fallthrough]];
    case EmitterShape::triangle:
      for (const Point3& p : {e.origin, e.origin + e.a, e.origin + e.b}) c.box.grow(p);
      break;
    case EmitterShape::ellipse:
      grow(e.origin, reach_of(e.a, e.b, none));
      break;
    case EmitterShape::sphere:
      grow(e.origin, {e.radius, e.radius, e.radius});
      break;
    case EmitterShape::cut_sphere: {
      // The cap: its power is counted, and what the other side sees is left to its cone.
      const double rim = std::sqrt(e.b.x * (2 * e.radius - e.b.x));
      grow(e.origin + e.a * (e.radius - e.b.x / 2), {rim, rim, rim});
      break;
    }
    case EmitterShape::ellipsoid:
      grow(e.origin, reach_of(e.a, e.b, e.c));
      break;
    case EmitterShape::tube:
      grow(e.origin, reach_of(e.a, e.b, none));
      grow(e.origin + e.c, reach_of(e.a, e.b, none));
      break;
  }
  if (is_flat(e.shape)) {
    c.axis = e.normal.vector();
    c.cos_spread = 1;
  }
  return c;
}

// Splits by buckets of centres, an axis at a time; the halves by number where that fails.
class LightTree::Builder {
 public:
  Builder(std::vector<Leaf>& leaves, LightTree& tree) : leaves_(leaves), tree_(tree) {
    order_.resize(leaves.size());
    for (std::uint32_t i = 0; i < order_.size(); ++i) order_[i] = i;
    tree_.nodes_.reserve(2 * leaves.size());
    tree_.trails_.resize(leaves.size());
    tree_.nodes_.emplace_back();
    build(0, 0, order_.size(), 0, 0);
  }

 private:
  static constexpr int buckets = 12;

  [[nodiscard]] Point3 center(std::uint32_t leaf) const {
    return leaves_[leaf].cluster.box.centroid();
  }

  LightCluster build(std::uint32_t node, std::size_t begin, std::size_t end, std::uint64_t trail,
                     int level) {
    if (end - begin == 1) {
      const std::uint32_t leaf = order_[begin];
      tree_.trails_[leaf] = trail;
      tree_.nodes_[node] = node_of(leaves_[leaf].cluster);
      tree_.nodes_[node].child = leaves_[leaf].light;
      return leaves_[leaf].cluster;
    }
    const std::size_t middle = split(begin, end, level);
    const auto child = static_cast<std::uint32_t>(tree_.nodes_.size());
    tree_.nodes_.resize(child + 2);
    const LightCluster low = build(child, begin, middle, trail, level + 1);
    const LightCluster high =
        build(child + 1, middle, end, trail | std::uint64_t{1} << level, level + 1);
    const LightCluster both = unite(low, high);
    tree_.nodes_[node] = node_of(both);
    tree_.nodes_[node].child = child;
    tree_.nodes_[node].is_leaf = false;
    return both;
  }

  std::size_t split(std::size_t begin, std::size_t end, int level) {
    Bounds3 centers;
    Bounds3 all;
    for (std::size_t i = begin; i < end; ++i) {
      centers.grow(center(order_[i]));
      all.grow(leaves_[order_[i]].cluster.box);
    }
    double best = std::numeric_limits<double>::infinity();
    int best_axis = -1;
    int best_bucket = 0;
    // 2^20 lights fill twenty levels; what is still together so far down is cut in the middle.
    if (level < most_levels - 32) {
      for (int axis = 0; axis < 3; ++axis)
        try_axis(begin, end, axis, centers, all, best, best_axis, best_bucket);
    }
    const auto first = order_.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto last = order_.begin() + static_cast<std::ptrdiff_t>(end);
    auto cut = first;
    if (best_axis >= 0) {
      cut = std::partition(first, last, [&](std::uint32_t leaf) {
        return bucket_of(center(leaf), best_axis, centers) <= best_bucket;
      });
    }
    if (cut == first || cut == last) return begin + (end - begin) / 2;
    return static_cast<std::size_t>(cut - order_.begin());
  }

  static int bucket_of(const Point3& p, int axis, const Bounds3& centers) {
    const double low = component(centers.min, axis);
    const double size = component(centers.max, axis) - low;
    const double share = (component(p, axis) - low) / size;
    return std::clamp(static_cast<int>(share * buckets), 0, buckets - 1);
  }

  void try_axis(std::size_t begin, std::size_t end, int axis, const Bounds3& centers,
                const Bounds3& all, double& best, int& best_axis, int& best_bucket) const {
    if (!(component(centers.max, axis) > component(centers.min, axis))) return;
    std::array<LightCluster, buckets> in;
    for (std::size_t i = begin; i < end; ++i) {
      LightCluster& bucket =
          in[static_cast<std::size_t>(bucket_of(center(order_[i]), axis, centers))];
      bucket = unite(bucket, leaves_[order_[i]].cluster);
    }
    // Long boxes are cut across.
    const Vector3 extent = all.extent();
    const double stretch = max_abs(extent) / component(extent, axis);
    std::array<LightCluster, buckets> above;
    LightCluster sum;
    for (std::size_t b = buckets; b-- > 1;) above[b] = sum = unite(sum, in[b]);
    LightCluster below;
    for (std::size_t b = 0; b + 1 < buckets; ++b) {
      below = unite(below, in[b]);
      if (!(below.power > 0) || !(above[b + 1].power > 0)) continue;
      const double cost = cost_of(below, stretch) + cost_of(above[b + 1], stretch);
      if (!(cost < best)) continue;
      best = cost;
      best_axis = axis;
      best_bucket = static_cast<int>(b);
    }
  }

  std::vector<Leaf>& leaves_;
  LightTree& tree_;
  std::vector<std::uint32_t> order_;
};

LightTree::LightTree(std::vector<Leaf> leaves) {
  SCENEC_ASSERT(leaves.size() < (std::size_t{1} << 31));
  if (!leaves.empty()) Builder(leaves, *this);
}

LightTree::Node LightTree::node_of(const LightCluster& c) {
  Node n;
  n.center = c.box.centroid();
  n.half = c.box.extent() * 0.5;
  n.radius2 = length_squared(n.half);
  n.axis = c.axis;
  n.cos_spread = c.cos_spread;
  n.sin_spread = sine_of(c.cos_spread);
  n.cos_fall = c.cos_fall;
  n.power = c.power;
  n.two_sided = c.two_sided;
  return n;
}

double LightTree::importance(const Node& n, const LitPlace& place) {
  const Vector3 way = n.center - place.point;
  const double true_distance2 = length_squared(way);
  const double distance2 = larger(true_distance2, n.radius2);
  if (!(distance2 > 0)) return n.power * 0x1p200;  // a place on the light itself
  // The cone in which the cluster's sphere is seen; from within it, everything.
  const bool inside = !(true_distance2 > n.radius2);
  const double sin2_seen = inside ? 1 : n.radius2 / true_distance2;
  const double cos_seen = inside ? -1 : std::sqrt(1 - sin2_seen);
  const double sin_seen = inside ? 0 : std::sqrt(sin2_seen);
  const double inverse = true_distance2 > 0 ? 1 / std::sqrt(true_distance2) : 0;

  double cos_axis = -dot(n.axis, way) * inverse;
  if (n.two_sided) cos_axis = std::fabs(cos_axis);
  const double sin_axis = sine_of(cos_axis);
  // What is left of the angle to the axis beyond the spread, then beyond what the cluster fills.
  const double cos_beyond = cos_of_difference(cos_axis, sin_axis, n.cos_spread, n.sin_spread);
  const double sin_beyond = sin_of_difference(cos_axis, sin_axis, n.cos_spread, n.sin_spread);
  double cos_least = cos_of_difference(cos_beyond, sin_beyond, cos_seen, sin_seen);
  const double nearest = distance_to_box(way, n.half);
  if (nearest > 0) {
    const double facing = n.two_sided ? std::fabs(dot(n.axis, way)) : -dot(n.axis, way);
    const double cos_box = cos_within_box(facing, n.axis, n.half, nearest);
    cos_least = smaller(cos_least,
                        cos_of_difference(cos_box, sine_of(cos_box), n.cos_spread, n.sin_spread));
  }
  if (!(cos_least > n.cos_fall)) return 0;
  // Over the whole sphere of directions the fall is no cosine: such lights give as much all round.
  double result = n.power * (n.cos_spread <= -1 ? 1 : larger(cos_least, 0)) / distance2;
  if (!(place.normal == Vector3{0, 0, 0})) {
    const double cos_in = dot(place.normal, way) * inverse;
    double cos_best = cos_of_difference(cos_in, sine_of(cos_in), cos_seen, sin_seen);
    if (nearest > 0)
      cos_best =
          smaller(cos_best, cos_within_box(dot(place.normal, way), place.normal, n.half, nearest));
    result *= larger(cos_best, 0);
  }
  return result;
}

LightTree::Choice LightTree::choose(double u, const LitPlace& place) const {
  if (nodes_.empty()) return {};
  const Node* node = nodes_.data();
  if (node->is_leaf) return {node->child, importance(*node, place) > 0 ? 1.0 : 0.0};
  double probability = 1;
  while (!node->is_leaf) {
    const Node* low = &nodes_[node->child];
    const double a = importance(low[0], place);
    const double b = importance(low[1], place);
    const double share = a / (a + b);
    if (!(share >= 0)) return {};  // neither
    if (u < share) {
      node = low;
      probability *= share;
      u = u / share;
    } else {
      node = low + 1;
      probability *= b / (a + b);
      u = (u - share) / (1 - share);
    }
    u = smaller(u, 1 - 0x1p-53);
  }
  return {node->child, probability};
}

double LightTree::probability(std::size_t leaf, const LitPlace& place) const {
  if (nodes_.empty()) return 0;
  const Node* node = nodes_.data();
  if (node->is_leaf) return importance(*node, place) > 0 ? 1 : 0;
  double probability = 1;
  for (std::uint64_t trail = trails_[leaf]; !node->is_leaf; trail >>= 1) {
    const Node* low = &nodes_[node->child];
    const double a = importance(low[0], place);
    const double b = importance(low[1], place);
    if (!(a + b > 0)) return 0;
    const bool high = (trail & 1) != 0;
    probability *= (high ? b : a) / (a + b);
    node = low + (high ? 1 : 0);
  }
  return probability;
}

}  // namespace scenec::backend
