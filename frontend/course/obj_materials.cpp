#include "frontend/course/obj_materials.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "base/text.hpp"
#include "base/text_scan.hpp"
#include "frontend/course/mtl.hpp"

namespace scenec::frontend::course {

namespace {

constexpr std::uint64_t mtl_size_limit = std::uint64_t{16} << 20;

struct ObjSummary {
  std::vector<std::string> libraries;  // as written, without repeats
  std::vector<std::string> parts;      // those with faces
};

// `mtllib a.mtl b.mtl` names two files, `mtllib my scene.mtl` one.
void add_libraries(WordCursor cursor, std::vector<std::string>& libraries) {
  const std::string_view all = cursor.rest();
  std::vector<std::string_view> names;
  bool each_is_mtl = true;
  while (!cursor.at_end()) {
    names.push_back(cursor.word());
    each_is_mtl = each_is_mtl && names.back().ends_with(".mtl");
  }
  if (!each_is_mtl) names = {all};
  for (const std::string_view name : names) {
    if (!name.empty() && std::ranges::find(libraries, name) == libraries.end())
      libraries.emplace_back(name);
  }
}

// The mesh reader examines the file; here only what names a material is looked at.
ObjSummary summary_of(std::string_view bytes, std::size_t longest_line) {
  ObjSummary summary;
  std::unordered_map<std::string, bool> has_faces;
  std::string name;
  bool* current = &has_faces[name];
  LineScanner scanner(bytes, longest_line, LineScanner::Continuation::backslash);
  std::string_view line;
  while (scanner.next(line)) {
    WordCursor cursor(line);
    const std::string_view keyword = cursor.word();
    if (keyword == "mtllib") {
      add_libraries(cursor, summary.libraries);
    } else if (keyword == "usemtl") {
      name = cursor.rest();
      current = &has_faces[name];
    } else if (keyword == "f" && !*current) {
      *current = true;
      summary.parts.push_back(name);
    }
  }
  return summary;
}

class PartReader {
 public:
  PartReader(Context& context, const std::string& obj_path, Span where)
      : context_(context), directory_(directory_of(obj_path)), where_(where) {}

  void read_library(const std::string& name) {
    const std::string path = joined_path(directory_, name);
    const auto content = context_.files.read(path, mtl_size_limit);
    tried_.push_back(path);
    if (!content) return;
    auto library = read_mtl(content.value().bytes, context_.options.limits.line_bytes);
    if (!library) {
      context_.error(DiagnosticKind::mesh_broken, where_,
                     fmt::format("{}:{}: {}", path, library.error().line, library.error().message));
      broken_ = true;
      return;
    }
    // Of two materials with one name the later one of the first library counts.
    std::unordered_map<std::string, ObjMaterial> found;
    for (const MtlMaterial& material : library.value())
      found.insert_or_assign(material.name, material_of(material));
    materials_.merge(found);
  }

  ObjPart part(const std::string& name) {
    ObjPart part{name, std::nullopt};
    const auto found = materials_.find(name);
    if (found != materials_.end()) {
      part.material = found->second;
      find_texture(*part.material);
    } else if (!name.empty() && !broken_) {
      missing_.push_back(name);
    }
    return part;
  }

  void report_missing() {
    if (missing_.empty()) return;
    Diagnostic diagnostic(
        DiagnosticKind::course_mtl_missing, where_,
        fmt::format("no MTL file has the material{} {}; the faces take the material in force",
                    missing_.size() == 1 ? "" : "s", quoted_list(missing_)));
    diagnostic.notes.push_back({tried_.empty() ? "the mesh names no MTL file (`mtllib`)"
                                               : "looked in " + quoted_list(tried_),
                                {}});
    context_.sink.report(std::move(diagnostic));
  }

 private:
  static std::string quoted_list(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names)
      text += fmt::format("{}`{}`", text.empty() ? "" : ", ", printable(name));
    return text;
  }

  static ObjMaterial material_of(const MtlMaterial& source) {
    ObjMaterial material;
    if (source.diffuse) material.diffuse = *source.diffuse;
    if (source.specular) material.specular = *source.specular;
    if (source.emission) material.emission = *source.emission;
    if (source.shininess) material.shininess = *source.shininess;
    if (!source.diffuse_map.empty()) material.texture = source.diffuse_map;
    return material;
  }

  void find_texture(ObjMaterial& material) {
    if (!material.texture) return;
    std::string path = joined_path(directory_, *material.texture);
    if (context_.files.is_file(path)) {
      material.texture = std::move(path);
      return;
    }
    context_.error(DiagnosticKind::course_missing_file, where_,
                   fmt::format("there is no file `{}`, a texture of this mesh", printable(path)));
    material.texture.reset();
  }

  Context& context_;
  std::string directory_;
  Span where_;
  std::unordered_map<std::string, ObjMaterial> materials_;
  std::vector<std::string> tried_;
  std::vector<std::string> missing_;
  bool broken_ = false;
};

}  // namespace

std::vector<ObjPart> read_obj_parts(Context& context, const std::string& obj_path, Span where) {
  const auto obj = context.files.read(obj_path, context.options.limits.mesh_bytes);
  if (!obj) return {};
  const ObjSummary summary = summary_of(obj.value().bytes, context.options.limits.line_bytes);
  PartReader reader(context, obj_path, where);
  for (const std::string& library : summary.libraries) reader.read_library(library);
  std::vector<ObjPart> parts;
  for (const std::string& name : summary.parts) parts.push_back(reader.part(name));
  reader.report_missing();
  return parts;
}

}  // namespace scenec::frontend::course
