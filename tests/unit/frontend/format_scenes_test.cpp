// Formatting and the compiler: the scene stays the same, and the goldens of tests/golden/format
// (written and read by hand) hold.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <functional>
#include <iostream>

#include "frontend/compile.hpp"
#include "tests/support/overlay_file_system.hpp"
#include "tests/support/scenes.hpp"
#include "tests/unit/frontend/format_support.hpp"

namespace scenec::frontend::test {
namespace {

namespace fs = std::filesystem;

std::string hash_of(const fs::path& path, const std::string& text) {
  scenec::test::OverlayFileSystem files(path.string(), text);
  SourceMap sources;
  DiagnosticSink sink;
  CompileOptions options;
  options.library = true;
  const auto scene = compile(path.string(), options, files, sources, sink);
  return scene ? scene->hash.hex() : std::string();
}

TEST(FormatScenes, TheHashOfTheSceneStays) {
  int compared = 0;
  for (const fs::path& path : scenec::test::scenes_beneath({"tests", "stdlib-scenes"})) {
    const std::string text = scenec::test::text_of_file(path);
    const auto after = formatted(text, grammar::dialect_of(path.string(), text));
    if (!after) continue;
    const std::string hash = hash_of(path, text);
    if (hash.empty()) continue;
    EXPECT_EQ(hash_of(path, *after), hash) << path;
    ++compared;
  }
  std::cout << compared << " scenes have the same hash\n";
  EXPECT_GT(compared, 10);
}

TEST(FormatScenes, Goldens) {
  int compared = 0;
  for (const fs::path& path : scenec::test::scenes_beneath({"tests/golden/format"})) {
    const std::string text = scenec::test::text_of_file(path);
    const grammar::Dialect dialect = grammar::dialect_of(path.string(), text);
    const std::string expected = scenec::test::text_of_file(path.string() + ".expected");
    EXPECT_EQ(formatted(text, dialect), expected) << path;
    EXPECT_EQ(formatted(expected, dialect), expected) << path;
    ++compared;
  }
  EXPECT_GE(compared, 3);
}

double best_seconds(const std::function<void()>& work) {
  double best = 1e9;
  for (int i = 0; i < 5; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    const auto end = std::chrono::steady_clock::now();
    best = std::min(best, std::chrono::duration<double>(end - begin).count());
  }
  return best;
}

// Parsing is linear in the text.
TEST(FormatScenes, FormattingTakesNoMoreThanAFewTimesAsLongAsParsing) {
  std::string text = "sdl 1;\n";
  for (int i = 0; i < 10'000; ++i) {
    text += "sphere s { center=[" + std::to_string(i) + ",1*2+3,0];radius=0.5; } // comment\n";
    text += "let a = [[1, 2, 3], [4, 5, 6], f(7, x = 8)];\n";
  }
  text += "let b = 1";
  for (int i = 0; i < 20'000; ++i) text += "+f([2])";
  text += ";\n";
  const Parsed parsed(text, grammar::Dialect::sdl);
  ASSERT_FALSE(parsed.has_errors());
  const double parsing =
      best_seconds([&] { EXPECT_FALSE(Parsed(text, grammar::Dialect::sdl).has_errors()); });
  const double formatting =
      best_seconds([&] { EXPECT_GT(format(parsed.tree()).size(), text.size() / 2); });
  std::cout << text.size() << " bytes: parsed in " << parsing * 1e3 << " ms, formatted in "
            << formatting * 1e3 << " ms\n";
  EXPECT_LT(formatting, 5 * parsing);
}

}  // namespace
}  // namespace scenec::frontend::test
