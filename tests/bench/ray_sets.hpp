// The rays that our traversal and another are compared on: made from a mesh, the same for both, in
// float, as everything else reads them.
#pragma once

#include <string>
#include <vector>

#include "backend/geometry/mesh.hpp"
#include "tests/bench/ray_dump.hpp"

namespace scenec::bench {

struct RaySetOptions {
  int resolution = 1024;
  bool interior = false;  // the camera stands inside and looks along the longer side
};

// primary: a ray for each pixel of a camera. diffuse: one cosine bounce for each hit, in order.
// shuffled: the bounces in random order. shadow: from each hit to a point of a square light, any
// hit. `hits` are left empty.
[[nodiscard]] std::vector<DumpSet> ray_sets_of(const backend::TriangleMesh& mesh,
                                               const RaySetOptions& options);

// Four triangles for each one, the new vertices lifted towards the tangent planes of the old ones
// (Boubekeur, Alexa 2008): a scan four times as fine.
[[nodiscard]] backend::TriangleMesh subdivided(const backend::TriangleMesh& mesh);

}  // namespace scenec::bench
