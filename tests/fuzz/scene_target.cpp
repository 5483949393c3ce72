// Scene texts through the whole front end and `check`: printed IR compiles to the same IR, and
// formatting keeps tokens, comments and the IR. Budgets are small, so that no input takes long.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "backend/backend.hpp"
#include "base/render_diagnostic.hpp"
#include "frontend/compile.hpp"
#include "ir/dump.hpp"
#include "runtime/diagnostic_formats.hpp"
#include "tests/fuzz/require.hpp"
#include "tests/fuzz/targets.hpp"
#include "tests/unit/frontend/format_support.hpp"

namespace scenec::fuzz {

namespace {

using grammar::Dialect;

constexpr std::uint64_t most_items = 500;
constexpr std::uint64_t most_steps = 300'000;

// Files that scenes may name: a mesh, its like in another format, and a picture that is none.
MemoryFileSystem files_with(const std::string& path, std::string text) {
  MemoryFileSystem files;
  files.put("tri.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n");
  files.put("tri.ply",
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
            "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
            "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  files.put("gray.pgm", "P2 2 2 255 0 80 160 240");
  files.put("broken.png", "\x89PNG\r\n\x1a\n");
  files.put(path, std::move(text));
  return files;
}

struct Run {
  std::optional<ir::Scene> scene;
  std::string messages;
  SourceMap sources;
};

void print(const DiagnosticSink& sink, Run& run) {
  std::vector<runtime::Finding> findings;
  for (const Diagnostic& diagnostic : sink.sorted()) {
    run.messages += render_terminal(diagnostic, run.sources, {});
    findings.push_back({diagnostic, info_of(diagnostic.kind).severity});
    require(runtime::json_line(findings.back(), run.sources).ends_with("}\n"), "a JSON line");
  }
  require(!runtime::sarif_log(findings, run.sources).empty(), "a SARIF log");
}

Run compile(FileSystem& files, const std::string& path, std::uint64_t allowance = 1) {
  Run run;
  DiagnosticSink sink;
  frontend::CompileOptions options;
  options.library = true;
  options.limits.items = most_items * allowance;
  options.limits.steps = most_steps * allowance;
  run.scene = frontend::compile(path, options, files, run.sources, sink);
  require(run.scene.has_value() != sink.has_errors(), "a scene or an error, never both");
  print(sink, run);
  return run;
}

std::string hash_of(const Run& run) {
  return run.scene ? run.scene->hash.hex() : "(no scene)";
}

// Assets and geometry: whatever the IR says, this ends, with or without diagnostics.
void prepare(Run& run, FileSystem& files) {
  static ThreadPool pool(1);
  DiagnosticSink sink;
  const backend::PreparedPtr prepared = backend::prepare(*run.scene, files, pool, sink);
  require((prepared != nullptr) != sink.has_errors(), "a prepared scene or an error");
  print(sink, run);
}

void require_same_ir_from_its_print(const Run& run, MemoryFileSystem& files) {
  const std::string printed = ir::dump_text(*run.scene, {});
  files.put("again.sdl", printed);
  const Run again = compile(files, "again.sdl", 1000);
  require(again.scene.has_value(), "printed IR compiles", printed + "\n" + again.messages);
  require(hash_of(again) == hash_of(run), "printed IR has the same hash", printed);
  require(ir::dump_text(*again.scene, {}) == printed, "printed IR prints the same", printed);
}

// `path` holds `text`; what it is formatted to takes its place.
void require_harmless_formatting(const std::string& path, const std::string& text, Dialect dialect,
                                 MemoryFileSystem& files, const std::string& hash) {
  const auto formatted = frontend::test::formatted(text, dialect);
  if (!formatted) return;
  const std::string problem = frontend::test::problem_of(text, dialect);
  require(problem.empty(), "formatting", problem);
  files.put(path, *formatted);
  const Run after = compile(files, path);
  require(hash_of(after) == hash, "formatting keeps the hash", *formatted + after.messages);
}

struct NamedText {
  std::string path;
  std::string text;
};

// The scene, then the files it may include.
std::vector<NamedText> split(std::string_view bytes) {
  constexpr std::string_view mark = "\n// file: ";
  std::vector<NamedText> files{{"scene.sdl", ""}};
  for (;;) {
    const std::size_t at = bytes.find(mark);
    files.back().text = bytes.substr(0, at);
    if (at == std::string_view::npos) return files;
    bytes.remove_prefix(at + mark.size());
    const std::size_t end = std::min(bytes.find('\n'), bytes.size());
    files.push_back({normalized_path(bytes.substr(0, end)), ""});
    bytes.remove_prefix(end);
  }
}

}  // namespace

void fuzz_native(std::string_view bytes) {
  const std::vector<NamedText> texts = split(bytes);
  MemoryFileSystem files = files_with(texts[0].path, texts[0].text);
  for (const NamedText& one : texts) {
    if (one.path != texts[0].path) files.put(one.path, one.text);
  }
  Run run = compile(files, texts[0].path);
  const bool draws = run.scene && !run.scene->cameras.empty();
  if (draws) {
    prepare(run, files);
    require_same_ir_from_its_print(run, files);
  }
  require_harmless_formatting(texts[0].path, texts[0].text, Dialect::sdl, files, hash_of(run));
}

void fuzz_course(std::string_view bytes) {
  const std::string path = "scene.txt";
  const std::string text(bytes);
  MemoryFileSystem files = files_with(path, text);
  const bool is_native = grammar::dialect_of(path, text) == Dialect::sdl;
  if (is_native) return;
  Run run = compile(files, path);
  if (run.scene) {
    prepare(run, files);
    require_same_ir_from_its_print(run, files);
  }
  require_harmless_formatting(path, text, Dialect::course, files, hash_of(run));
}

}  // namespace scenec::fuzz
