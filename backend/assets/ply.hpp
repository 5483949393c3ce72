// PLY meshes: ascii and binary in both byte orders; vertex positions, normals and texture
// coordinates of any numeric type, polygon faces; other elements and properties are skipped.
// Nothing is allocated for a count that the remaining bytes cannot hold.
#pragma once

#include <string_view>

#include "backend/assets/mesh_data.hpp"
#include "base/asset_problem.hpp"
#include "base/result.hpp"

namespace scenec::backend {

[[nodiscard]] Result<MeshData, AssetProblem> read_ply(std::string_view bytes,
                                                      const MeshLimits& limits = {});

}  // namespace scenec::backend
