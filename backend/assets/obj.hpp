// Wavefront OBJ, polygons only: v vt vn f g o usemtl. Points, lines, smoothing groups and what
// else the format knows are read over. Indices may be negative, and may name
// vertices that come later in the file. Wrong numbers and indices are errors with their line.
#pragma once

#include <string_view>

#include "backend/assets/mesh_data.hpp"
#include "base/asset_problem.hpp"
#include "base/result.hpp"

namespace scenec::backend {

[[nodiscard]] Result<MeshData, AssetProblem> read_obj(std::string_view bytes,
                                                      const MeshLimits& limits = {});

}  // namespace scenec::backend
