// Recorded rays for our kernels, and whether two tracers found the same hits.
#pragma once

#include <cstddef>
#include <vector>

#include "backend/geometry/kernel.hpp"
#include "tests/bench/ray_dump.hpp"

namespace scenec::bench {

[[nodiscard]] backend::Ray ray_of(const DumpRay& ray);

struct HitComparison {
  std::size_t mismatches = 0;
  std::size_t ties = 0;  // another triangle at the same distance, as far as floats can tell
};
// `ours` against the hits recorded in `set`; prints the first `list` mismatches beside the answer
// in long double.
[[nodiscard]] HitComparison compare_hits(const DumpSet& set, const std::vector<DumpHit>& ours,
                                         const backend::TriangleMesh& mesh, int list);

}  // namespace scenec::bench
