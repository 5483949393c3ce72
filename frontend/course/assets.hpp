// The files a course scene names: where they are looked for, how their paths are written, and what
// an OBJ with its MTL says about its material.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "frontend/course/context.hpp"
#include "frontend/course/writer.hpp"

namespace scenec::frontend::course {

// Tries the working directory, the scene's directory and its parent. Where there is no such file
// that is reported, and the first of these stands for it: what names the file is read on with.
[[nodiscard]] std::string find_asset(Context& context, std::string_view name, Span where);
// The path as a string literal, relative to the output directory.
[[nodiscard]] Text path_text(const Context& context, const std::string& path, Span origin);

// The material of an OBJ that most of its faces use.
struct ObjMaterial {
  std::array<double, 3> diffuse{1, 1, 1};   // Kd
  std::array<double, 3> specular{0, 0, 0};  // Ks
  double shininess = 0;                     // Ns
  std::optional<std::string> texture;       // map_Kd, where it was found
};
// nullopt: the OBJ names no material that could be read. Warns where it has several, and reports a
// missing texture.
[[nodiscard]] std::optional<ObjMaterial> read_obj_material(Context& context,
                                                           const std::string& obj_path, Span where);

}  // namespace scenec::frontend::course
