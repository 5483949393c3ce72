// Diagnostics for programs, over every case of tests/diagnostics and the course's and native
// scenes of tests/golden: SARIF logs are valid, JSON lines have the keys of their version, all
// three forms say the same in the same order, and a second run says it again byte for byte.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/golden/runner.hpp"
#include "tests/golden/sarif_rules.hpp"
#include "tests/support/scenes.hpp"

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using scenec::test::RunResult;

RunResult check(const fs::path& scene, const std::string& form) {
  fs::current_path(scene.parent_path());
  return scenec::test::run_scenec(
      {"check", scene.filename().string(), "--diagnostics", form, "--color", "never"});
}

const std::vector<fs::path>& scenes() {
  static const std::vector<fs::path> all =
      scenec::test::scenes_beneath({"tests/diagnostics", "tests/golden", "stdlib-scenes"});
  return all;
}

std::vector<json> lines_of(const std::string& text) {
  std::vector<json> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(json::parse(line));
  return lines;
}

// "E0101" of every heading `...: error[E0101]: ...`, in order.
std::vector<std::string> codes_of_text(const std::string& text) {
  std::vector<std::string> codes;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    for (const std::string mark : {": error[", ": warning["}) {
      const std::size_t at = line.find(mark);
      if (at != std::string::npos && line.find(": note") > at) {
        codes.push_back(line.substr(at + mark.size(), 5));
        break;
      }
    }
  }
  return codes;
}

TEST(DiagnosticForms, EverySarifLogIsValid) {
  int results = 0;
  for (const fs::path& scene : scenes()) {
    const RunResult run = check(scene, "sarif");
    const json log = json::parse(run.err, nullptr, false);
    ASSERT_FALSE(log.is_discarded()) << scene << "\n" << run.err;
    EXPECT_THAT(scenec::test::sarif_problems(log), testing::IsEmpty()) << scene << "\n" << run.err;
    results += static_cast<int>(log["runs"][0]["results"].size());
    EXPECT_EQ(log["runs"][0]["columnKind"], "unicodeCodePoints");
  }
  EXPECT_GT(results, 150);
}

TEST(DiagnosticForms, TheRulesFindWhatIsWrong) {  // the counterproof
  const auto problems = [](const std::string& text) {
    return scenec::test::sarif_problems(json::parse(text)).size();
  };
  const std::string driver = R"("tool": {"driver": {"name": "t", "rules": [{"id": "E1"}]}})";
  const auto log = [&](const std::string& result) {
    return R"({"version": "2.1.0", "runs": [{)" + driver + R"(, "results": [)" + result + "]}]}";
  };
  const auto place = [&](const std::string& uri, const std::string& region) {
    return log(R"({"message": {"text": "m"}, "ruleId": "E1", "ruleIndex": 0, "locations": [)"
               R"({"physicalLocation": {"artifactLocation": {"uri": ")" +
               uri + R"("}, "region": )" + region + "}}]}");
  };
  EXPECT_EQ(problems(log(R"({"message": {"text": "m"}, "ruleId": "E1"})")), 0u);
  EXPECT_EQ(problems(place("a%20b.sdl", R"({"startLine": 1, "startColumn": 1})")), 0u);
  EXPECT_NE(problems(R"({"version": "2.1.0"})"), 0u);
  EXPECT_NE(problems(R"({"version": "2.0.0", "runs": []})"), 0u);
  EXPECT_NE(problems(log(R"({"ruleId": "E1"})")), 0u);
  EXPECT_NE(problems(log(R"({"message": {}, "ruleId": "E1"})")), 0u);
  EXPECT_NE(problems(log(R"({"message": {"text": "m"}, "ruleId": "E2"})")), 0u);
  EXPECT_NE(problems(log(R"({"message": {"text": "m"}, "ruleId": "E1", "level": "fatal"})")), 0u);
  EXPECT_NE(problems(log(R"({"message": {"text": "m"}, "ruleId": "E1", "colour": 1})")), 0u);
  EXPECT_NE(problems(place("a b.sdl", R"({"startLine": 1})")), 0u);
  EXPECT_NE(problems(place("a:b.sdl", R"({"startLine": 1})")), 0u);
  EXPECT_NE(problems(place("a%2.sdl", R"({"startLine": 1})")), 0u);
  EXPECT_NE(problems(place("a.sdl", R"({"startLine": 0})")), 0u);
  EXPECT_NE(problems(place("a.sdl", R"({"startLine": 2, "endLine": 1})")), 0u);
  EXPECT_NE(problems(place("a.sdl", R"({"startLine": 2, "startColumn": 3, "endColumn": 2})")), 0u);
}

void expect_place(const json& object, const fs::path& scene) {
  if (!object.contains("file")) {
    for (const char* const key : {"line", "column", "end_line", "end_column", "begin", "end"}) {
      EXPECT_FALSE(object.contains(key)) << scene;
    }
    return;
  }
  EXPECT_TRUE(object["file"].is_string()) << scene;
  for (const char* const key : {"line", "column", "end_line", "end_column"}) {
    EXPECT_GE(object[key].get<int>(), 1) << scene << " " << object;
  }
  EXPECT_LE(object["begin"].get<int>(), object["end"].get<int>()) << scene << " " << object;
}

TEST(DiagnosticForms, EveryJsonLineHasTheKeysOfItsVersion) {
  for (const fs::path& scene : scenes()) {
    const RunResult run = check(scene, "json");
    for (const json& line : lines_of(run.err)) {
      EXPECT_EQ(line["version"], 1) << scene;
      for (const char* const key : {"code", "name", "severity", "message"}) {
        EXPECT_TRUE(line[key].is_string()) << scene << " " << line;
      }
      EXPECT_TRUE(line["severity"] == "error" || line["severity"] == "warning") << line;
      expect_place(line, scene);
      for (const char* const key : {"labels", "notes", "hints", "fixits"}) {
        ASSERT_TRUE(line[key].is_array()) << scene << " " << line;
      }
      for (const json& hint : line["hints"]) EXPECT_TRUE(hint.is_string()) << line;
      for (const char* const key : {"labels", "notes"}) {
        for (const json& one : line[key]) {
          EXPECT_TRUE(one["text"].is_string()) << line;
          expect_place(one, scene);
        }
      }
      for (const json& fix : line["fixits"]) {
        EXPECT_TRUE(fix["replacement"].is_string()) << line;
        EXPECT_TRUE(fix.contains("file")) << line;
        expect_place(fix, scene);
      }
    }
  }
}

TEST(DiagnosticForms, AllFormsSayTheSameInTheSameOrder) {
  for (const fs::path& scene : scenes()) {
    const RunResult text = check(scene, "text");
    const RunResult lines = check(scene, "json");
    const RunResult log = check(scene, "sarif");
    EXPECT_EQ(text.exit_code, lines.exit_code) << scene;
    EXPECT_EQ(text.exit_code, log.exit_code) << scene;
    std::vector<std::string> of_lines;
    for (const json& line : lines_of(lines.err)) of_lines.push_back(line["code"]);
    std::vector<std::string> of_log;
    const json parsed = json::parse(log.err);
    for (const json& result : parsed["runs"][0]["results"]) of_log.push_back(result["ruleId"]);
    EXPECT_EQ(of_log, of_lines) << scene;
    std::vector<std::string> printed = of_lines;
    if (printed.size() > 100) printed.resize(100);  // the text stops there and counts
    EXPECT_EQ(codes_of_text(text.err), printed) << scene << "\n" << text.err;
  }
}

TEST(DiagnosticForms, ASecondRunSaysTheSame) {
  for (const fs::path& scene : scenes()) {
    for (const std::string form : {"text", "json", "sarif"}) {
      EXPECT_EQ(check(scene, form).err, check(scene, form).err) << scene;
    }
  }
}

TEST(DiagnosticForms, PlacesAscendWithinAFile) {
  for (const fs::path& scene : scenes()) {
    const std::vector<json> lines = lines_of(check(scene, "json").err);
    const auto before = [](const json& a, const json& b) {
      if (a.value("file", "") != b.value("file", "")) return true;  // files in order of reading
      return a.value("begin", 0) <= b.value("begin", 0);
    };
    for (std::size_t i = 1; i < lines.size(); ++i) {
      EXPECT_TRUE(before(lines[i - 1], lines[i])) << scene << "\n" << lines[i - 1] << lines[i];
    }
  }
}

}  // namespace
