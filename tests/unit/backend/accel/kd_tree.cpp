#include "tests/unit/backend/accel/kd_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace scenec::test {
namespace {

using backend::Bounds3;
using backend::Point3;
using backend::Ray;
using backend::RayShear;
using backend::ShapeHit;
using backend::TriangleMesh;

constexpr std::uint32_t bin_count = 32;
constexpr double step_cost = 1;
constexpr double triangle_cost = 1.5;
constexpr double share_with_empty_side = 0.8;
constexpr std::size_t few_faces = 2;

double& side(Point3& p, std::uint32_t axis) {
  return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

// Nearer, or as near with a smaller number.
void ask(const TriangleMesh& mesh, const Ray& ray, const RayShear& shear, std::uint32_t face,
         ShapeHit& best, bool& found) {
  const backend::Triangle t = triangle_of(mesh, face);
  ShapeHit hit;
  if (!intersect_triangle(shear, t.a, t.b, t.c, ray.t_min, std::min(ray.t_max, best.t), hit))
    return;
  if (found && hit.t == best.t && face > best.part) return;
  best = hit;
  best.part = face;
  found = true;
}

struct Split {
  double cost = std::numeric_limits<double>::infinity();
  std::uint32_t axis = 0;
  double plane = 0;
};

}  // namespace

struct KdTree::Builder {
  KdTree& tree;
  std::vector<Bounds3> boxes;

  [[nodiscard]] Split best_split(const Bounds3& box,
                                 const std::vector<std::uint32_t>& faces) const {
    Split best;
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      const double low = component(box.min, static_cast<int>(axis));
      const double width = component(box.max, static_cast<int>(axis)) - low;
      if (!(width > 0)) continue;
      std::array<std::size_t, bin_count + 1> starts{};
      std::array<std::size_t, bin_count + 1> ends{};
      const auto bin_of = [&](double x) {
        return static_cast<std::size_t>(std::clamp((x - low) / width, 0.0, 1.0) * bin_count *
                                        (1 - 0x1p-40));
      };
      for (const std::uint32_t face : faces) {
        ++starts[bin_of(component(boxes[face].min, static_cast<int>(axis)))];
        ++ends[bin_of(component(boxes[face].max, static_cast<int>(axis)))];
      }
      std::size_t left = 0;
      std::size_t right = faces.size();
      for (std::uint32_t bin = 1; bin < bin_count; ++bin) {
        left += starts[bin - 1];
        right -= ends[bin - 1];
        const double plane = low + width * bin / bin_count;
        Bounds3 a = box;
        Bounds3 b = box;
        side(a.max, axis) = side(b.min, axis) = plane;
        const double share = left == 0 || right == 0 ? share_with_empty_side : 1;
        const double cost = step_cost + share * triangle_cost *
                                            (a.half_area() * static_cast<double>(left) +
                                             b.half_area() * static_cast<double>(right)) /
                                            box.half_area();
        if (cost < best.cost) best = {cost, axis, plane};
      }
    }
    return best;
  }

  void make(std::uint32_t index, const Bounds3& box, std::vector<std::uint32_t> faces, int levels) {
    const Split split = best_split(box, faces);
    const bool pays = split.cost < triangle_cost * static_cast<double>(faces.size());
    if (levels == 0 || faces.size() <= few_faces || !pays) {
      tree.nodes_[index] = {0, Node::leaf, static_cast<std::uint32_t>(tree.faces_.size()),
                            static_cast<std::uint32_t>(faces.size())};
      tree.faces_.insert(tree.faces_.end(), faces.begin(), faces.end());
      return;
    }
    std::vector<std::uint32_t> below;
    std::vector<std::uint32_t> above;
    for (const std::uint32_t face : faces) {
      if (component(boxes[face].min, static_cast<int>(split.axis)) <= split.plane)
        below.push_back(face);
      if (component(boxes[face].max, static_cast<int>(split.axis)) >= split.plane)
        above.push_back(face);
    }
    faces = {};
    const auto child = static_cast<std::uint32_t>(tree.nodes_.size());
    tree.nodes_[index] = {split.plane, split.axis, child, 0};
    tree.nodes_.resize(tree.nodes_.size() + 2);
    Bounds3 a = box;
    Bounds3 b = box;
    side(a.max, split.axis) = side(b.min, split.axis) = split.plane;
    make(child, a, std::move(below), levels - 1);
    make(child + 1, b, std::move(above), levels - 1);
  }
};

KdTree::KdTree(const TriangleMesh& mesh) : mesh_(mesh), bounds_(backend::bounds(mesh)) {
  Builder builder{*this, {}};
  std::vector<std::uint32_t> all;
  for (std::uint32_t i = 0; i < mesh.faces.size(); ++i) {
    builder.boxes.push_back(backend::bounds(triangle_of(mesh, i)));
    all.push_back(i);
  }
  nodes_.resize(1);
  const double size = static_cast<double>(std::max<std::size_t>(all.size(), 1));
  builder.make(0, bounds_, std::move(all), 8 + static_cast<int>(1.3 * std::log2(size)));
}

std::uint64_t KdTree::bytes() const {
  return nodes_.size() * sizeof(Node) + faces_.size() * sizeof(std::uint32_t);
}

bool KdTree::find(const Ray& ray, ShapeHit& hit) const {
  struct Wait {
    std::uint32_t node;
    double from;
    double to;
  };
  const RayShear shear(ray);
  const double slack = backend::gamma(4);
  std::array<Wait, 128> stack;
  std::size_t size = 0;
  stack[size++] = {0, ray.t_min, ray.t_max};
  hit = {};
  bool found = false;
  while (size > 0) {
    const Wait now = stack[--size];
    if (found && now.from > hit.t) continue;
    const Node& node = nodes_[now.node];
    if (node.axis == Node::leaf) {
      for (std::uint32_t i = 0; i < node.count; ++i)
        ask(mesh_, ray, shear, faces_[node.first + i], hit, found);
      continue;
    }
    const double origin = component(ray.origin, static_cast<int>(node.axis));
    const double direction = component(ray.direction, static_cast<int>(node.axis));
    const std::uint32_t near = node.first + (origin > node.plane ? 1 : 0);
    const std::uint32_t far = node.first + (origin > node.plane ? 0 : 1);
    if (origin == node.plane) {
      stack[size++] = {far, now.from, now.to};
      stack[size++] = {near, now.from, now.to};
      continue;
    }
    const double t = (node.plane - origin) / direction;
    const double margin = slack * std::fabs(t);
    if (!(t > 0) || t - margin > now.to) {
      stack[size++] = {near, now.from, now.to};
    } else if (t + margin < now.from) {
      stack[size++] = {far, now.from, now.to};
    } else {
      stack[size++] = {far, t - margin, now.to};
      stack[size++] = {near, now.from, t + margin};
    }
  }
  return found;
}

bool find_by_brute_force(const TriangleMesh& mesh, const Ray& ray, ShapeHit& hit) {
  const RayShear shear(ray);
  hit = {};
  bool found = false;
  for (std::uint32_t face = 0; face < mesh.faces.size(); ++face)
    ask(mesh, ray, shear, face, hit, found);
  return found;
}

}  // namespace scenec::test
