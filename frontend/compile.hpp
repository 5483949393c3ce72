// The one entrance of the front end: from a path to a validated scene. Every file is read through
// the FileSystem given (which may record), every mistake goes to the sink; nothing throws.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.hpp"
#include "base/file_system.hpp"
#include "base/limits.hpp"
#include "base/parallel.hpp"
#include "base/source_map.hpp"
#include "base/work_clock.hpp"
#include "grammar/parse.hpp"
#include "ir/scene.hpp"

namespace scenec::frontend {

// `-D name=value`, or an entry of a file of parameters: a constant expression of the parameter's
// type; for a string the raw text.
struct ParamSetting {
  std::string name;
  std::string value;
  bool is_text = true;        // false: only an expression, no text of a `string` param
  std::string quoted = {};    // a list for params that are lists of strings; empty: `value`
  std::string source = "-D";  // how messages name the place of `value`
  Span span = {};             // of the name, when it stands in a file
};

// One frame of a sequence: the `@clock` param is its low end plus number / per_second seconds.
struct Frame {
  std::int64_t number = 0;
  std::int64_t last = 0;  // of the sequence: a clock that ends before it is an error at once
  std::int64_t per_second = 24;
};

class FrontendCache;

// What a compilation spends its time on, beside reading files: the rest is evaluation.
struct CompileClocks {
  WorkClock parsing;   // waiting for what other threads parse ahead included
  WorkClock checking;  // of the whole scene, its lints and its hash
};

struct CompileOptions {
  std::optional<grammar::Dialect> dialect;  // none: by grammar::dialect_of
  std::vector<ParamSetting> params;         // of two with one name the later one counts
  std::optional<Frame> frame;               // none: the clock is its default
  std::optional<ir::Method> method;         // course only: replaces the method found by vocabulary
  bool library = false;                     // accept a file of declarations alone
  bool camera_chosen = false;               // the caller picks one of several cameras
  Limits limits;
  FrontendCache* cache = nullptr;  // what earlier compilations have read
  ThreadPool* pool = nullptr;      // parses large files; none: the calling thread does
  CompileClocks* clocks = nullptr;
  // A scene of this many bytes is read in parts of the size below, each forgotten when it has been
  // lowered. The scene and what is reported are the same either way.
  std::size_t read_in_parts = std::size_t{2} << 20;
  std::size_t part_bytes = std::size_t{64} << 10;  // whose tree fits into a core's cache
};

// A file with its text in the source map and its tree. A large one may have been left without a
// tree: `compile` then reads it in parts. For a course file `native` is the
// translation: a derived file whose spans resolve to the course text.
struct LoadedFile {
  grammar::Dialect dialect = grammar::Dialect::sdl;
  FileId file;
  grammar::SyntaxTree tree;  // of the text as written
  bool unparsed = false;     // `tree` is empty
  FileIdentity identity;
  std::optional<grammar::SyntaxTree> native;  // course files only
  [[nodiscard]] const grammar::SyntaxTree& native_tree() const { return native ? *native : tree; }
};

// `output_directory` decides how paths in a translated course file are written (relative to it):
// `convert` passes the directory it writes to, compilation the scene's own directory.
// nullopt: the file could not be read (reported).
enum class LoadTree : std::uint8_t { always, unless_large };
[[nodiscard]] std::optional<LoadedFile> load(
    const std::string& path, const CompileOptions& options, FileSystem& files, SourceMap& sources,
    DiagnosticSink& sink, const std::optional<std::string>& output_directory = std::nullopt,
    LoadTree load_tree = LoadTree::always);

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
