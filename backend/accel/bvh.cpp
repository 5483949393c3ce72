#include "backend/accel/bvh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/assert.hpp"

namespace scenec::backend {
namespace {

constexpr int bin_count = 32;
// Relative costs of stepping through an inner node and of testing one entry.
constexpr double cost_of_node = 1;
constexpr double cost_of_entry = 1;
// From here on lists are halved: 32 further levels hold any 32-bit count.
constexpr int depth_of_heuristic = Bvh::max_depth - 33;
// Subtrees up to this size are one task. Fixed, so that the tree does not depend on the pool.
constexpr std::size_t task_size = 8192;

struct Entry {
  Bounds3 box;
  Point3 centroid;
  std::uint32_t index;
};

struct Split {
  int axis = -1;
  int bin = 0;
  double cost = std::numeric_limits<double>::infinity();
};

Bounds3 box_of(std::span<const Entry> entries) {
  Bounds3 b;
  for (const Entry& e : entries) b.grow(e.box);
  return b;
}

Bounds3 centroids_of(std::span<const Entry> entries) {
  Bounds3 b;
  for (const Entry& e : entries) b.grow(e.centroid);
  return b;
}

int bin_of(const Entry& e, int axis, double low, double scale) {
  const double position = (component(e.centroid, axis) - low) * scale;
  return std::clamp(static_cast<int>(position), 0, bin_count - 1);
}

double bin_scale(const Bounds3& centroids, int axis) {
  const double extent = component(centroids.max, axis) - component(centroids.min, axis);
  const double scale = bin_count / extent;
  return extent > 0 && std::isfinite(scale) ? scale : 0;
}

void try_axis(std::span<const Entry> entries, const Bounds3& centroids, int axis, Split& best) {
  const double scale = bin_scale(centroids, axis);
  if (scale == 0) return;
  const double low = component(centroids.min, axis);
  std::array<Bounds3, bin_count> boxes{};
  std::array<std::size_t, bin_count> counts{};
  for (const Entry& e : entries) {
    const auto bin = static_cast<std::size_t>(bin_of(e, axis, low, scale));
    boxes[bin].grow(e.box);
    ++counts[bin];
  }
  std::array<double, bin_count> right_cost{};
  Bounds3 side;
  std::size_t count = 0;
  for (std::size_t i = bin_count - 1; i > 0; --i) {
    side.grow(boxes[i]);
    count += counts[i];
    right_cost[i] = side.half_area() * static_cast<double>(count);
  }
  side = {};
  count = 0;
  for (std::size_t i = 0; i + 1 < bin_count; ++i) {
    side.grow(boxes[i]);
    count += counts[i];
    if (count == 0 || count == entries.size()) continue;
    const double cost = side.half_area() * static_cast<double>(count) + right_cost[i + 1];
    if (cost < best.cost) best = {axis, static_cast<int>(i), cost};
  }
}

// The number of entries of the first child, 0 for a leaf. Reorders `entries`.
std::size_t split(std::span<Entry> entries, const Bounds3& box, int depth, int& axis) {
  axis = 0;
  const std::size_t count = entries.size();
  if (count == 1) return 0;
  if (depth < depth_of_heuristic) {
    const Bounds3 centroids = centroids_of(entries);
    Split best;
    for (int a = 0; a < 3; ++a) try_axis(entries, centroids, a, best);
    if (best.axis >= 0) {
      const double area = box.half_area();
      const double leaf_cost = cost_of_entry * static_cast<double>(count);
      // Flat and overflowing boxes have no usable area: then split while a leaf would be too large.
      const double split_cost =
          area > 0 ? cost_of_node + cost_of_entry * best.cost / area : leaf_cost;
      if (count <= Bvh::max_leaf && !(split_cost < leaf_cost)) return 0;
      const double scale = bin_scale(centroids, best.axis);
      const double low = component(centroids.min, best.axis);
      axis = best.axis;
      const auto middle = std::partition(entries.begin(), entries.end(), [&](const Entry& e) {
        return bin_of(e, best.axis, low, scale) <= best.bin;
      });
      const auto left = static_cast<std::size_t>(middle - entries.begin());
      if (left > 0 && left < count) return left;
    }
  }
  return count <= Bvh::max_leaf ? 0 : count / 2;
}

struct Tree {
  std::vector<BvhNode> nodes;
  int depth = 0;
};

void make_leaf(BvhNode& node, std::size_t first, std::size_t count) {
  node.first = static_cast<std::uint32_t>(first);
  node.count = static_cast<std::uint32_t>(count);
}

// Depth-first, recursive: the depth is bounded by Bvh::max_depth.
void build_subtree(std::span<Entry> all, std::size_t first, std::size_t count, int depth,
                   Tree& tree) {
  const std::size_t self = tree.nodes.size();
  tree.nodes.emplace_back();
  tree.depth = std::max(tree.depth, depth);
  const std::span<Entry> entries = all.subspan(first, count);
  const Bounds3 box = box_of(entries);
  tree.nodes[self].box = box;
  int axis = 0;
  const std::size_t left = split(entries, box, depth, axis);
  if (left == 0) {
    make_leaf(tree.nodes[self], first, count);
    return;
  }
  build_subtree(all, first, left, depth + 1, tree);
  tree.nodes[self].axis = static_cast<std::uint32_t>(axis);
  tree.nodes[self].first = static_cast<std::uint32_t>(tree.nodes.size());
  build_subtree(all, first + left, count - left, depth + 1, tree);
}

// The upper part, built by one thread; its leaves are tasks or real leaves.
struct TopNode {
  BvhNode node;
  std::size_t second = 0;  // of an inner node, in the list of top nodes; the first child is next
  int task = -1;
};
struct Task {
  std::size_t first = 0;
  std::size_t count = 0;
  int depth = 0;
  Tree tree;
};

void build_top(std::span<Entry> all, std::size_t first, std::size_t count, int depth,
               std::vector<TopNode>& top, std::vector<Task>& tasks) {
  const std::size_t self = top.size();
  top.emplace_back();
  const std::span<Entry> entries = all.subspan(first, count);
  std::size_t left = 0;
  int axis = 0;
  if (count > task_size) {
    top[self].node.box = box_of(entries);
    left = split(entries, top[self].node.box, depth, axis);
  }
  if (left == 0) {
    top[self].task = static_cast<int>(tasks.size());
    tasks.push_back({first, count, depth, {}});
    return;
  }
  top[self].node.axis = static_cast<std::uint32_t>(axis);
  build_top(all, first, left, depth + 1, top, tasks);
  top[self].second = top.size();
  build_top(all, first + left, count - left, depth + 1, top, tasks);
}

void emit(const std::vector<TopNode>& top, std::size_t index, std::vector<Task>& tasks, Tree& out) {
  const TopNode& node = top[index];
  const auto base = static_cast<std::uint32_t>(out.nodes.size());
  if (node.task >= 0) {
    Tree& tree = tasks[static_cast<std::size_t>(node.task)].tree;
    for (BvhNode& n : tree.nodes) {
      if (n.count == 0) n.first += base;
      out.nodes.push_back(n);
    }
    out.depth = std::max(out.depth, tree.depth);
    tree.nodes = {};
    return;
  }
  out.nodes.push_back(node.node);
  emit(top, index + 1, tasks, out);
  out.nodes[base].first = static_cast<std::uint32_t>(out.nodes.size());
  emit(top, node.second, tasks, out);
}

}  // namespace

Bvh::Bvh(std::span<const Bounds3> boxes, ThreadPool& pool) {
  SCENEC_ASSERT(boxes.size() < std::numeric_limits<std::uint32_t>::max());
  std::vector<Entry> entries;
  entries.reserve(boxes.size());
  for (std::uint32_t i = 0; i < boxes.size(); ++i)
    if (!boxes[i].empty() && boxes[i].finite())
      entries.push_back({boxes[i], boxes[i].centroid(), i});
  if (entries.empty()) return;
  std::vector<TopNode> top;
  std::vector<Task> tasks;
  build_top(entries, 0, entries.size(), 0, top, tasks);
  pool.for_each(tasks.size(), [&](std::size_t i, unsigned) {
    Task& task = tasks[i];
    task.tree.nodes.reserve(2 * task.count);
    build_subtree(entries, task.first, task.count, task.depth, task.tree);
  });
  Tree tree;
  tree.nodes.reserve(2 * entries.size());
  emit(top, 0, tasks, tree);
  nodes_ = std::move(tree.nodes);
  nodes_.shrink_to_fit();
  depth_ = tree.depth;
  order_.reserve(entries.size());
  for (const Entry& e : entries) order_.push_back(e.index);
}

}  // namespace scenec::backend
