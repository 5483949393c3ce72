// What must hold for every scene of the tree, whatever it says: the lossless tree puts its text
// together again, and the IR printed as source compiles to the same IR and the same print.
#include <gtest/gtest.h>

#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "base/source_map.hpp"
#include "frontend/compile.hpp"
#include "grammar/parse.hpp"
#include "ir/dump.hpp"
#include "tests/support/overlay_file_system.hpp"
#include "tests/support/paths.hpp"
#include "tests/support/scenes.hpp"

namespace {

namespace fs = std::filesystem;

std::vector<fs::path> scenes_of_the_tree() {
  return scenec::test::scenes_beneath({"stdlib-scenes", "tests"});
}

struct Compiled {
  std::string hash;
  std::string dump;
};
std::optional<Compiled> compile(scenec::FileSystem& files, const std::string& path) {
  scenec::SourceMap sources;
  scenec::DiagnosticSink sink;
  scenec::frontend::CompileOptions options;
  options.library = true;
  const auto scene = scenec::frontend::compile(path, options, files, sources, sink);
  if (!scene || scene->cameras.empty()) return std::nullopt;  // a library dumps as nothing
  return Compiled{scene->hash.hex(), scenec::ir::dump_text(*scene, {})};
}

TEST(Properties, TheTreeHoldsEveryByte) {
  for (const fs::path& path : scenes_of_the_tree()) {
    const std::string text = scenec::test::text_of_file(path);
    scenec::SourceMap sources;
    scenec::DiagnosticSink sink;
    const scenec::FileId file = sources.add(path.string(), text);
    const std::string_view kept = sources.text(file);
    EXPECT_EQ(scenec::grammar::reassembled_text(scenec::grammar::parse_sdl(file, kept, sink)), text)
        << path << " as sdl";
    EXPECT_EQ(scenec::grammar::reassembled_text(scenec::grammar::parse_course(file, kept, sink)),
              text)
        << path << " as course";
  }
}

TEST(Properties, TheDumpedIrCompilesToItself) {
  int compiled = 0;
  for (const fs::path& path : scenes_of_the_tree()) {
    fs::current_path(path.parent_path());
    scenec::RealFileSystem disk;
    const auto first = compile(disk, path.filename().string());
    if (!first) continue;
    ++compiled;
    scenec::test::OverlayFileSystem files("dumped-again.sdl", first->dump);
    const auto second = compile(files, "dumped-again.sdl");
    ASSERT_TRUE(second) << path << "\n" << first->dump;
    EXPECT_EQ(second->hash, first->hash) << path;
    EXPECT_EQ(second->dump, first->dump) << path;
  }
  std::cout << compiled << " scenes compile to themselves\n";
  EXPECT_GT(compiled, 30);
}

TEST(Properties, TheSceneInTheReadmeCompiles) {
  const std::string readme =
      scenec::test::text_of_file(scenec::test::source_directory() / "README.md");
  const std::size_t begin = readme.find("sdl 1;");
  ASSERT_NE(begin, std::string::npos);
  scenec::test::OverlayFileSystem files("readme.sdl",
                                        readme.substr(begin, readme.find("```", begin) - begin));
  EXPECT_TRUE(compile(files, "readme.sdl"));
}

}  // namespace
