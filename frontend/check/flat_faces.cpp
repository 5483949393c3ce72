#include "frontend/check/flat_faces.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <variant>

namespace scenec::frontend::flat {

namespace {

class Faces {
 public:
  explicit Faces(const ir::Transform& transform, std::uint32_t item, std::vector<Face>& out)
      : transform_(transform), item_(item), out_(out) {}

  // Corners counter-clockwise round the outward normal.
  void add(std::span<const Vector> corners) {
    Face face;
    face.item = item_;
    for (const Vector& corner : corners) {
      const ir::Point3 p = ir::apply(transform_, {corner[0], corner[1], corner[2]});
      face.corners[face.corner_count++] = {p.x, p.y, p.z};
      face.reach = std::max({face.reach, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
    }
    Vector normal = cross(face.corners[1] - face.corners[0], face.corners[2] - face.corners[0]);
    const bool mirrored = ir::determinant(transform_) < 0;
    finish(face, mirrored ? scaled(normal, -1) : normal);
  }
  void add_plane(const Vector& normal, double offset) {
    // Through three points, so that the transform moves them as any others.
    const Vector axis = std::fabs(normal[0]) < 0.6 ? Vector{1, 0, 0} : Vector{0, 1, 0};
    const Vector unit = scaled(normal, 1 / std::sqrt(dot(normal, normal)));
    const Vector u = cross(unit, axis), v = cross(unit, u), middle = scaled(unit, offset);
    const std::array<Vector, 3> corners{middle, middle + u, middle + v};
    add(corners);
    if (!out_.empty() && out_.back().item == item_) out_.back().corner_count = 0;
  }

 private:
  void finish(Face& face, const Vector& normal) {
    const double length = std::sqrt(dot(normal, normal));
    if (!(length > 0) || !std::isfinite(length)) return;
    face.normal = scaled(normal, 1 / length);
    // Nearly zero components must not decide the half-space.
    constexpr double nearly_zero = 0x1p-40;
    for (double component : face.normal) {
      if (std::fabs(component) <= nearly_zero) continue;
      face.facing = component < 0 ? Facing::back : Facing::front;
      if (component < 0) face.normal = scaled(face.normal, -1);
      break;
    }
    face.offset = dot(face.normal, face.corners[0]);
    out_.push_back(face);
  }

  ir::Transform transform_;
  std::uint32_t item_;
  std::vector<Face>& out_;
};

void add_faces(const ir::Plane& plane, Faces& faces) {
  faces.add_plane({plane.normal.x, plane.normal.y, plane.normal.z}, plane.offset.value);
}
void add_faces(const ir::Quad& quad, Faces& faces) {
  const Vector c{quad.corner.x, quad.corner.y, quad.corner.z};
  const Vector u{quad.edge_u.x, quad.edge_u.y, quad.edge_u.z};
  const Vector v{quad.edge_v.x, quad.edge_v.y, quad.edge_v.z};
  faces.add(std::array{c, c + u, c + u + v, c + v});
}
void add_faces(const ir::Triangle& triangle, Faces& faces) {
  std::array<Vector, 3> corners{};
  for (std::size_t i = 0; i < 3; ++i)
    corners[i] = {triangle.vertices[i].x, triangle.vertices[i].y, triangle.vertices[i].z};
  faces.add(corners);
}
// The square inside the disk: what overlaps it overlaps the disk.
void add_round(const Vector& center, const Vector& normal, double radius, Faces& faces) {
  const Vector axis = std::fabs(normal[0]) < 0.6 ? Vector{1, 0, 0} : Vector{0, 1, 0};
  const Vector unit = scaled(normal, 1 / std::sqrt(dot(normal, normal)));
  const Vector side = cross(unit, axis);
  const Vector u = scaled(side, radius / std::sqrt(dot(side, side)));
  const Vector v = cross(unit, u);
  faces.add(std::array{center + u, center + v, center - u, center - v});
}
void add_faces(const ir::Disk& disk, Faces& faces) {
  add_round({disk.center.x, disk.center.y, disk.center.z},
            {disk.normal.x, disk.normal.y, disk.normal.z}, disk.radius.value, faces);
}
void add_faces(const ir::Cylinder& cylinder, Faces& faces) {
  if (!cylinder.capped) return;
  const Vector base{cylinder.base.x, cylinder.base.y, cylinder.base.z};
  const Vector top{cylinder.top.x, cylinder.top.y, cylinder.top.z};
  Vector axis = top - base;
  const double largest = std::max({std::fabs(axis[0]), std::fabs(axis[1]), std::fabs(axis[2])});
  axis = scaled(axis, 1 / largest);
  add_round(top, axis, cylinder.radius.value, faces);
  add_round(base, scaled(axis, -1), cylinder.radius.value, faces);
}
void add_faces(const ir::Box& box, Faces& faces) {
  const std::array<Vector, 2> ends{
      {{box.min.x, box.min.y, box.min.z}, {box.max.x, box.max.y, box.max.z}}};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (std::size_t side = 0; side < 2; ++side) {
      std::array<Vector, 4> corners{};
      for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t turn = side == 1 ? i : 3 - i;
        corners[i][axis] = ends[side][axis];
        corners[i][u] = ends[turn == 1 || turn == 2 ? 1 : 0][u];
        corners[i][v] = ends[turn >= 2 ? 1 : 0][v];
      }
      faces.add(corners);
    }
  }
}
template <class T>
void add_faces(const T&, Faces&) {}

}  // namespace

void append_faces(const ir::Scene& scene, const std::vector<ir::Item>& items,
                  std::vector<Face>& faces) {
  for (std::uint32_t i = 0; i < items.size(); ++i) {
    if (std::holds_alternative<Id<ir::Sphere>>(items[i].shape)) continue;
    Faces into(scene.transforms[items[i].transform], i, faces);
    std::visit([&](auto id) { add_faces(scene.shape(id), into); }, items[i].shape);
  }
}

}  // namespace scenec::frontend::flat
