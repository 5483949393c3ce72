#include "backend/accel/mesh_accel.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "backend/accel/chunks.hpp"
#include "backend/accel/quick_mesh.hpp"
#include "backend/accel/tree_build.hpp"

namespace scenec::backend {
namespace {

// Measured: between 0.5 and 2.5 rays take the same time, and larger leaves take less memory.
constexpr float node_cost = 1.5F;

struct FloatPoint {
  float x, y, z;
};

FloatPoint rounded(const Point3& p) {
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}
Point3 widened(const FloatPoint& p) {
  return {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)};
}

Bounds3 bounds_of_positions(const TriangleMesh& mesh, ThreadPool& pool) {
  std::vector<Bounds3> parts(chunks_of(mesh.faces.size()));
  for_chunks(pool, mesh.faces.size(), [&](std::size_t first, std::size_t last) {
    Bounds3 b;
    for (std::size_t f = first; f < last; ++f) {
      const Bounds3 face = bounds(triangle_of(mesh, static_cast<std::uint32_t>(f)));
      if (face.finite()) b.grow(face);
    }
    parts[first / chunk_size] = b;
  });
  Bounds3 all;
  for (const Bounds3& b : parts) all.grow(b);
  return all;
}

// How a mesh fares when its vertices become floats.
enum class Snap : std::uint8_t { exact, moves, spoils };

class Snapping {
 public:
  Snapping(const TriangleMesh& mesh, const TreeSpace& space, ThreadPool& pool)
      : mesh_(mesh), space_(space), pool_(pool), points_(mesh.positions.size()) {}

  Snap run() {
    std::atomic<bool> moved{false};
    for_chunks(pool_, points_.size(), [&](std::size_t first, std::size_t last) {
      bool any = false;
      for (std::size_t i = first; i < last; ++i) {
        const Point3 local = space_.to_local(mesh_.positions[i]);
        points_[i] = rounded(local);
        any = any ||
              (is_finite(local) && !(space_.to_world(widened(points_[i])) == mesh_.positions[i]));
      }
      if (any) moved = true;
    });
    if (!moved) return Snap::exact;
    std::atomic<bool> spoiled{false};
    for_chunks(pool_, mesh_.faces.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t f = first; f < last && !spoiled; ++f)
        if (spoils(mesh_.faces[f])) spoiled = true;
    });
    return spoiled ? Snap::spoils : Snap::moves;
  }

  [[nodiscard]] const std::vector<FloatPoint>& points() const { return points_; }

  [[nodiscard]] std::shared_ptr<const TriangleMesh> moved_mesh() const {
    auto mesh = std::make_shared<TriangleMesh>(mesh_);
    for (std::size_t i = 0; i < points_.size(); ++i)
      mesh->positions[i] = space_.to_world(widened(points_[i]));
    return mesh;
  }

 private:
  [[nodiscard]] bool spoils(const Face& f) const {
    const auto normal = [](const Point3& a, const Point3& b, const Point3& c) {
      return cross(b - a, c - a);
    };
    const auto local = [&](std::size_t corner) {
      return space_.to_local(mesh_.positions[f[corner]]);
    };
    const auto snapped = [&](std::size_t corner) { return widened(points_[f[corner]]); };
    const Vector3 before = normal(local(0), local(1), local(2));
    const Vector3 after = normal(snapped(0), snapped(1), snapped(2));
    // A face without area has nothing to lose.
    return is_finite(before) && !(before == Vector3{}) && !(dot(before, after) > 0);
  }

  const TriangleMesh& mesh_;
  const TreeSpace& space_;
  ThreadPool& pool_;
  std::vector<FloatPoint> points_;
};

// Where the vertices of a face lie in tree space.
struct FloatVertices {
  const std::vector<FloatPoint>& points;
  [[nodiscard]] FloatPoint operator()(std::uint32_t index) const { return points[index]; }
};
struct DoubleVertices {
  const TriangleMesh& mesh;
  const TreeSpace& space;
  [[nodiscard]] Point3 operator()(std::uint32_t index) const {
    return space.to_local(mesh.positions[index]);
  }
};

template <class P>
BuildRef ref_of(const P& a, const P& b, const P& c, std::uint32_t id) {
  const auto low = [](auto x, auto y, auto z) {
    return float_below(static_cast<double>(std::min({x, y, z})));
  };
  const auto high = [](auto x, auto y, auto z) {
    return float_above(static_cast<double>(std::max({x, y, z})));
  };
  return {{low(a.x, b.x, c.x), low(a.y, b.y, c.y), low(a.z, b.z, c.z)},
          id,
          {high(a.x, b.x, c.x), high(a.y, b.y, c.y), high(a.z, b.z, c.z)},
          0};
}

template <class Vertices>
std::vector<BuildRef> refs_of(const TriangleMesh& mesh, const Vertices& vertices,
                              ThreadPool& pool) {
  std::vector<BuildRef> refs(mesh.faces.size());
  std::atomic<bool> some_bad{false};
  const auto bad = [](const BuildRef& r) {
    return !(std::isfinite(r.min[0] + r.min[1] + r.min[2]) &&
             std::isfinite(r.max[0] + r.max[1] + r.max[2]));
  };
  for_chunks(pool, refs.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const Face& f = mesh.faces[i];
      refs[i] =
          ref_of(vertices(f[0]), vertices(f[1]), vertices(f[2]), static_cast<std::uint32_t>(i));
      const Triangle t = triangle_of(mesh, static_cast<std::uint32_t>(i));
      if (bad(refs[i]) || !(is_finite(t.a) && is_finite(t.b) && is_finite(t.c))) {
        refs[i].id = BuiltTree::no_id;
        some_bad = true;
      }
    }
  });
  if (some_bad) std::erase_if(refs, [](const BuildRef& r) { return r.id == BuiltTree::no_id; });
  return refs;
}

template <class T, class P>
void set_triangle(TriangleBlock<T>& block, std::size_t place, const P& a, const P& b, const P& c) {
  const P* corner[3] = {&a, &b, &c};
  for (std::size_t v = 0; v < 3; ++v) {
    block.vertex[v][0][place] = corner[v]->x;
    block.vertex[v][1][place] = corner[v]->y;
    block.vertex[v][2][place] = corner[v]->z;
  }
}

template <class T, class Vertices>
void fill_blocks(const TriangleMesh& mesh, const std::vector<std::uint32_t>& ids,
                 const Vertices& vertices, ThreadPool& pool, HugeVector<TriangleBlock<T>>& blocks) {
  constexpr std::size_t width = TriangleBlock<T>::width;
  blocks.resize(ids.size() / width);
  for_chunks(pool, blocks.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      TriangleBlock<T>& block = blocks[i];
      const Face& full = mesh.faces[ids[i * width]];
      for (std::size_t k = 0; k < width; ++k) {
        const std::uint32_t id = ids[i * width + k];
        block.face[k] = id;
        // A place without a triangle is a point.
        const Face& f = id == BuiltTree::no_id ? Face{full[0], full[0], full[0]} : mesh.faces[id];
        set_triangle(block, k, vertices(f[0]), vertices(f[1]), vertices(f[2]));
      }
    }
  });
}

// Cuts triangles; what is cut is computed in double and rounded outward.
template <class Vertices>
class TriangleSplitter final : public RefSplitter {
 public:
  TriangleSplitter(const TriangleMesh& mesh, const Vertices& vertices)
      : mesh_(mesh), vertices_(vertices) {}

  void split(const BuildRef& ref, int axis, float plane, BuildRef& low,
             BuildRef& high) const override {
    low = high = ref;
    Part below;
    Part above;
    const Face& f = mesh_.faces[ref.id];
    const auto k = static_cast<std::size_t>(axis);
    const double at = static_cast<double>(plane);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::array<double, 3> p = corner(f[i]);
      const std::array<double, 3> q = corner(f[(i + 1) % 3]);
      if (p[k] <= at) below.grow(p);
      if (p[k] >= at) above.grow(p);
      if ((p[k] < at && q[k] > at) || (p[k] > at && q[k] < at)) {
        const double s = (at - p[k]) / (q[k] - p[k]);
        const std::array<double, 3> cut{p[0] + s * (q[0] - p[0]), p[1] + s * (q[1] - p[1]),
                                        p[2] + s * (q[2] - p[2])};
        below.grow(cut);
        above.grow(cut);
      }
    }
    below.limit(low);
    above.limit(high);
    low.max[axis] = std::min(ref.max[axis], plane);
    high.min[axis] = std::max(ref.min[axis], plane);
  }

 private:
  // Of coordinates up to 1, with room for the rounding of a cut.
  static constexpr double rounding = 0x1p-50;

  struct Part {
    std::array<double, 3> min{2, 2, 2};
    std::array<double, 3> max{-2, -2, -2};
    void grow(const std::array<double, 3>& p) {
      for (std::size_t k = 0; k < 3; ++k) {
        min[k] = std::min(min[k], p[k]);
        max[k] = std::max(max[k], p[k]);
      }
    }
    // What was there already is never left.
    void limit(BuildRef& ref) const {
      for (std::size_t k = 0; k < 3; ++k) {
        const float low = std::max(ref.min[k], float_below(min[k] - rounding));
        const float high = std::min(ref.max[k], float_above(max[k] + rounding));
        if (low > high) continue;
        ref.min[k] = low;
        ref.max[k] = high;
      }
    }
  };

  [[nodiscard]] std::array<double, 3> corner(std::uint32_t index) const {
    const auto p = vertices_(index);
    return {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)};
  }

  const TriangleMesh& mesh_;
  const Vertices& vertices_;
};

// How much time a tree is worth.
enum class Effort : std::uint8_t { full, quick };

// A mesh as it is traced, and its tree.
struct Traced {
  std::shared_ptr<const TriangleMesh> mesh;
  MeshTree mesh_tree{};
  bool is_final = true;
};

template <class T, class Vertices>
void build_mesh_tree(const Vertices& vertices, ThreadPool& pool, Effort effort, Traced& out,
                     HugeVector<TriangleBlock<T>>& blocks) {
  const TriangleMesh& mesh = *out.mesh;
  BuildSettings settings;
  settings.block_width = TriangleBlock<T>::width;
  settings.node_cost = node_cost;
  const TriangleSplitter<Vertices> splitter(mesh, vertices);
  settings.splitter = &splitter;
  settings.splits = effort == Effort::full ? Splits::where_they_pay : Splits::never;
  BuiltTree built = build_tree(refs_of(mesh, vertices, pool), settings, pool);
  out.is_final = !built.splits_would_pay;
  WideTree& tree = out.mesh_tree.tree;
  tree.root = built.root;
  tree.empty = built.empty;
  tree.nodes = std::move(built.nodes);
  fill_blocks(mesh, built.ids, vertices, pool, blocks);
}

Traced traced(std::shared_ptr<const TriangleMesh> mesh, ThreadPool& pool, Precision precision,
              Effort effort) {
  Traced out{.mesh = std::move(mesh)};
  WideTree& tree = out.mesh_tree.tree;
  tree.space = space_of(bounds_of_positions(*out.mesh, pool));
  std::optional<Snapping> snapping;
  Snap snap = Snap::spoils;
  if (precision == Precision::mixed) snap = snapping.emplace(*out.mesh, tree.space, pool).run();
  if (snap == Snap::moves) out.mesh = snapping->moved_mesh();
  if (snap != Snap::spoils) {
    build_mesh_tree(FloatVertices{snapping->points()}, pool, effort, out, out.mesh_tree.blocks);
  } else {
    build_mesh_tree(DoubleVertices{*out.mesh, tree.space}, pool, effort, out,
                    out.mesh_tree.full_blocks);
  }
  tree.bounds = bounds_of_positions(*out.mesh, pool);
  return out;
}

}  // namespace

std::size_t MeshTree::bytes() const {
  return tree.nodes.size() * sizeof(WideNode) + blocks.size() * sizeof(TriangleBlock<float>) +
         full_blocks.size() * sizeof(TriangleBlock<double>);
}

MeshAccel::MeshAccel(std::shared_ptr<const TriangleMesh> mesh, ThreadPool& pool,
                     Precision precision) {
  Traced made = traced(std::move(mesh), pool, precision, Effort::full);
  mesh_ = std::move(made.mesh);
  tree_ = std::move(made.mesh_tree);
}

QuickMesh build_quickly(std::shared_ptr<const TriangleMesh> mesh, ThreadPool& pool,
                        Precision precision) {
  Traced made = traced(std::move(mesh), pool, precision, Effort::quick);
  return {std::make_shared<const MeshAccel>(std::move(made.mesh), std::move(made.mesh_tree)),
          made.is_final};
}

}  // namespace scenec::backend
