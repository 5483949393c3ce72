#include "tests/numerics/contracted.hpp"

#include <array>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>

// A namespace of its own, so that the linker cannot take these functions for the real ones.
#define backend backend_contracted
#include "backend/geometry/triangle.cpp"  // NOLINT(bugprone-suspicious-include)
#undef backend

namespace scenec::numerics {

bool can_contract() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("fma") != 0;
#else
  return false;
#endif
}

bool contracted_hit(const double* positions, const std::uint32_t (*faces)[3],
                    std::size_t face_count, const double* origin, const double* direction) {
  namespace fused = scenec::backend_contracted;
  const fused::Ray ray{{origin[0], origin[1], origin[2]},
                       {direction[0], direction[1], direction[2]}};
  const fused::RayShear shear(ray);
  const auto vertex = [&](std::uint32_t i) {
    const double* p = positions + 3 * std::size_t{i};
    return fused::Point3{p[0], p[1], p[2]};
  };
  fused::ShapeHit hit;
  for (std::size_t i = 0; i < face_count; ++i)
    if (fused::intersect_triangle(shear, vertex(faces[i][0]), vertex(faces[i][1]),
                                  vertex(faces[i][2]), ray.t_min, ray.t_max, hit))
      return true;
  return false;
}

}  // namespace scenec::numerics
