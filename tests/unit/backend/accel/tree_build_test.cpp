// The tree: complete, bounded in depth and size, the same for any pool (G26).
#include "backend/accel/tree_build.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "tests/unit/backend/geometry/random_rays.hpp"

namespace scenec::backend {
namespace {

using testing_support::Draw;

BuildRef ref(float x, float y, float z, float size, std::uint32_t id) {
  return {{x, y, z}, id, {x + size, y + size, z + size}, 0};
}

std::vector<BuildRef> random_refs(std::uint32_t count, std::uint64_t seed) {
  Draw draw(seed);
  std::vector<BuildRef> refs;
  const auto f = [&](double size) { return static_cast<float>(draw.between(-size, size)); };
  for (std::uint32_t i = 0; i < count; ++i)
    refs.push_back(ref(f(0.9), f(0.9), f(0.9), 0.01F * std::fabs(f(1)), i));
  return refs;
}

// Walks the tree and ticks off every number; every child lies within its parent's box.
class Inspection {
 public:
  Inspection(const BuiltTree& tree, std::vector<BuildRef> refs, std::uint32_t block_width)
      : tree_(tree), refs_(std::move(refs)), block_width_(block_width), seen_(refs_.size()) {
    std::sort(refs_.begin(), refs_.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
    const float low[3] = {-2, -2, -2};
    const float high[3] = {2, 2, 2};
    if (!tree.empty) visit(tree.root, low, high, 0);
  }
  int depth = 0;
  [[nodiscard]] bool each_once() const {
    return std::all_of(seen_.begin(), seen_.end(), [](int n) { return n == 1; });
  }

 private:
  void visit(TreeRef at, const float (&low)[3], const float (&high)[3], int level) {
    depth = std::max(depth, level);
    if (at.is_leaf()) return visit_leaf(at, low, high);
    const WideNode& node = tree_.nodes.at(at.node_index());
    for (int i = 0; i < WideNode::width; ++i) {
      if (!(node.bounds[0][i] <= node.bounds[1][i])) continue;
      float child_low[3];
      float child_high[3];
      for (int k = 0; k < 3; ++k) {
        child_low[k] = node.bounds[2 * k][i];
        child_high[k] = node.bounds[2 * k + 1][i];
        EXPECT_TRUE(child_low[k] >= low[k] && child_high[k] <= high[k]);
      }
      visit(node.child[i], child_low, child_high, level + 1);
    }
  }
  void visit_leaf(TreeRef at, const float (&low)[3], const float (&high)[3]) {
    for (std::uint32_t i = at.first() * block_width_; i < (at.first() + at.count()) * block_width_;
         ++i) {
      const std::uint32_t id = tree_.ids.at(i);
      if (id == BuiltTree::no_id) continue;
      ++seen_.at(id);
      for (int k = 0; k < 3; ++k)
        EXPECT_TRUE(refs_[id].min[k] >= low[k] && refs_[id].max[k] <= high[k]);
    }
  }

  const BuiltTree& tree_;
  std::vector<BuildRef> refs_;
  std::uint32_t block_width_;
  std::vector<int> seen_;
};

void expect_sound(const std::vector<BuildRef>& refs, std::uint32_t block_width, ThreadPool& pool) {
  std::vector<BuildRef> work = refs;
  const BuildSettings settings{block_width, 8, 1};
  const BuiltTree tree = build_tree(work, settings, pool);
  EXPECT_EQ(tree.empty, refs.empty());
  const Inspection inspection(tree, refs, block_width);
  EXPECT_TRUE(inspection.each_once());
  EXPECT_LE(tree.nodes.size(), refs.size());
  EXPECT_LE(inspection.depth, 96);
}

TEST(TreeBuild, HoldsEveryBoxOnce) {
  ThreadPool pool(2);
  for (const std::uint32_t width : {1U, 4U})
    for (const std::uint32_t count : {0U, 1U, 2U, 4U, 5U, 9U, 100U, 40000U})
      expect_sound(random_refs(count, 1), width, pool);
}

TEST(TreeBuild, SameTreeForAnyPool) {
  const std::vector<BuildRef> refs = random_refs(150000, 2);
  const auto built = [&](unsigned threads) {
    ThreadPool pool(threads);
    std::vector<BuildRef> work = refs;
    return build_tree(work, {4, 8, 1}, pool);
  };
  const BuiltTree reference = built(1);
  for (const unsigned threads : {2U, 7U}) {
    const BuiltTree other = built(threads);
    EXPECT_EQ(other.root, reference.root);
    EXPECT_EQ(other.ids, reference.ids);
    ASSERT_EQ(other.nodes.size(), reference.nodes.size());
    EXPECT_EQ(std::memcmp(other.nodes.data(), reference.nodes.data(),
                          other.nodes.size() * sizeof(WideNode)),
              0);
  }
}

TEST(TreeBuild, HostileInputs) {
  ThreadPool pool(2);
  constexpr std::uint32_t count = 100000;
  std::vector<BuildRef> equal;
  std::vector<BuildRef> nested;
  std::vector<BuildRef> line;
  std::vector<BuildRef> geometric;
  for (std::uint32_t i = 0; i < count; ++i) {
    equal.push_back({{0, 0, 0}, i, {1, 1, 0}, 0});
    const float x = static_cast<float>(i) / count;
    nested.push_back({{-x, -x, -x}, i, {x, x, x}, 0});
    line.push_back({{x, 0, 0}, i, {x, 0, 0}, 0});
    const float g = std::ldexp(1.0F, -static_cast<int>(i % 149));
    geometric.push_back({{g, 0, 0}, i, {g, 0, 0}, 0});
  }
  for (const auto* refs : {&equal, &nested, &line, &geometric}) {
    expect_sound(*refs, 4, pool);
    expect_sound(*refs, 1, pool);
  }
}

TEST(TreeBuild, FloatsRoundOutward) {
  EXPECT_LE(static_cast<double>(float_below(0.1)), 0.1);
  EXPECT_GE(static_cast<double>(float_above(0.1)), 0.1);
  EXPECT_EQ(float_below(0.5), 0.5F);
  EXPECT_EQ(float_above(-0.5), -0.5F);
  EXPECT_LT(float_below(-1e-60), 0.0F);
  EXPECT_GT(float_above(1e-60), 0.0F);
  // Subnormal planes are slow to multiply by: whatever stands on the ground would have one.
  EXPECT_TRUE(std::isnormal(float_below(std::nextafter(0.0, -1.0))));
  EXPECT_TRUE(std::isnormal(float_above(std::nextafter(0.0, 1.0))));
  EXPECT_EQ(float_below(1e-60), 0.0F);
  EXPECT_EQ(float_above(-1e-60), 0.0F);
}

}  // namespace
}  // namespace scenec::backend
