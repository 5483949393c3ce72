// Translates course text in memory and keeps what came of it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/source_map.hpp"
#include "frontend/course/translate.hpp"
#include "grammar/parse.hpp"

namespace scenec::test {

struct Translated {
  std::string text;
  std::vector<std::string> errors;    // "line:column text"
  std::vector<std::string> warnings;  // their codes, in order
  SourceMap sources;
  FileId file;
  FileId native;

  // The course text a piece of the native text came from.
  [[nodiscard]] std::string origin_of(std::string_view piece) const {
    const std::size_t at = text.find(piece);
    if (at == std::string::npos) return "(not in the text)";
    const auto begin = static_cast<std::uint32_t>(at);
    const Span span =
        sources.resolve({native, begin, begin + static_cast<std::uint32_t>(piece.size())});
    return std::string(sources.text(span));
  }
  [[nodiscard]] bool has(std::string_view piece) const {
    return text.find(piece) != std::string::npos;
  }
};

inline Translated translate_course(std::string_view course, MemoryFileSystem files = {},
                                   frontend::course::TranslateOptions options = {
                                       .scene_path = "scenes/scene.txt",
                                       .output_directory = "scenes",
                                       .method = {}}) {
  Translated result;
  result.file = result.sources.add("scene.txt", std::string(course));
  DiagnosticSink sink;
  const auto tree = grammar::parse_course(result.file, result.sources.text(result.file), sink);
  auto translation = frontend::course::translate(tree, options, files, sink);
  result.text = translation.text;
  result.native = result.sources.add_derived(result.file, std::move(translation.text),
                                             std::move(translation.ranges));
  (void)grammar::parse_sdl(result.native, result.sources.text(result.native), sink);
  for (const Diagnostic& diagnostic : sink.sorted()) {
    const DiagnosticKindInfo& info = info_of(diagnostic.kind);
    if (info.severity == Severity::warning) {
      result.warnings.emplace_back(info.code);
      continue;
    }
    const Span span = result.sources.resolve(diagnostic.span);
    const Position position = result.sources.position(span.file, span.begin);
    result.errors.push_back(std::to_string(position.line) + ":" + std::to_string(position.column) +
                            " " + std::string(info.code) + " " + diagnostic.message);
  }
  return result;
}

inline const std::string course_camera =
    "PerspectiveCamera { center 0 0 10 direction 0 0 -1 up 0 1 0 angle 30 width 200 height 100 }\n";

// A camera, one material and the objects given.
inline Translated translate_objects(std::string_view objects,
                                    std::string_view material = "diffuseColor 1 0 0",
                                    MemoryFileSystem files = {}) {
  return translate_course(course_camera + "Materials { numMaterials 1 Material { " +
                              std::string(material) + " } }\nGroup { " + std::string(objects) +
                              " }",
                          std::move(files));
}

}  // namespace scenec::test
