// A surface of revolution as triangles, for `solver = .tessellated`.
//
// Domain:     at least 3 steps round the axis.
// Method:     rings of `steps` vertices on the surface; along a curved segment as many rings as
// keep
//             its chords as near to the curve as those round the axis; a ring on the axis is one
//             vertex. Normals are those of the surface, one set a segment, so kinks stay sharp.
// Error:      no point farther from the surface than `chord_bound`.
// Degenerate: triangles without area are left out; where the profile crosses the axis it gets a
//             ring there.
// Proof:      tests/numerics/revolve_cases.cpp (R18).
#pragma once

#include <cstdint>

#include "backend/geometry/mesh.hpp"
#include "backend/geometry/revolve.hpp"

namespace scenec::backend {

[[nodiscard]] TriangleMesh tessellate(const Revolve& revolve, std::uint32_t steps);
// How many triangles that makes, those left out included; saturates.
[[nodiscard]] std::uint64_t tessellated_face_count(const Revolve& revolve, std::uint32_t steps);
// The largest distance between the surface and its triangles.
[[nodiscard]] double chord_bound(const Revolve& revolve, std::uint32_t steps);

}  // namespace scenec::backend
