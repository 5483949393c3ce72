// Included files: each read and parsed once, cycles told with their chain, limits with their
// option; and the cache that keeps trees from one compilation to the next.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>

#include "frontend/frontend_cache.hpp"
#include "ir/dump.hpp"
#include "tests/support/paths.hpp"
#include "tests/unit/base/temporary_directory.hpp"
#include "tests/unit/frontend/compile_fixture.hpp"

namespace scenec::frontend::test {
namespace {

// What is parsed is read before: reads bound parses, and the cache counts these.
class CountingFileSystem final : public FileSystem {
 public:
  explicit CountingFileSystem(FileSystem& inner) : inner_(inner) {}
  Result<FileContent, FileError> read(const std::string& path, std::uint64_t limit) override {
    ++reads[path];
    return inner_.read(path, limit);
  }
  bool is_file(const std::string& path) override { return inner_.is_file(path); }
  std::map<std::string, int> reads;

 private:
  FileSystem& inner_;
};

MemoryFileSystem diamond(int levels) {
  MemoryFileSystem files;
  files.put("level0.sdl", "sdl 1;\nlet value = 1;\n");
  for (int i = 1; i < levels; ++i) {
    files.put(fmt::format("level{}.sdl", i),
              fmt::format("sdl 1;\ninclude \"level{0}.sdl\" as a;\ninclude \"level{0}.sdl\" as b;\n"
                          "let value = a.value + b.value;\n",
                          i - 1));
  }
  files.put("scene.sdl",
            fmt::format("sdl 1;\ninclude \"level{0}.sdl\" as a;\ninclude \"level{0}.sdl\" as b;\n"
                        "material clay: diffuse {{ color = gray(0.5); }}\n"
                        "sphere {{ radius = a.value + b.value; material = clay; }}\n",
                        levels - 1) +
                camera + lit);
  return files;
}

TEST(Includes, a_diamond_is_parsed_once_a_file) {
  MemoryFileSystem memory = diamond(30);
  CountingFileSystem files(memory);
  FrontendCache cache;
  CompileOptions options;
  options.cache = &cache;
  SourceMap sources;
  DiagnosticSink sink;
  const auto begin = std::chrono::steady_clock::now();
  const auto scene = compile("scene.sdl", options, files, sources, sink);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  ASSERT_TRUE(scene);
  EXPECT_EQ(scene->table<ir::Sphere>()[Id<ir::Sphere>(0)].radius.value, 1 << 30);
  EXPECT_EQ(cache.counters().files_parsed, 31u);
  EXPECT_EQ(cache.counters().files_reused, 0u);
  EXPECT_EQ(files.reads.size(), 31u);
  for (const auto& [path, reads] : files.reads) EXPECT_EQ(reads, 1) << path;
  EXPECT_LT(seconds.count(), 0.1 * 20) << "twenty times what it may take on a quiet machine";
}

TEST(Includes, a_cycle_is_told_once_with_its_chain) {
  Compiler compiler;
  compiler.files.put("a.sdl", "sdl 1;\ninclude \"b.sdl\" as b;\n");
  compiler.files.put("b.sdl", "sdl 1;\ninclude \"c.sdl\" as c;\n");
  compiler.files.put("c.sdl", "sdl 1;\ninclude \"a.sdl\" as a;\n");
  const Compiled result =
      compiler(scene_with("include \"a.sdl\" as a;\ninclude \"b.sdl\" as b;\n"));
  EXPECT_EQ(result.codes, "E0244");
  EXPECT_EQ(result.messages, "\"a.sdl\" includes itself\n");
  EXPECT_NE(result.rendered.find("\"a.sdl\" includes \"b.sdl\" here"), std::string::npos);
  EXPECT_NE(result.rendered.find("\"b.sdl\" includes \"c.sdl\" here"), std::string::npos);
}

TEST(Includes, the_scene_itself_can_close_a_cycle) {
  Compiler compiler;
  compiler.files.put("a.sdl", "sdl 1;\ninclude \"scene.sdl\" as scene;\n");
  const Compiled result = compiler(scene_with("include \"a.sdl\" as a;\n"));
  EXPECT_EQ(result.codes, "E0244");
  EXPECT_EQ(result.messages, "\"scene.sdl\" includes itself\n");
}

TEST(Includes, a_link_does_not_hide_a_cycle) {
  const scenec::test::TemporaryDirectory folder;
  folder.write("a.sdl", "sdl 1;\ninclude \"alias.sdl\" as alias;\n");
  std::filesystem::create_symlink("a.sdl", folder / "alias.sdl");
  const std::string scene = folder.write("scene.sdl", scene_with("include \"a.sdl\" as a;\n"));
  RealFileSystem files;
  SourceMap sources;
  DiagnosticSink sink;
  EXPECT_FALSE(compile(scene, {}, files, sources, sink));
  EXPECT_EQ(codes_of(sink), "E0244");
  const Diagnostic found = sink.sorted()[0];
  ASSERT_EQ(found.notes.size(), 2u);  // and where the file with the cycle is included
  EXPECT_NE(found.notes[0].text.find("alias.sdl\" is the same file"), std::string::npos);
}

TEST(Includes, limits_name_their_options) {
  const auto hint = [](const CompileOptions& options) {
    MemoryFileSystem files = diamond(6);
    SourceMap sources;
    DiagnosticSink sink;
    EXPECT_FALSE(compile("scene.sdl", options, files, sources, sink));
    EXPECT_TRUE(sink.only_limits());
    const auto found = sink.sorted();
    return found.size() == 1 && found[0].hints.size() == 1
               ? found[0].message + "; " + found[0].hints[0]
               : messages_of(sink);
  };
  CompileOptions depth, count, bytes;
  depth.limits.include_depth = 4;
  count.limits.include_files = 3;
  bytes.limits.source_bytes = 300;
  EXPECT_EQ(hint(depth), "includes are nested deeper than 4; `--max-include-depth` sets the limit");
  EXPECT_EQ(hint(count), "there are more than 3 included files; `--max-includes` sets the limit");
  EXPECT_EQ(
      hint(bytes),
      "the scene and what it includes have more than 300 bytes; `--max-source` sets the limit");
  MemoryFileSystem files = diamond(6);
  SourceMap sources;
  DiagnosticSink sink;
  depth.limits.include_depth = 6;
  EXPECT_TRUE(compile("scene.sdl", depth, files, sources, sink)) << messages_of(sink);
}

// ---- from one compilation to the next

struct Watched {
  MemoryFileSystem files;
  FrontendCache cache;

  struct Result {
    std::string hash;
    std::string dump;
    std::string codes;
    std::string rendered;
    std::uint64_t parsed = 0;
    std::uint64_t reused = 0;
    std::vector<std::string> read;
  };
  Result compile_again() {
    const FrontendCache::Counters before = cache.counters();
    CompileOptions options;
    options.cache = &cache;
    RecordingFileSystem recording(files);
    SourceMap sources;
    DiagnosticSink sink;
    Result result;
    if (const auto scene = compile("scene.sdl", options, recording, sources, sink)) {
      result.hash = scene->hash.hex();
      result.dump = ir::dump_text(*scene, {});
    }
    result.codes = codes_of(sink);
    for (const Diagnostic& diagnostic : sink.sorted())
      result.rendered += render_terminal(diagnostic, sources, {});
    result.parsed = cache.counters().files_parsed - before.files_parsed;
    result.reused = cache.counters().files_reused - before.files_reused;
    for (const FileRecord& record : recording.records()) result.read.push_back(record.path);
    return result;
  }
};

const std::string main_text =
    scene_with("include \"lib.sdl\" as lib;\nsphere { radius = lib.size; material = lib.gold; }\n");
const std::string library_text =
    "sdl 1;\nlet size = 2;\nmaterial gold: diffuse { color = rgb(0.9, 0.7, 0.1); }\n";

TEST(FrontendCache, only_what_changed_is_parsed) {
  Watched watched;
  watched.files.put("scene.sdl", main_text);
  watched.files.put("lib.sdl", library_text);
  const auto first = watched.compile_again();
  ASSERT_NE(first.hash, "");
  EXPECT_EQ(first.parsed, 2u);
  const auto second = watched.compile_again();
  EXPECT_EQ(second.hash, first.hash);
  EXPECT_EQ(second.parsed, 0u);
  EXPECT_EQ(second.reused, 2u);
  watched.files.put("lib.sdl", library_text + "let more = size;\n");
  const auto third = watched.compile_again();
  EXPECT_EQ(third.hash, first.hash);
  EXPECT_EQ(third.parsed, 1u);
  EXPECT_EQ(third.reused, 1u);
  watched.files.put("lib.sdl", library_text);  // back again: still known
  EXPECT_EQ(watched.compile_again().parsed, 0u);
}

TEST(FrontendCache, positions_comments_and_private_names_do_not_reach_the_hash) {
  Watched watched;
  watched.files.put("lib.sdl", library_text);
  watched.files.put("scene.sdl", main_text +
                                     "let a = 1;\nmacro m(x: num) { sphere { radius = x + a; "
                                     "material = grey; } }\nm(2);\n");
  const auto first = watched.compile_again();
  ASSERT_NE(first.hash, "") << first.rendered;
  watched.files.put("scene.sdl", "// moved down\n" + main_text +
                                     "let b = 1; /* renamed */\nmacro n(y: num) {\n  sphere {\n"
                                     "    radius = y + b;\n    material = grey;\n  }\n}\nn(2);\n");
  EXPECT_EQ(watched.compile_again().hash, first.hash);
}

TEST(FrontendCache, what_parsing_said_is_said_again_at_its_place) {
  Watched watched;
  watched.files.put("scene.sdl", "sdl 1;\ninclude \"lib.sdl\" as lib;\nsphere { radius = ; }\n");
  watched.files.put("lib.sdl", "sdl 1;\nlet a = [1, 2;\n");
  const auto first = watched.compile_again();
  EXPECT_NE(first.codes, "");
  const auto second = watched.compile_again();
  EXPECT_EQ(second.parsed, 0u);
  EXPECT_EQ(second.rendered, first.rendered);
  // What a broken scene depends on is known all the same.
  EXPECT_EQ(second.read, (std::vector<std::string>{"lib.sdl", "scene.sdl"}));
}

// ---- what modules declare

const std::string module_text =
    "sdl 1;\ninclude \"base.sdl\" as base;\n"
    "let sizes = [base.size, 2 * base.size, 3, 4];\n"
    "material brass: mix { a = base.gold; b = base.gold; weight = checker(0.2, 0.8).r; }\n"
    "material glow: diffuse { color = gray(0.5); emission = rgb(3, 2, 1); }\n"
    "fn twice(x: num): num = 2 * x;\n"
    "macro ball(r: num, of: material = brass) { sphere { radius = twice(r); material = of; } }\n"
    "proto pair { sphere { material = brass; } group { transform = move([0, 2, 0]);\n"
    "  sphere { radius = 2; material = base.gold; } } }\n"
    "let list = [brass, glow];\n";
const std::string module_scene =
    "sdl 1;\ninclude \"module.sdl\" as m;\ninclude \"lib.sdl\" as lib;\n"
    "m.ball(m.sizes[1]);\nm.ball(1, of = m.list[1]);\nm.ball(1, of = lib.gold);\n"
    "instance { of = m.pair; transform = move([1, 2, 3]); }\n" +
    camera;

Watched watched_modules() {
  Watched watched;
  watched.files.put("scene.sdl", module_scene);
  watched.files.put("module.sdl", module_text);
  watched.files.put("base.sdl", library_text);
  watched.files.put("lib.sdl", library_text);
  return watched;
}

std::uint64_t evaluated(const Watched& watched) {
  return watched.cache.counters().modules_evaluated;
}
std::uint64_t reused(const Watched& watched) {
  return watched.cache.counters().modules_reused;
}

TEST(FrontendCache, modules_are_evaluated_once) {
  Watched watched = watched_modules();
  const auto first = watched.compile_again();
  ASSERT_NE(first.hash, "") << first.rendered;
  EXPECT_EQ(evaluated(watched), 3u);
  const auto second = watched.compile_again();
  EXPECT_EQ(evaluated(watched), 3u);
  EXPECT_EQ(reused(watched), 3u);
  EXPECT_EQ(second.hash, first.hash);
  EXPECT_EQ(second.dump, first.dump);
  EXPECT_EQ(second.rendered, first.rendered);
  EXPECT_EQ(second.read, first.read);
  EXPECT_EQ(second.parsed, 0u);
  const auto third = watched.compile_again();
  EXPECT_EQ(third.dump, first.dump);
}

TEST(FrontendCache, a_module_depends_on_what_it_includes) {
  Watched watched = watched_modules();
  const auto first = watched.compile_again();
  watched.files.put("base.sdl", library_text + "let other = 1;\n");
  const auto second = watched.compile_again();
  EXPECT_EQ(second.hash, first.hash);
  EXPECT_EQ(evaluated(watched), 5u);  // base.sdl and module.sdl
  EXPECT_EQ(reused(watched), 1u);     // lib.sdl
  std::string silver = library_text;
  silver.replace(silver.find("0.7"), 3, "0.9");
  watched.files.put("base.sdl", silver);
  const auto third = watched.compile_again();
  EXPECT_NE(third.hash, first.hash);
  EXPECT_NE(third.hash, "");
  FrontendCache nothing;
  std::swap(watched.cache, nothing);
  EXPECT_EQ(watched.compile_again().dump, third.dump);
}

TEST(FrontendCache, what_gives_a_diagnostic_or_reads_a_file_is_evaluated_again) {
  Watched watched = watched_modules();
  watched.files.put("base.sdl", library_text + "let rgb = 1;\n");  // hides a built-in name
  const auto first = watched.compile_again();
  EXPECT_NE(first.rendered, "");
  const auto second = watched.compile_again();
  EXPECT_EQ(second.rendered, first.rendered);
  EXPECT_EQ(second.dump, first.dump);
  EXPECT_EQ(evaluated(watched), 5u);
  EXPECT_EQ(reused(watched), 1u);
  watched.files.put("wood.png", "bytes");
  watched.files.put("base.sdl",
                    library_text + "material wood: diffuse { color = image(\"wood.png\"); }\n");
  static_cast<void>(watched.compile_again());
  const auto fourth = watched.compile_again();
  EXPECT_NE(std::find(fourth.read.begin(), fourth.read.end(), "wood.png"), fourth.read.end());
}

TEST(FrontendCache, every_scene_of_the_tree_is_the_same_with_it) {
  FrontendCache cache;
  const auto dump = [](const std::string& path, FrontendCache* with) {
    RealFileSystem files;
    SourceMap sources;
    DiagnosticSink sink;
    CompileOptions options;
    options.library = true;
    options.cache = with;
    const auto scene = compile(path, options, files, sources, sink);
    std::string text = scene ? scene->hash.hex() + ir::dump_text(*scene, {}) : std::string();
    for (const Diagnostic& diagnostic : sink.sorted())
      text += render_terminal(diagnostic, sources, {});
    return text;
  };
  for (const char* const folder : {"tests/diagnostics", "tests/golden", "stdlib-scenes"}) {
    const auto root = scenec::test::source_directory() / folder;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
      const std::string path = entry.path().string();
      if (!path.ends_with(".sdl")) continue;
      const std::string fresh = dump(path, nullptr);
      EXPECT_EQ(dump(path, &cache), fresh) << path;
      EXPECT_EQ(dump(path, &cache), fresh) << path;
    }
  }
  EXPECT_GT(cache.counters().modules_reused, 50u);
}

TEST(FrontendCache, the_budget_is_kept_and_the_oldest_go) {
  FrontendCache cache(4000);
  DiagnosticSink sink;
  const auto read = [&](int i) {
    const std::string text = fmt::format("sdl 1; let value = {};", i);
    static_cast<void>(cache.tree_of(grammar::Dialect::sdl, FileId(0), text, sink));
  };
  for (int i = 0; i < 20; ++i) {
    read(i);
    EXPECT_LE(cache.bytes(), 4000u);
  }
  EXPECT_GT(cache.counters().files_forgotten, 0u);
  read(19);
  EXPECT_EQ(cache.counters().files_reused, 1u);
  read(0);
  EXPECT_EQ(cache.counters().files_reused, 1u);
  EXPECT_EQ(cache.counters().files_parsed, 21u);
}

// A daemon under edits without end, good ones and bad ones: each leaves a tree and a module behind.
TEST(FrontendCache, what_no_edit_uses_any_more_goes_with_mistakes_too) {
  FrontendCache cache(std::size_t{64} << 20, std::size_t{8} << 20, 16);
  MemoryFileSystem files;
  files.put("scene.sdl", main_text);
  CompileOptions options;
  options.cache = &cache;
  std::size_t most_bytes = 0;
  for (int i = 0; i < 1500; ++i) {
    const bool is_broken = i % 3 == 0;
    files.put("lib.sdl", fmt::format("sdl 1;\nlet size = {};\nlet other = {};\n"
                                     "material gold: diffuse {{ color = rgb(0.9, 0.7, 0.1); }}\n",
                                     is_broken ? "" : fmt::format("{}.5", i), i));
    SourceMap sources;
    DiagnosticSink sink;
    EXPECT_EQ(compile("scene.sdl", options, files, sources, sink).has_value(), !is_broken);
    EXPECT_LE(cache.module_count(), 300u);
    if (i == 100) most_bytes = cache.bytes();
    if (i > 100) {
      EXPECT_LE(cache.bytes(), most_bytes * 3 / 2);
    }
  }
}

}  // namespace
}  // namespace scenec::frontend::test
