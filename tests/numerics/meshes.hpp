// Closed meshes for the watertight cases, and rays aimed where they could leak.
#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

#include "backend/geometry/mesh.hpp"
#include "tests/unit/backend/geometry/random_rays.hpp"
#include "tests/unit/backend/geometry/test_meshes.hpp"

namespace scenec::numerics {

// An icosahedron cut `level` times into four, with small bumps: 20 * 4^level faces.
[[nodiscard]] backend::TriangleMesh icosphere(int level, double offset);

// From near the centre: of ten rays one at a vertex, one at an edge, eight anywhere.
class LeakRays {
 public:
  LeakRays(const backend::TriangleMesh& mesh, double offset, std::uint64_t seed)
      : mesh_(mesh), offset_(offset), draw_(seed) {}
  [[nodiscard]] backend::Ray next();
  [[nodiscard]] bool aimed() const { return count_ % 10 < 2; }  // the latest ray

 private:
  const backend::TriangleMesh& mesh_;
  double offset_;
  backend::testing_support::Draw draw_;
  std::uint64_t count_ = 9;
};

}  // namespace scenec::numerics
