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

// All faces of the file as an IR mesh asks for them (its `part` left aside). `where`: the place
// messages mark. The second form takes the positions and indices of `data` over; its names and parts
// stay.
[[nodiscard]] TriangleMesh mesh_of_file(const ir::Mesh& mesh, const MeshData& data,
                                        const std::string& path, Span where, MeshReport& report);
[[nodiscard]] TriangleMesh mesh_of_file(const ir::Mesh& mesh, MeshData&& data,
                                        const std::string& path, Span where, MeshReport& report);
// What is wrong with the file itself, whatever is taken of it.
void report_file(const MeshData& data, const std::string& path, Span where, MeshReport& report);

// The faces of `whole` that `part` names (see `part` of a mesh), with the vertices they use; `data`
// is what `whole` was made of. Positions are those of the file to the bit, and normals were
// computed over all faces: parts of one file fit together.
class MeshPartTaker {
 public:
  MeshPartTaker(const MeshData& data, const std::string& path) : data_(data), path_(path) {}
  [[nodiscard]] TriangleMesh take(const TriangleMesh& whole, const std::string& part, Span where,
                                  MeshReport& report);

 private:
  [[nodiscard]] std::optional<std::vector<std::uint32_t>> find_faces(const std::string& part) const;
  void report_unknown(const std::string& part, Span where, MeshReport& report) const;

  const MeshData& data_;
  const std::string& path_;
  std::vector<std::uint32_t> renumbered_;  // no_index between calls
};

// The warning about a mesh, or a part of one, that shows nothing.
[[nodiscard]] Diagnostic without_faces(const std::string& name, Span where);

[[nodiscard]] TriangleMesh mesh_of_lists(const ir::Mesh& mesh, Span where, MeshReport& report);

// One normal a vertex: the sum of the normals of its faces weighted by their angle there (Thuermer
// and Wuethrich 1998). Vertices at the same place count as one, so seams of texture coordinates
// stay smooth.
[[nodiscard]] std::vector<Normal3> smooth_normals_of(const std::vector<Point3>& positions,
                                                     const std::vector<Face>& faces);

// Nesting of instances over the limit, and emission that cannot be sampled.
void check_items(const ir::Scene& scene, DiagnosticSink& sink);

}  // namespace scenec::backend
