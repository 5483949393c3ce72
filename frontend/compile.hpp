// The one entrance of the front end: from a path to a validated scene. Every file is read through
// the FileSystem given (which may record), every mistake goes to the sink; nothing throws.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.hpp"
#include "base/file_system.hpp"
#include "base/source_map.hpp"
#include "grammar/parse.hpp"
#include "ir/scene.hpp"

namespace scenec::frontend {

// `-D name=value`: a constant expression of the parameter's type; for a string the raw text.
struct ParamSetting {
  std::string name;
  std::string value;
};

struct CompileOptions {
  std::optional<grammar::Dialect> dialect;  // none: by grammar::dialect_of
  std::vector<ParamSetting> params;
  std::optional<ir::Method> method;  // course only: replaces the method found by vocabulary
  bool library = false;              // accept a file of declarations alone
  std::uint64_t max_items = 2'000'000;
};

// A file with its text in the source map and its tree. For a course file `native` is the
// translation: a derived file whose spans resolve to the course text.
struct LoadedFile {
  grammar::Dialect dialect = grammar::Dialect::sdl;
  FileId file;
  grammar::SyntaxTree tree;                   // of the text as written
  std::optional<grammar::SyntaxTree> native;  // course files only
  [[nodiscard]] const grammar::SyntaxTree& native_tree() const { return native ? *native : tree; }
};

// `output_directory` decides how paths in a translated course file are written (relative to it):
// `convert` passes the directory it writes to, compilation the scene's own directory.
// nullopt: the file could not be read (reported).
[[nodiscard]] std::optional<LoadedFile> load(
    const std::string& path, const CompileOptions& options, FileSystem& files, SourceMap& sources,
    DiagnosticSink& sink, const std::optional<std::string>& output_directory = std::nullopt);

// nullopt when there was an error (reported). A scene with lints is a scene.
[[nodiscard]] std::optional<ir::Scene> compile(const std::string& path,
                                               const CompileOptions& options, FileSystem& files,
                                               SourceMap& sources, DiagnosticSink& sink);
[[nodiscard]] std::optional<ir::Scene> compile(const LoadedFile& file,
                                               const CompileOptions& options, FileSystem& files,
                                               SourceMap& sources, DiagnosticSink& sink);

// The native tree without punctuation and trivia, one construct a line: `dump --stage ast`.
[[nodiscard]] std::string dump_ast(const grammar::SyntaxTree& native);

}  // namespace scenec::frontend
