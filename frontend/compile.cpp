#include "frontend/compile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "base/text.hpp"
#include "frontend/check/check_scene.hpp"
#include "frontend/course/translate.hpp"
#include "frontend/lower/lowering.hpp"
#include "frontend/session.hpp"

namespace scenec::frontend {

namespace {

// Course text as native text, in a file whose places lead back to what the author wrote.
grammar::SyntaxTree translated(const LoadedFile& loaded, const std::string& path,
                               const CompileOptions& options, FileSystem& files, SourceMap& sources,
                               DiagnosticSink& sink,
                               const std::optional<std::string>& output_directory) {
  const course::TranslateOptions how{
      .scene_path = path,
      .output_directory = output_directory.value_or(directory_of(path)),
      .method = options.method};
  course::Translation translation = course::translate(loaded.tree, how, files, sink);
  const FileId file =
      sources.add_derived(loaded.file, std::move(translation.text), std::move(translation.ranges));
  return grammar::parse_sdl(file, sources.text(file), sink);
}

// Where the text itself could not be read to its end, what seems missing in it is a consequence.
bool is_cut_off(const DiagnosticSink& sink) {
  const std::vector<Diagnostic> found = sink.sorted();
  return std::any_of(found.begin(), found.end(), [](const Diagnostic& diagnostic) {
    return info_of(diagnostic.kind).is_limit() ||
           diagnostic.kind == DiagnosticKind::control_character ||
           diagnostic.kind == DiagnosticKind::text_not_utf8;
  });
}

}  // namespace

std::optional<LoadedFile> load(const std::string& path, const CompileOptions& options,
                               FileSystem& files, SourceMap& sources, DiagnosticSink& sink,
                               const std::optional<std::string>& output_directory) {
  const grammar::ParseLimits limits;
  auto content = files.read(path, limits.file);
  if (!content) {
    sink.report(Diagnostic(
        DiagnosticKind::file_unreadable, {},
        fmt::format("cannot read {}: {}", quoted_string(path), text_of(content.error()))));
    return std::nullopt;
  }
  const std::string_view text = content.value().bytes;
  LoadedFile loaded;
  loaded.dialect = options.dialect.value_or(grammar::dialect_of(path, text));
  loaded.file = sources.add(path, text, content.value().owner);
  if (loaded.dialect == grammar::Dialect::sdl) {
    loaded.tree = grammar::parse_sdl(loaded.file, text, sink);
  } else {
    loaded.tree = grammar::parse_course(loaded.file, text, sink);
    DiagnosticSink consequences;
    loaded.native = translated(loaded, path, options, files, sources,
                               is_cut_off(sink) ? consequences : sink, output_directory);
  }
  return loaded;
}

std::optional<ir::Scene> compile(const std::string& path, const CompileOptions& options,
                                 FileSystem& files, SourceMap& sources, DiagnosticSink& sink) {
  const auto loaded = load(path, options, files, sources, sink);
  if (!loaded) return std::nullopt;
  return compile(*loaded, options, files, sources, sink);
}

std::optional<ir::Scene> compile(const LoadedFile& file, const CompileOptions& options,
                                 FileSystem& files, SourceMap& sources, DiagnosticSink& sink) {
  const grammar::SyntaxTree& tree = file.native_tree();
  Session session(options, files, sources, sink);
  Lowering lowering(session);
  // A construct that could not be read may have been the camera: rules between entities then say
  // nothing.
  const bool readable = !sink.has_errors();
  lowering.lower_scene(tree);
  check_doc_comments(session, tree);
  const bool complete = !session.out_of_steps() && session.item_count() <= options.max_items;
  if (readable && complete) check_scene(session, tree, lowering);
  if (sink.has_errors()) return std::nullopt;
  session.builder.set_render(lowering.render(), lowering.render_origin());
  return session.builder.finish();
}

}  // namespace scenec::frontend
