// Wavefront material libraries: the statements a renderer can use, as written. What they mean is
// for the caller; other statements are read over and counted.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "backend/assets/asset_problem.hpp"
#include "backend/assets/mesh_data.hpp"
#include "base/result.hpp"

namespace scenec::backend {

struct MtlMaterial {
  std::string name;
  std::uint64_t line = 0;                         // of `newmtl`
  std::optional<std::array<double, 3>> diffuse;   // Kd
  std::optional<std::array<double, 3>> specular;  // Ks
  std::optional<std::array<double, 3>> emission;  // Ke
  std::optional<std::array<double, 3>> ambient;   // Ka
  std::optional<double> shininess;                // Ns
  std::optional<double> ior;                      // Ni
  std::optional<double> opacity;                  // d, or 1 - Tr
  std::optional<int> illumination;                // illum
  // File names as written, options left out.
  std::string diffuse_map;  // map_Kd
  std::string opacity_map;  // map_d
  std::string bump_map;     // map_bump, map_Bump, bump
};

struct MtlLibrary {
  std::vector<MtlMaterial> materials;  // in file order; of two with one name the later counts
  IgnoredStatements ignored;
};

[[nodiscard]] Result<MtlLibrary, AssetProblem> read_mtl(std::string_view bytes,
                                                        const MeshLimits& limits = {});

}  // namespace scenec::backend
