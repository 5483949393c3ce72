#include "backend/accel/tree_build.hpp"

#include <algorithm>

#include "backend/accel/binary_build.hpp"
#include "base/assert.hpp"

namespace scenec::backend {
namespace {

// Runs up to this size are one task. Fixed, so that the tree does not depend on the pool.
constexpr std::size_t task_size = 16384;

// The upper part, built first; its leaves are tasks.
struct TopNode {
  FloatBox box;
  int first = -1;  // children, in the list of top nodes; -1: a task
  int second = -1;
  int task = -1;
};

struct Task {
  BuildRange range;
  TreeRef root;
  HugeVector<WideNode> nodes;
  std::vector<std::uint32_t> ids;
  std::uint32_t first_node = 0;
  std::uint32_t first_block = 0;
};

class Builder {
 public:
  Builder(std::span<BuildRef> refs, const BuildSettings& settings, ThreadPool& pool)
      : refs_(refs), settings_(settings), pool_(pool) {}

  BuiltTree run() {
    BuiltTree out;
    if (refs_.empty()) return out;
    out.empty = false;
    build_top(whole_range(refs_));
    pool_.for_each(tasks_.size(), [&](std::size_t i, unsigned) { build_task(tasks_[i]); });
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
  int build_top(const BuildRange& range) {
    const auto self = static_cast<int>(top_.size());
    top_.push_back({range.box});
    BuildRange left;
    BuildRange right;
    if (range.count <= task_size || !split_range(refs_, range, settings_, left, right)) {
      at(self).task = static_cast<int>(tasks_.size());
      tasks_.push_back({range, {}, {}, {}, 0, 0});
      return self;
    }
    const int first = build_top(left);
    const int second = build_top(right);
    at(self).first = first;
    at(self).second = second;
    return self;
  }

  void build_task(Task& task) const {
    const std::vector<BinaryNode> tree = build_binary(refs_, task.range, settings_);
    task.nodes.reserve(tree.size() / 8 + 1);
    task.ids.reserve(task.range.count + task.range.count / 2);
    task.root = collapse(tree, refs_, settings_, task.nodes, task.ids);
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
    task.nodes = {};
    task.ids = {};
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

  std::span<BuildRef> refs_;
  const BuildSettings& settings_;
  ThreadPool& pool_;
  std::vector<TopNode> top_;
  std::vector<Task> tasks_;
  std::uint32_t next_node_ = 0;
};

}  // namespace

BuiltTree build_tree(std::span<BuildRef> refs, const BuildSettings& settings, ThreadPool& pool) {
  return Builder(refs, settings, pool).run();
}

}  // namespace scenec::backend
