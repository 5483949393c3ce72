#include "frontend/compile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "base/text.hpp"
#include "frontend/check/check_scene.hpp"
#include "frontend/check/lint_scene.hpp"
#include "frontend/course/translate.hpp"
#include "frontend/dialect_check.hpp"
#include "frontend/frontend_cache.hpp"
#include "frontend/lower/lowering.hpp"
#include "frontend/part_reader.hpp"
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
      .method = options.method,
      .limits = options.limits};
  course::Translation translation = course::translate(loaded.tree, how, files, sink);
  const FileId file =
      sources.add_derived(loaded.file, std::move(translation.text), std::move(translation.ranges));
  const WorkClock::Running parsing(options.clocks != nullptr ? &options.clocks->parsing : nullptr);
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
                               const std::optional<std::string>& output_directory,
                               LoadTree load_tree) {
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
  loaded.identity = content.value().identity;
  const auto wrong =
      options.dialect ? std::nullopt : find_wrong_dialect(loaded.file, text, loaded.dialect);
  if (wrong) {
    sink.report(*wrong);
    DiagnosticSink consequences;
    loaded.dialect = grammar::Dialect::sdl;
    loaded.tree = grammar::parse_sdl(loaded.file, {}, consequences);
    return loaded;
  }
  if (loaded.dialect == grammar::Dialect::sdl) {
    loaded.unparsed = load_tree == LoadTree::unless_large && text.size() >= options.read_in_parts;
    if (loaded.unparsed) return loaded;
    loaded.tree = parsed_text(options, loaded.dialect, loaded.file, text, sink);
  } else {
    loaded.tree = parsed_text(options, loaded.dialect, loaded.file, text, sink);
    DiagnosticSink consequences;
    loaded.native = translated(loaded, path, options, files, sources,
                               is_cut_off(sink) ? consequences : sink, output_directory);
  }
  return loaded;
}

std::optional<ir::Scene> compile(const std::string& path, const CompileOptions& options,
                                 FileSystem& files, SourceMap& sources, DiagnosticSink& sink) {
  const auto loaded =
      load(path, options, files, sources, sink, std::nullopt, LoadTree::unless_large);
  if (!loaded) return std::nullopt;
  return compile(*loaded, options, files, sources, sink);
}

namespace {

struct SceneFile {
  FileId file;
  FileIdentity identity;
};

std::optional<ir::Scene> compile_trees(TreeSource& trees, const SceneFile& scene,
                                       const CompileOptions& options, FileSystem& files,
                                       SourceMap& sources, DiagnosticSink& sink) {
  Session session(options, files, sources, sink);
  Lowering lowering(session);
  // A construct that could not be read may have been the camera: rules between entities then say
  // nothing.
  const bool readable = !sink.has_errors();
  lowering.lower_scene(trees, scene.file, scene.identity);
  const WorkClock::Running checking(options.clocks != nullptr ? &options.clocks->checking
                                                              : nullptr);
  const bool complete = !session.out_of_steps() && session.item_count() <= options.limits.items;
  const auto end = static_cast<std::uint32_t>(sources.text(scene.file).size());
  if (readable && complete) check_scene(session, {scene.file, end, end}, lowering);
  if (sink.has_errors()) return std::nullopt;
  lint_scene(session);
  session.builder.set_render(lowering.render(), lowering.render_origin());
  return session.builder.finish();
}

// nullopt also when something is wrong that only the whole text can tell; then nothing was reported
// and `sources` is as it was.
std::optional<ir::Scene> compile_in_parts(const SceneFile& file, const CompileOptions& options,
                                          FileSystem& files, SourceMap& sources,
                                          DiagnosticSink& sink) {
  const std::size_t sources_before = sources.size();
  DiagnosticSink found;
  PartReader parts({.file = file.file,
                    .text = sources.text(file.file),
                    .part_bytes = options.part_bytes,
                    .found = found,
                    .parsing = options.clocks != nullptr ? &options.clocks->parsing : nullptr});
  std::optional<ir::Scene> scene;
  const auto read = [&] { scene = compile_trees(parts, file, options, files, sources, found); };
  if (options.pool != nullptr) {
    parts.run(*options.pool, read);
  } else {
    read();
  }
  if (!scene || parts.failed()) {
    sources.truncate(sources_before);
    return std::nullopt;
  }
  for (Diagnostic& lint : found.sorted()) sink.report(std::move(lint));
  return scene;
}

}  // namespace

std::optional<ir::Scene> compile(const LoadedFile& file, const CompileOptions& options,
                                 FileSystem& files, SourceMap& sources, DiagnosticSink& sink) {
  const SceneFile scene_file{
      file.native_tree().file().valid() ? file.native_tree().file() : file.file, file.identity};
  if (!file.unparsed) {
    WholeTree whole(file.native_tree());
    return compile_trees(whole, scene_file, options, files, sources, sink);
  }
  if (!sink.has_errors()) {
    if (auto scene = compile_in_parts(scene_file, options, files, sources, sink)) return scene;
  }
  const auto tree = parsed_text(options, file.dialect, file.file, sources.text(file.file), sink);
  WholeTree whole(tree);
  return compile_trees(whole, scene_file, options, files, sources, sink);
}

}  // namespace scenec::frontend
