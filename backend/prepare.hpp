// The parts of prepare(): assets to memory, one problem one diagnostic.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "backend/assets/mesh_data.hpp"
#include "backend/prepared_scene.hpp"
#include "base/diagnostic.hpp"

namespace scenec::backend {

// What is wrong with a mesh for the scene, in the order found.
struct MeshReport {
  std::optional<Diagnostic> error;
  std::vector<Diagnostic> warnings;
};

// The mesh an IR mesh asks for, from the data of its file. `where`: the place messages mark.
[[nodiscard]] TriangleMesh mesh_of_file(const ir::Mesh& mesh, const MeshData& data,
                                        const std::string& path, Span where, MeshReport& report);
[[nodiscard]] TriangleMesh mesh_of_lists(const ir::Mesh& mesh, Span where, MeshReport& report);

// One normal a vertex: the sum of the normals of its faces weighted by their angle there (Thuermer
// and Wuethrich 1998). Vertices at the same place count as one, so seams of texture coordinates
// stay smooth.
[[nodiscard]] std::vector<Normal3> smooth_normals_of(const std::vector<Point3>& positions,
                                                     const std::vector<Face>& faces);

// Nesting of instances over the limit, and emission that cannot be sampled.
void check_items(const ir::Scene& scene, DiagnosticSink& sink);

// Parts of the language this renderer does not carry out yet, each an error.
void check_supported(const ir::Scene& scene, DiagnosticSink& sink);

}  // namespace scenec::backend
