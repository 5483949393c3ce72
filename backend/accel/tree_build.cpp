#include "backend/accel/tree_build.hpp"

#include <algorithm>
#include <utility>

#include "backend/accel/binary_build.hpp"
#include "backend/accel/spatial_build.hpp"
#include "base/assert.hpp"

namespace scenec::backend {
namespace {

// Runs up to this size are one task. Fixed, so that the tree does not depend on the pool.
constexpr std::size_t task_size = 16384;

// Spatial splits are tried when the sides of nodes overlap by more than this share of the nodes'
// areas: it lies between scans (below 0.17) and buildings (above 0.24).
constexpr float overlap_worth_splitting = 0.2F;
constexpr std::uint32_t smallest_measured = 64;

// The upper part, built first; its leaves are tasks.
struct TopNode {
  FloatBox box;
  int first = -1;  // children, in the list of top nodes; -1: a task
  int second = -1;
  int task = -1;
};

struct Task {
  BuildRange range;
  SpatialRange spatial;
  float overlap = 0;  // of the sides of its nodes, and their areas
  float area = 0;
  TreeRef root;
  HugeVector<WideNode> nodes;
  std::vector<std::uint32_t> ids;
  std::uint32_t first_node = 0;
  std::uint32_t first_block = 0;
};

class Builder {
 public:
  Builder(std::vector<BuildRef> refs, const BuildSettings& settings, ThreadPool& pool)
      : refs_(std::move(refs)), settings_(settings), pool_(pool) {}

  BuiltTree run() {
    BuiltTree out;
    if (refs_.empty()) return out;
    out.empty = false;
    const BuildRange whole = whole_range(refs_);
    build_top(whole);
    pool_.for_each(tasks_.size(), [&](std::size_t i, unsigned) { build_task(tasks_[i]); });
    const bool splits = settings_.splitter != nullptr && splits_pay();
    out.splits_would_pay = splits && settings_.splits == Splits::never;
    if (splits && settings_.splits == Splits::where_they_pay) {
      top_.clear();
      tasks_.clear();
      root_area_ = whole.box.half_area();
      const float extra = settings_.extra_refs * static_cast<float>(refs_.size());
      SpatialRange all{std::move(refs_), static_cast<std::size_t>(extra), 0};
      build_top_spatially(std::move(all));
      pool_.for_each(tasks_.size(),
                     [&](std::size_t i, unsigned) { build_task_spatially(tasks_[i]); });
    }
    // Not `= {}`, which keeps the memory.
    refs_ = std::vector<BuildRef>();
    std::uint32_t nodes = count_top_nodes(0);
    std::uint32_t blocks = 0;
    for (Task& task : tasks_) {
      task.first_node = nodes;
      task.first_block = blocks;
      nodes += static_cast<std::uint32_t>(task.nodes.size());
      blocks += static_cast<std::uint32_t>(task.ids.size() / settings_.block_width);
    }
    SCENEC_ASSERT(blocks < TreeRef::max_first);
    out.nodes.resize(nodes);
    out.ids.resize(std::size_t{blocks} * settings_.block_width);
    pool_.for_each(tasks_.size(), [&](std::size_t i, unsigned) { place(tasks_[i], out); });
    next_node_ = 0;
    out.root = emit_top(0, out);
    return out;
  }

 private:
  // A level at a time, all its ranges at once: the upper levels are a third of the work.
  void build_top(const BuildRange& whole) {
    struct Halves {
      bool split = false;
      BuildRange left;
      BuildRange right;
    };
    std::vector<BuildRange> ranges{whole};  // of top_
    top_.push_back({whole.box});
    for (std::size_t level = 0; level < top_.size();) {
      std::vector<Halves> halves(top_.size() - level);
      pool_.for_each(halves.size(), [&](std::size_t i, unsigned) {
        const BuildRange& range = ranges[level + i];
        Halves& h = halves[i];
        h.split = range.count > task_size && split_range(refs_, range, settings_, h.left, h.right);
      });
      for (std::size_t i = 0; i < halves.size(); ++i) {
        if (!halves[i].split) continue;
        top_[level + i].first = static_cast<int>(top_.size());
        top_[level + i].second = static_cast<int>(top_.size()) + 1;
        for (const BuildRange& range : {halves[i].left, halves[i].right}) {
          ranges.push_back(range);
          top_.push_back({range.box});
        }
      }
      level += halves.size();
    }
    give_tasks(0, ranges);
  }
  // Numbered from left to right, so that what is near in space is near in memory.
  void give_tasks(int index, const std::vector<BuildRange>& ranges) {
    if (at(index).first < 0) {
      at(index).task = static_cast<int>(tasks_.size());
      tasks_.emplace_back().range = ranges[static_cast<std::size_t>(index)];
      return;
    }
    give_tasks(at(index).first, ranges);
    give_tasks(at(index).second, ranges);
  }

  void build_task(Task& task) {
    const std::vector<BinaryNode> tree = build_binary(refs_, task.range, settings_);
    collapse_task(tree, refs_, task);
    measure_overlap(tree, task);
  }

  // What waits to be placed takes no more than it holds: there may be a thousand tasks.
  void collapse_task(std::span<const BinaryNode> tree, std::span<const BuildRef> refs,
                     Task& task) const {
    HugeVector<WideNode> nodes;
    std::vector<std::uint32_t> ids;
    nodes.reserve(tree.size() / 8 + 1);
    ids.reserve(task_size + task_size / 2);
    task.root = collapse(tree, refs, settings_, nodes, ids);
    task.nodes.assign(nodes.begin(), nodes.end());
    task.ids.assign(ids.begin(), ids.end());
  }

  static void measure_overlap(std::span<const BinaryNode> tree, Task& task) {
    for (std::size_t i = 0; i < tree.size(); ++i) {
      if (tree[i].is_leaf() || tree[i].count < smallest_measured) continue;
      const FloatBox& a = tree[i + 1].box;
      const FloatBox& b = tree[tree[i].second].box;
      const FloatBox both{max_of(a.min, b.min), min_of(a.max, b.max)};
      if (both.min[0] <= both.max[0] && both.min[1] <= both.max[1] && both.min[2] <= both.max[2])
        task.overlap += both.half_area();
      task.area += tree[i].box.half_area();
    }
  }

  // How much the sides of nodes overlap says how much cutting could save.
  [[nodiscard]] bool splits_pay() const {
    float overlap = 0;
    float area = 0;
    for (const Task& task : tasks_) {
      overlap += task.overlap;
      area += task.area;
    }
    return overlap > overlap_worth_splitting * area;
  }

  int build_top_spatially(SpatialRange range) {
    const auto self = static_cast<int>(top_.size());
    top_.push_back({box_of(range.refs)});
    SpatialRange left;
    SpatialRange right;
    if (range.refs.size() <= task_size ||
        !split_spatially(range, settings_, root_area_, left, right)) {
      at(self).task = static_cast<int>(tasks_.size());
      tasks_.emplace_back().spatial = std::move(range);
      return self;
    }
    const int first = build_top_spatially(std::move(left));
    const int second = build_top_spatially(std::move(right));
    at(self).first = first;
    at(self).second = second;
    return self;
  }

  void build_task_spatially(Task& task) const {
    std::vector<BuildRef> refs;
    const std::vector<BinaryNode> tree =
        build_binary_spatially(std::move(task.spatial), settings_, root_area_, refs);
    collapse_task(tree, refs, task);
  }

  static TreeRef moved(TreeRef ref, const Task& task) {
    return ref.is_leaf() ? TreeRef::leaf(ref.first() + task.first_block, ref.count())
                         : TreeRef::node(ref.node_index() + task.first_node);
  }

  void place(Task& task, BuiltTree& out) const {
    for (std::size_t i = 0; i < task.nodes.size(); ++i) {
      WideNode node = task.nodes[i];
      for (TreeRef& child : node.child) child = moved(child, task);
      out.nodes[task.first_node + i] = node;
    }
    std::copy(task.ids.begin(), task.ids.end(),
              out.ids.begin() + static_cast<std::ptrdiff_t>(std::size_t{task.first_block} *
                                                            settings_.block_width));
    task.nodes = HugeVector<WideNode>();
    task.ids = std::vector<std::uint32_t>();
  }

  // The children of a wide node: the largest is opened as long as there is room.
  [[nodiscard]] std::vector<int> children_of(int index) const {
    std::vector<int> children{at(index).first, at(index).second};
    while (children.size() < WideNode::width) {
      int largest = -1;
      for (int i = 0; i < static_cast<int>(children.size()); ++i) {
        const TopNode& node = at(children[static_cast<std::size_t>(i)]);
        if (node.task >= 0) continue;
        if (largest < 0 ||
            node.box.half_area() > at(children[static_cast<std::size_t>(largest)]).box.half_area())
          largest = i;
      }
      if (largest < 0) break;
      const TopNode& opened = at(children[static_cast<std::size_t>(largest)]);
      children[static_cast<std::size_t>(largest)] = opened.first;
      children.push_back(opened.second);
    }
    return children;
  }

  [[nodiscard]] std::uint32_t count_top_nodes(int index) const {
    if (at(index).task >= 0) return 0;
    std::uint32_t count = 1;
    for (const int child : children_of(index)) count += count_top_nodes(child);
    return count;
  }

  TreeRef emit_top(int index, BuiltTree& out) {
    if (at(index).task >= 0) {
      const Task& task = tasks_[static_cast<std::size_t>(at(index).task)];
      return moved(task.root, task);
    }
    const std::uint32_t self = next_node_++;
    clear_children(out.nodes[self]);
    int place = 0;
    for (const int child : children_of(index)) {
      const TreeRef ref = emit_top(child, out);
      set_child(out.nodes[self], place++, at(child).box, ref);
    }
    return TreeRef::node(self);
  }

  [[nodiscard]] TopNode& at(int i) { return top_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] const TopNode& at(int i) const { return top_[static_cast<std::size_t>(i)]; }

  std::vector<BuildRef> refs_;
  const BuildSettings& settings_;
  ThreadPool& pool_;
  std::vector<TopNode> top_;
  std::vector<Task> tasks_;
  std::uint32_t next_node_ = 0;
  float root_area_ = 0;
};

}  // namespace

BuiltTree build_tree(std::vector<BuildRef> refs, const BuildSettings& settings, ThreadPool& pool) {
  return Builder(std::move(refs), settings, pool).run();
}

}  // namespace scenec::backend
