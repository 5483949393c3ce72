// Every scene of the shared corpus through the translation: what is expected of its class happens,
// and what is written parses as native text.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "base/source_map.hpp"
#include "frontend/course/translate.hpp"
#include "grammar/parse.hpp"
#include "tests/support/paths.hpp"

namespace scenec::test {
namespace {

namespace fs = std::filesystem;

struct CorpusScene {
  fs::path folder;
  std::string path;
  std::string expected;
  [[nodiscard]] bool has_assets() const {
    return expected.find("Assets absent") == std::string::npos;
  }
  [[nodiscard]] std::string kind() const {
    if (expected.starts_with("known-broken")) return "broken";
    if (expected.starts_with("valid base")) return "base";
    return "extended";
  }
};

std::vector<CorpusScene> read_index(const fs::path& course) {
  std::vector<CorpusScene> scenes;
  std::ifstream stream(course / "INDEX.md");
  fs::path folder;
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with("## ")) folder = course / line.substr(3);
    std::vector<std::string> cells;
    std::stringstream row(line);
    for (std::string cell; std::getline(row, cell, '|');) {
      const std::size_t first = cell.find_first_not_of(' ');
      cells.push_back(first == std::string::npos
                          ? ""
                          : cell.substr(first, cell.find_last_not_of(' ') - first + 1));
    }
    if (cells.size() < 6) continue;
    const std::string& expected = cells[5];
    if (expected.starts_with("valid ") || expected.starts_with("known-broken"))
      scenes.push_back({folder, cells[1], expected});
  }
  return scenes;
}

struct Outcome {
  bool translated = false;
  bool parses = false;
  std::string first_error;
};

Outcome translate_scene(const CorpusScene& scene) {
  fs::current_path(scene.folder);
  std::ifstream stream(scene.path, std::ios::binary);
  std::stringstream content;
  content << stream.rdbuf();
  SourceMap sources;
  const FileId file = sources.add(scene.path, content.str());
  DiagnosticSink sink;
  const auto tree = grammar::parse_course(file, sources.text(file), sink);
  RealFileSystem files;
  auto translation = frontend::course::translate(
      tree, {.scene_path = scene.path, .output_directory = directory_of(scene.path), .method = {}},
      files, sink);
  Outcome outcome;
  outcome.translated = !sink.has_errors();
  for (const Diagnostic& diagnostic : sink.sorted()) {
    const DiagnosticKindInfo& info = info_of(diagnostic.kind);
    if (info.severity != Severity::error) continue;
    EXPECT_TRUE(diagnostic.span.valid()) << scene.path;
    const Position at = sources.position(file, diagnostic.span.begin);
    outcome.first_error =
        fmt::format("{}:{} {} {}", at.line, at.column, info.code, diagnostic.message);
    break;
  }
  DiagnosticSink native;
  const FileId derived =
      sources.add_derived(file, std::move(translation.text), std::move(translation.ranges));
  (void)grammar::parse_sdl(derived, sources.text(derived), native);
  outcome.parses = !native.has_errors();
  for (const Diagnostic& diagnostic : native.sorted())
    outcome.first_error = "native: " + diagnostic.message;
  return outcome;
}

class CourseCorpus : public testing::Test {
 protected:
  void SetUp() override {
    before_ = fs::current_path();
    const auto corpus = find_corpus();
    if (!corpus) GTEST_SKIP() << missing_corpus;
    scenes_ = read_index(fs::canonical(*corpus) / "course");
    ASSERT_GT(scenes_.size(), 100u) << "INDEX.md could not be read";
  }
  void TearDown() override { fs::current_path(before_); }

  std::vector<CorpusScene> scenes_;
  fs::path before_;
};

TEST_F(CourseCorpus, ClassesComeOutAsExpected) {
  std::map<std::string, std::pair<int, int>> table;  // translated, of
  for (const CorpusScene& scene : scenes_) {
    const Outcome outcome = translate_scene(scene);
    const std::string name = scene.folder.filename().string() + "/" + scene.path;
    EXPECT_TRUE(outcome.parses) << name << "\n" << outcome.first_error;
    const std::string row = scene.kind() + (scene.has_assets() ? "" : ", assets absent");
    auto& [translated, of] = table[row];
    ++of;
    translated += outcome.translated ? 1 : 0;
    if (scene.kind() == "base" && scene.has_assets()) {
      EXPECT_TRUE(outcome.translated) << name << "\n" << outcome.first_error;
    }
    if (scene.kind() == "broken" || !scene.has_assets()) {
      EXPECT_FALSE(outcome.translated) << name;
    } else if (!outcome.translated) {
      fmt::print("stops: {} at {}\n", name, outcome.first_error);
    }
  }
  for (const auto& [row, counts] : table)
    fmt::print("{}: {} of {} translated\n", row, counts.first, counts.second);
  EXPECT_GE(table["extended"].first, 80);
}

// What is cut off or garbled must not bring the translation down.
TEST_F(CourseCorpus, CutFilesAreErrorsOrScenes) {
  for (std::size_t i = 0; i < scenes_.size(); i += 7) {
    fs::current_path(scenes_[i].folder);
    std::ifstream stream(scenes_[i].path, std::ios::binary);
    std::stringstream content;
    content << stream.rdbuf();
    const std::string whole = content.str();
    for (std::size_t cut = 0; cut < whole.size(); cut += 61) {
      SourceMap sources;
      const FileId file = sources.add(
          "cut.txt", whole.substr(0, cut) + whole.substr(std::min(whole.size(), cut + 3)));
      DiagnosticSink sink;
      const auto tree = grammar::parse_course(file, sources.text(file), sink);
      MemoryFileSystem files;
      (void)frontend::course::translate(
          tree, {.scene_path = "cut.txt", .output_directory = "", .method = {}}, files, sink);
    }
  }
}

}  // namespace
}  // namespace scenec::test
