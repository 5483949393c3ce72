// The flat faces of placed shapes in the space of their items, for the lints about surfaces that
// meet.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "ir/scene.hpp"

namespace scenec::frontend::flat {

using Vector = std::array<double, 3>;

inline Vector operator-(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Vector operator+(const Vector& a, const Vector& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Vector scaled(const Vector& v, double s) {
  return {v[0] * s, v[1] * s, v[2] * s};
}

// Which way a face looks, along its canonical normal.
enum class Facing : std::int8_t { back, front };

// A flat convex face with up to four corners; none: an unbounded plane. The normal points into the
// half-space of directions whose first component that is not zero is positive.
struct Face {
  Vector normal{};
  double offset = 0;
  std::array<Vector, 4> corners{};
  std::uint8_t corner_count = 0;
  Facing facing = Facing::front;
  std::uint32_t item = 0;
  double reach = 0;  // largest coordinate
  double low = 0;    // along the axis of the sweep
  double high = 0;
};

// Appends the faces of `items`: planes, quads, triangles, disks, boxes, caps of cylinders. Faces
// without area are left out.
void append_faces(const ir::Scene& scene, const std::vector<ir::Item>& items,
                  std::vector<Face>& faces);

}  // namespace scenec::frontend::flat
