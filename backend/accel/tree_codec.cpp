#include "backend/accel/tree_codec.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "base/packed_bytes.hpp"

namespace scenec::backend {
namespace {

// Raise it when trees are built or laid out differently.
constexpr std::uint64_t codec_version = 1;
// The walk's stack holds trees this deep.
constexpr std::uint8_t most_levels = 100;

struct Head {
  std::array<double, 3> center{};
  double scale = 1;
  std::array<double, 6> bounds{};
  std::uint64_t faces = 0;
  std::uint64_t moved_positions = 0;  // 0: those of the mesh
  std::uint64_t nodes = 0;
  std::uint64_t blocks = 0;
  std::uint64_t full_blocks = 0;
  std::uint32_t root = 0;
  std::uint32_t empty = 0;
};
static_assert(sizeof(Head) == 128);

Head head_of(const MeshAccel& accel, bool moved) {
  const MeshTree& tree = accel.tree();
  const TreeSpace& space = tree.tree.space;
  const Bounds3& b = tree.tree.bounds;
  return {.center = {space.center.x, space.center.y, space.center.z},
          .scale = space.scale,
          .bounds = {b.min.x, b.min.y, b.min.z, b.max.x, b.max.y, b.max.z},
          .faces = accel.mesh().faces.size(),
          .moved_positions = moved ? accel.mesh().positions.size() : 0,
          .nodes = tree.tree.nodes.size(),
          .blocks = tree.blocks.size(),
          .full_blocks = tree.full_blocks.size(),
          .root = tree.tree.empty ? 0 : tree.tree.root.bits(),
          .empty = tree.tree.empty ? 1U : 0U};
}

bool all_finite(const std::vector<Point3>& points) {
  return std::ranges::all_of(points, [](const Point3& p) { return is_finite(p); });
}

// Whether a reference made while at node `from` leads to a later node or to blocks that exist.
// Later: then no walk goes in circles. (Of the root `from` is -1.)
bool leads_on(TreeRef ref, std::int64_t from, const MeshTree& tree) {
  const std::uint64_t blocks = tree.full() ? tree.full_blocks.size() : tree.blocks.size();
  if (ref.is_leaf()) return std::uint64_t{ref.first()} + ref.count() <= blocks;
  return ref == TreeRef::node(ref.node_index()) &&
         static_cast<std::int64_t>(ref.node_index()) > from &&
         ref.node_index() < tree.tree.nodes.size();
}

bool nodes_are_sound(const MeshTree& tree) {
  if (tree.tree.empty) return true;
  if (!leads_on(tree.tree.root, -1, tree)) return false;
  const auto& nodes = tree.tree.nodes;
  std::vector<std::uint8_t> level(nodes.size(), 0);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (const TreeRef child : nodes[i].child) {
      // Places without a child hold a reference too: to the first block.
      if (!leads_on(child, static_cast<std::int64_t>(i), tree)) return false;
      if (child.is_leaf()) continue;
      std::uint8_t& below = level[child.node_index()];
      below = std::max<std::uint8_t>(below, static_cast<std::uint8_t>(level[i] + 1));
      if (below >= most_levels) return false;
    }
  }
  return true;
}

// Places without a face must be points, which no ray hits.
template <class T>
bool blocks_are_sound(const HugeVector<TriangleBlock<T>>& blocks, std::uint64_t faces) {
  for (const TriangleBlock<T>& block : blocks) {
    for (std::size_t k = 0; k < TriangleBlock<T>::width; ++k) {
      if (block.face[k] < faces) continue;
      if (block.face[k] != TriangleBlock<T>::no_face) return false;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const T value = block.vertex[0][axis][k];
        if (!(block.vertex[1][axis][k] == value && block.vertex[2][axis][k] == value)) return false;
      }
    }
  }
  return true;
}

}  // namespace

Hash128 tree_key(const Hash128& mesh, Precision precision) {
  Hasher hasher;
  hasher.add(std::string_view("scenec-tree"));
  hasher.add(codec_version);
  hasher.add(mesh);
  hasher.add(static_cast<std::uint64_t>(precision));
  return hasher.result();
}

EncodedTree::EncodedTree(const MeshAccel& accel, const TriangleMesh& built_from) {
  const bool moved = &accel.mesh() != &built_from;
  append_packed(head_, head_of(accel, moved));
  pieces_.emplace_back(head_);
  if (moved) pieces_.push_back(packed_bytes_of(accel.mesh().positions));
  pieces_.push_back(packed_bytes_of(accel.tree().tree.nodes));
  pieces_.push_back(packed_bytes_of(accel.tree().blocks));
  pieces_.push_back(packed_bytes_of(accel.tree().full_blocks));
}

std::shared_ptr<const MeshAccel> decode_tree(std::string_view bytes,
                                             std::shared_ptr<const TriangleMesh> mesh) {
  PackedReader reader(bytes);
  const Head head = reader.value<Head>();
  const bool moved = head.moved_positions != 0;
  if (!reader.ok() || head.faces != mesh->faces.size() || head.empty > 1 ||
      (moved && head.moved_positions != mesh->positions.size())) {
    return nullptr;
  }
  if (moved) {
    auto placed = std::make_shared<TriangleMesh>(*mesh);
    placed->positions = reader.list<std::vector<Point3>>(head.moved_positions);
    if (!all_finite(placed->positions)) return nullptr;
    mesh = std::move(placed);
  }
  MeshTree tree;
  tree.tree.space = {{head.center[0], head.center[1], head.center[2]}, head.scale};
  tree.tree.bounds = {{head.bounds[0], head.bounds[1], head.bounds[2]},
                      {head.bounds[3], head.bounds[4], head.bounds[5]}};
  tree.tree.root = TreeRef::from_bits(head.root);
  tree.tree.empty = head.empty != 0;
  tree.tree.nodes = reader.list<HugeVector<WideNode>>(head.nodes);
  tree.blocks = reader.list<HugeVector<TriangleBlock<float>>>(head.blocks);
  tree.full_blocks = reader.list<HugeVector<TriangleBlock<double>>>(head.full_blocks);
  if (!reader.at_end() || !nodes_are_sound(tree) || !blocks_are_sound(tree.blocks, head.faces) ||
      !blocks_are_sound(tree.full_blocks, head.faces)) {
    return nullptr;
  }
  return std::make_shared<const MeshAccel>(std::move(mesh), std::move(tree));
}

}  // namespace scenec::backend
