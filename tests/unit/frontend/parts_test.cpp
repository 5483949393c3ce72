// A scene read in parts is the scene read whole: the same hash, the same text, the same diagnostics
// at the same places, with one thread or several.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "base/render_diagnostic.hpp"
#include "frontend/compile.hpp"
#include "frontend/part_reader.hpp"
#include "ir/dump.hpp"
#include "tests/support/paths.hpp"
#include "tests/unit/frontend/compile_fixture.hpp"

namespace scenec::frontend::test {
namespace {

namespace fs = std::filesystem;

struct Outcome {
  std::string scene;  // empty: there is none
  std::string diagnostics;
  std::size_t files = 0;
  friend bool operator==(const Outcome&, const Outcome&) = default;
};
void PrintTo(const Outcome& outcome, std::ostream* out) {
  *out << outcome.scene << outcome.diagnostics << outcome.files << " files";
}

std::string origins_of(const ir::Scene& scene) {
  std::string text;
  for (const ir::Item& item : scene.items) {
    for (ir::OriginId at = item.origin; at.valid(); at = scene.origins[at].parent) {
      const Span span = scene.origins[at].span;
      text += fmt::format("{}:{}..{} ", span.file.value(), span.begin, span.end);
    }
    text += '\n';
  }
  return text;
}

Outcome outcome_of(const std::string& path, FileSystem& files, const CompileOptions& options) {
  SourceMap sources;
  DiagnosticSink sink;
  Outcome outcome;
  if (const auto scene = compile(path, options, files, sources, sink))
    outcome.scene = scene->hash.hex() + '\n' + ir::dump_text(*scene, {}) + origins_of(*scene);
  for (const Diagnostic& diagnostic : sink.sorted())
    outcome.diagnostics += render_terminal(diagnostic, sources, {});
  outcome.files = sources.size();
  return outcome;
}

CompileOptions whole_options() {
  CompileOptions options;
  options.library = true;
  return options;
}
CompileOptions part_options(std::size_t part_bytes, ThreadPool* pool = nullptr) {
  CompileOptions options = whole_options();
  options.read_in_parts = 0;
  options.part_bytes = part_bytes;
  options.pool = pool;
  return options;
}

std::vector<fs::path> scenes_beneath(const fs::path& folder) {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ".sdl") paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

TEST(Parts, every_scene_of_the_tree_reads_the_same) {
  ThreadPool pool(3);
  int scenes = 0, mistakes = 0;
  for (const char* const folder : {"tests", "stdlib-scenes"}) {
    for (const fs::path& path : scenes_beneath(scenec::test::source_directory() / folder)) {
      RealFileSystem files;
      const Outcome whole = outcome_of(path.string(), files, whole_options());
      EXPECT_EQ(outcome_of(path.string(), files, part_options(1)), whole) << path;
      EXPECT_EQ(outcome_of(path.string(), files, part_options(100, &pool)), whole) << path;
      ++(whole.scene.empty() ? mistakes : scenes);
    }
  }
  EXPECT_GE(scenes, 50);
  EXPECT_GE(mistakes, 100);
}

std::string many_spheres(int count) {
  std::string text =
      "sdl 1;\nmaterial red: diffuse { color = rgb(0.8, 0.1, 0.1); }\n" + camera + lit;
  for (int i = 0; i < count; ++i) {
    text += fmt::format("sphere {{ center = [{}, 1, {}mm]; radius = {}; material = red; }}\n",
                        i * 0.25, i, 1 + i % 7);
    if (i % 100 == 50)
      text += fmt::format("macro m{0}() {{ sphere {{ radius = {0}; }} }}\n", i + 1);
    if (i % 100 == 99) text += fmt::format("@allow(default_material) m{}();\n", i - 48);
  }
  return text;
}

TEST(Parts, names_and_bodies_hold_across_parts) {
  MemoryFileSystem files;
  files.put("scene.sdl", many_spheres(2000));
  const Outcome whole = outcome_of("scene.sdl", files, whole_options());
  ASSERT_FALSE(whole.scene.empty()) << whole.diagnostics;
  for (unsigned threads : {1u, 2u, 4u}) {
    ThreadPool pool(threads);
    EXPECT_EQ(outcome_of("scene.sdl", files, part_options(500, &pool)), whole) << threads;
  }
}

TEST(Parts, a_mistake_in_the_last_part_is_told_as_by_the_whole) {
  ThreadPool pool(2);
  for (const char* const mistake :
       {"sphere { radius = ; }", "}", "/* ", "sphere { radius = later; }\nlet later = 1;",
        "else { }", "sphere { material = rde; }", "include \"other.sdl\" as other;",
        "camera second: pinhole { eye = [0, 0, 1]; aim = [0, 0, 0]; fov = 40deg; }", "\x01"}) {
    MemoryFileSystem files;
    files.put("scene.sdl", many_spheres(500) + mistake);
    const Outcome whole = outcome_of("scene.sdl", files, whole_options());
    EXPECT_TRUE(whole.scene.empty()) << mistake;
    EXPECT_EQ(outcome_of("scene.sdl", files, part_options(400, &pool)), whole) << mistake;
  }
}

TEST(Parts, settings_and_limits_hold) {
  MemoryFileSystem files;
  files.put("scene.sdl", "sdl 1;\nparam n: int = 3 in 1 .. 9;\n" + camera + lit +
                             "for i in 0 ..< n { sphere { center = [i, 0, 0]; } }\n");
  for (const char* const value : {"5", "0", "x y"}) {
    CompileOptions whole = whole_options(), parts = part_options(1);
    whole.params = parts.params = {{.name = "n", .value = value}, {.name = "m", .value = "1"}};
    EXPECT_EQ(outcome_of("scene.sdl", files, parts), outcome_of("scene.sdl", files, whole));
  }
  CompileOptions whole = whole_options(), parts = part_options(1);
  whole.limits.items = parts.limits.items = 2;
  EXPECT_EQ(outcome_of("scene.sdl", files, parts), outcome_of("scene.sdl", files, whole));
}

TEST(Parts, a_part_is_forgotten_when_the_next_is_asked_for) {
  const std::string text = "sdl 1; let a = 1; fn f(): num = a; let b = 2;";
  DiagnosticSink found;
  PartReader reader({.file = FileId(0), .text = text, .part_bytes = 1, .found = found});
  int trees = 0;
  const grammar::SyntaxTree* kept = nullptr;
  while (const grammar::SyntaxTree* tree = reader.next()) {
    if (++trees == 3) {
      kept = tree;
      reader.keep();
    }
  }
  EXPECT_EQ(trees, 4);
  EXPECT_FALSE(reader.failed());
  EXPECT_EQ((*kept->root().children().begin()).kind(), grammar::SyntaxKind::fn);
}

}  // namespace
}  // namespace scenec::frontend::test
