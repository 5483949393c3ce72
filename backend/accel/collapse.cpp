// From a binary tree to nodes of eight, at the least cost the binary tree allows.
#include <algorithm>
#include <array>

#include "backend/accel/binary_build.hpp"

namespace scenec::backend {
namespace {

constexpr int width = WideNode::width;

// cost[i]: of the subtree as at most i + 1 children of a node above it. choice[i]: how many of them
// go to the first child; 0: as with one child fewer; of choice[0]: whether to make a leaf.
struct Plan {
  std::array<float, width - 1> cost;
  std::array<std::uint8_t, width> choice;
};

class Collapse {
 public:
  Collapse(std::span<const BinaryNode> tree, std::span<const BuildRef> refs,
           const BuildSettings& settings, HugeVector<WideNode>& nodes,
           std::vector<std::uint32_t>& ids)
      : tree_(tree), refs_(refs), settings_(settings), nodes_(nodes), ids_(ids) {}

  TreeRef run() {
    plans_.resize(tree_.size());
    for (std::size_t i = tree_.size(); i-- > 0;) plan(i);
    return emit(0);
  }

 private:
  [[nodiscard]] std::uint32_t blocks_of(std::uint32_t count) const {
    return (count + settings_.block_width - 1) / settings_.block_width;
  }

  // The cheapest way to share `children` places between the two subtrees of a node.
  [[nodiscard]] float share(const Plan& a, const Plan& b, int children, std::uint8_t& first) const {
    float best = FloatBox::infinity;
    for (int k = 1; k < children; ++k) {
      const float cost = a.cost[static_cast<std::size_t>(k - 1)] +
                         b.cost[static_cast<std::size_t>(children - k - 1)];
      if (cost < best) {
        best = cost;
        first = static_cast<std::uint8_t>(k);
      }
    }
    return best;
  }

  void plan(std::size_t index) {
    const BinaryNode& node = tree_[index];
    Plan& p = plans_[index];
    p.choice = {};
    const float area = node.box.half_area();
    const std::uint32_t blocks = blocks_of(node.count);
    const float as_leaf = area * static_cast<float>(blocks);
    if (node.is_leaf()) {
      p.cost.fill(as_leaf);
      p.choice[0] = 1;
      return;
    }
    const Plan& a = plans_[index + 1];
    const Plan& b = plans_[node.second];
    const float as_node = share(a, b, width, p.choice[width - 1]) + area * settings_.node_cost;
    const bool leaf = blocks <= settings_.max_blocks && as_leaf <= as_node;
    p.cost[0] = leaf ? as_leaf : as_node;
    p.choice[0] = leaf ? 1 : 0;
    for (int children = 2; children < width; ++children) {
      const auto i = static_cast<std::size_t>(children - 1);
      std::uint8_t first = 0;
      p.cost[i] = share(a, b, children, first);
      if (p.cost[i] < p.cost[i - 1]) {
        p.choice[i] = first;
      } else {
        p.cost[i] = p.cost[i - 1];
      }
    }
  }

  struct Children {
    std::array<std::size_t, width> index;
    int count = 0;
  };

  void gather(std::size_t index, int places, Children& out) {
    const Plan& p = plans_[index];
    while (places > 1 && p.choice[static_cast<std::size_t>(places - 1)] == 0) --places;
    if (places == 1) {
      out.index[static_cast<std::size_t>(out.count++)] = index;
      return;
    }
    share_places(index, places, out);
  }
  void share_places(std::size_t index, int places, Children& out) {
    const int first = plans_[index].choice[static_cast<std::size_t>(places - 1)];
    gather(index + 1, first, out);
    gather(tree_[index].second, places - first, out);
  }

  TreeRef emit(std::size_t index) {
    const BinaryNode& node = tree_[index];
    if (plans_[index].choice[0] != 0) return emit_leaf(node);
    Children children;
    share_places(index, width, children);
    const std::size_t self = nodes_.size();
    nodes_.emplace_back();
    clear_children(nodes_[self]);
    for (int i = 0; i < children.count; ++i) {
      const std::size_t child = children.index[static_cast<std::size_t>(i)];
      const TreeRef ref = emit(child);
      set_child(nodes_[self], i, tree_[child].box, ref);
    }
    return TreeRef::node(static_cast<std::uint32_t>(self));
  }

  TreeRef emit_leaf(const BinaryNode& node) {
    const std::size_t start = ids_.size();
    for (std::uint32_t i = 0; i < node.count; ++i) ids_.push_back(refs_[node.first + i].id);
    if (settings_.splitter != nullptr) {  // a cut triangle may have come together again
      const auto begin = ids_.begin() + static_cast<std::ptrdiff_t>(start);
      std::sort(begin, ids_.end());
      ids_.erase(std::unique(begin, ids_.end()), ids_.end());
    }
    const std::uint32_t blocks = blocks_of(static_cast<std::uint32_t>(ids_.size() - start));
    const auto first = static_cast<std::uint32_t>(start / settings_.block_width);
    ids_.resize(std::size_t{first + blocks} * settings_.block_width, BuiltTree::no_id);
    return TreeRef::leaf(first, blocks);
  }

  std::span<const BinaryNode> tree_;
  std::span<const BuildRef> refs_;
  const BuildSettings& settings_;
  HugeVector<WideNode>& nodes_;
  std::vector<std::uint32_t>& ids_;
  std::vector<Plan> plans_;
};

}  // namespace

void set_child(WideNode& node, int place, const FloatBox& box, TreeRef child) {
  for (int k = 0; k < 3; ++k) {
    node.bounds[2 * k][place] = box.min[k];
    node.bounds[2 * k + 1][place] = box.max[k];
  }
  node.child[place] = child;
}

void clear_children(WideNode& node) {
  for (int i = 0; i < width; ++i) set_child(node, i, FloatBox{}, TreeRef::leaf(0, 1));
}

TreeRef collapse(std::span<const BinaryNode> tree, std::span<const BuildRef> refs,
                 const BuildSettings& settings, HugeVector<WideNode>& nodes,
                 std::vector<std::uint32_t>& ids) {
  return Collapse(tree, refs, settings, nodes, ids).run();
}

}  // namespace scenec::backend
