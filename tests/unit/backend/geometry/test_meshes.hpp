// Closed meshes made by formula.
#pragma once

#include <cmath>
#include <cstdint>

#include "backend/geometry/mesh.hpp"
#include "base/elementary.hpp"

namespace scenec::backend::testing_support {

// A sphere of n x n quads with bumps, each quad cut in two, around (offset, offset, offset);
// closed: poles and seam share their vertices.
inline TriangleMesh displaced_sphere(std::uint32_t n, double offset) {
  TriangleMesh mesh;
  const auto vertex = [&](double theta, double phi) {
    const double r = 1 + 0.2 * sin(5 * theta) * sin(3 * phi);
    return Point3{offset + r * sin(theta) * cos(phi), offset + r * cos(theta),
                  offset + r * sin(theta) * sin(phi)};
  };
  for (std::uint32_t i = 1; i < n; ++i)
    for (std::uint32_t j = 0; j < n; ++j)
      mesh.positions.push_back(vertex(pi * i / n, 2 * pi * j / n));
  const auto north = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.push_back(vertex(0, 0));
  mesh.positions.push_back(vertex(pi, 0));
  const auto at = [&](std::uint32_t i, std::uint32_t j) {
    return i == 0 ? north : i == n ? north + 1 : (i - 1) * n + j % n;
  };
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      if (i > 0) mesh.faces.push_back({at(i, j), at(i, j + 1), at(i + 1, j)});
      if (i + 1 < n) mesh.faces.push_back({at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)});
    }
  }
  return mesh;
}

}  // namespace scenec::backend::testing_support
