// What an OBJ with its MTL libraries says about the materials of its faces.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "frontend/course/context.hpp"

namespace scenec::frontend::course {

struct ObjMaterial {
  std::array<double, 3> diffuse{1, 1, 1};   // Kd
  std::array<double, 3> specular{0, 0, 0};  // Ks
  std::array<double, 3> emission{0, 0, 0};  // Ke
  double shininess = 0;                     // Ns
  std::optional<std::string> texture;       // map_Kd, where it was found
  [[nodiscard]] bool glows() const { return emission != std::array<double, 3>{}; }
};

// The faces behind one name of `usemtl`, wherever they stand in the file.
struct ObjPart {
  std::string name;  // empty: the faces before the first `usemtl`
  // nullopt: no library has it, or the faces name none.
  std::optional<ObjMaterial> material;
};

// Parts with at least one face, in the order of their first; empty when the file cannot be read,
// which is reported where the mesh is. Reports a broken library, and a texture or a material that
// is not there.
[[nodiscard]] std::vector<ObjPart> read_obj_parts(Context& context, const std::string& obj_path,
                                                  Span where);

}  // namespace scenec::frontend::course
