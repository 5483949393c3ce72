// Building with spatial splits: a triangle that a plane cuts may be referred to from both sides, so
// that long thin triangles stop blowing up the boxes of everything near them.
//
// Method:     Stich, Friedrich, Dietrich 2009, with reference unsplitting; the number of extra
//             references is bounded and shared out in proportion to the sides' counts, so the tree
//             does not depend on the order of the work.
#pragma once

#include <vector>

#include "backend/accel/binary_build.hpp"

namespace scenec::backend {

struct SpatialRange {
  std::vector<BuildRef> refs;
  std::size_t extra = 0;  // references that may still be added
  int depth = 0;
};

// The boxes of the two parts of a reference, cut at `plane`.
struct RefHalves {
  BuildRef low;
  BuildRef high;
};

// Splits the list in two; false when it is to be a leaf.
bool split_spatially(SpatialRange& range, const BuildSettings& settings, float root_area,
                     SpatialRange& left, SpatialRange& right);

// The tree below a list; `refs` receives the references in the order of its leaves.
[[nodiscard]] std::vector<BinaryNode> build_binary_spatially(SpatialRange range,
                                                             const BuildSettings& settings,
                                                             float root_area,
                                                             std::vector<BuildRef>& refs);

[[nodiscard]] FloatBox box_of(const std::vector<BuildRef>& refs);

}  // namespace scenec::backend
