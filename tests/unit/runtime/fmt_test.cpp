// The verb fmt: what it reads, writes, prints and answers.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "runtime/cli.hpp"

namespace scenec::runtime {
namespace {

namespace fs = std::filesystem;

class Fmt : public testing::Test {
 protected:
  Fmt() : directory_(fs::temp_directory_path() / ("scenec-fmt-" + std::to_string(::getpid()))) {
    fs::create_directories(directory_);
  }
  ~Fmt() override { fs::remove_all(directory_); }

  std::string put(const std::string& name, const std::string& text) {
    const fs::path path = directory_ / name;
    std::ofstream(path, std::ios::binary) << text;
    return path.string();
  }
  static std::string text_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  }
  ExitCode run_fmt(std::vector<std::string> words, const std::string& input = {}) {
    words.insert(words.begin(), "fmt");
    std::istringstream in(input);
    out_.str({});
    err_.str({});
    const Environment environment{.out = out_,
                                  .err = err_,
                                  .variable = [](std::string_view) { return std::nullopt; },
                                  .in = &in};
    return run(words, environment);
  }

  fs::path directory_;
  std::ostringstream out_;
  std::ostringstream err_;
};

constexpr const char* plain = "sdl 1;\nlet  a=1;\n";
constexpr const char* canonical = "sdl 1;\nlet a = 1;\n";

TEST_F(Fmt, RewritesFilesInPlace) {
  const std::string first = put("a.sdl", plain);
  const std::string second = put("b.txt", "Group{numObjects 0}");
  EXPECT_EQ(run_fmt({first, second}), ExitCode::ok);
  EXPECT_EQ(text_of(first), canonical);
  EXPECT_EQ(text_of(second), "Group { numObjects 0 }\n");
  EXPECT_EQ(out_.str() + err_.str(), "");
}

TEST_F(Fmt, LeavesAFormattedFileAlone) {
  const std::string path = put("a.sdl", canonical);
  const auto old = fs::last_write_time(path) - std::chrono::hours(1);
  fs::last_write_time(path, old);
  EXPECT_EQ(run_fmt({path}), ExitCode::ok);
  EXPECT_EQ(fs::last_write_time(path), old);
}

TEST_F(Fmt, LeavesAFileWithAMistakeAloneAndFormatsTheOthers) {
  const std::string broken = put("a.sdl", "sdl 1;\nlet  a 1;\n");
  const std::string good = put("b.sdl", plain);
  EXPECT_EQ(run_fmt({broken, good}), ExitCode::scene_error);
  EXPECT_EQ(text_of(broken), "sdl 1;\nlet  a 1;\n");
  EXPECT_EQ(text_of(good), canonical);
  EXPECT_NE(err_.str().find("expected `=`"), std::string::npos) << err_.str();
}

TEST_F(Fmt, StandardInputGoesToStandardOutput) {
  EXPECT_EQ(run_fmt({"-"}, plain), ExitCode::ok);
  EXPECT_EQ(out_.str(), canonical);
  EXPECT_EQ(run_fmt({"--dialect", "course", "-"}, "A{b 1}"), ExitCode::ok);
  EXPECT_EQ(out_.str(), "A { b 1 }\n");
}

TEST_F(Fmt, CheckNamesFilesAndChangesNone) {
  const std::string first = put("a.sdl", plain);
  const std::string second = put("b.sdl", canonical);
  EXPECT_EQ(run_fmt({"--check", first, second}), ExitCode::scene_error);
  EXPECT_EQ(out_.str(), first + "\n");
  EXPECT_EQ(text_of(first), plain);
  EXPECT_EQ(run_fmt({"--check", second}), ExitCode::ok);
  EXPECT_EQ(run_fmt({"--check", "-"}, plain), ExitCode::scene_error);
  EXPECT_EQ(out_.str(), "<stdin>\n");
}

TEST_F(Fmt, DiffShowsWhatWouldChange) {
  const std::string path = put("a.sdl", plain);
  EXPECT_EQ(run_fmt({"--diff", path}), ExitCode::ok);
  EXPECT_EQ(out_.str(), "--- " + path + "\n+++ " + path +
                            "\n@@ -1,2 +1,2 @@\n sdl 1;\n-let  a=1;\n+let a = 1;\n");
  EXPECT_EQ(text_of(path), plain);
  EXPECT_EQ(run_fmt({"--diff", "--check", path}), ExitCode::scene_error);
}

TEST_F(Fmt, CourseFilesStayCourseText) {
  const std::string text = "# desk\nMaterials{numMaterials 1 Material{diffuseColor 1 1 1}}\n";
  const std::string laid_out =
      "# desk\nMaterials { numMaterials 1 Material { diffuseColor 1 1 1 } }\n";
  const std::string path = put("a.txt", text);
  EXPECT_EQ(run_fmt({"--check", path}), ExitCode::scene_error);
  EXPECT_EQ(out_.str(), path + "\n");
  EXPECT_EQ(run_fmt({"--diff", path}), ExitCode::ok);
  EXPECT_NE(out_.str().find("@@ -1,2 +1,2 @@\n # desk\n-Materials{"), std::string::npos)
      << out_.str();
  EXPECT_EQ(text_of(path), text);
  EXPECT_EQ(run_fmt({path}), ExitCode::ok);
  EXPECT_EQ(text_of(path), laid_out);
  EXPECT_EQ(run_fmt({"--check", "--diff", path}), ExitCode::ok);
  EXPECT_EQ(out_.str() + err_.str(), "");
  // The dialect is that of the text, whatever the name, and can be said.
  const std::string native = put("b.txt", "sdl 1;\nlet  a=1;\n");
  EXPECT_EQ(run_fmt({native}), ExitCode::ok);
  EXPECT_EQ(text_of(native), canonical);
}

TEST_F(Fmt, DiffsOfSeveralFilesFollowEachOther) {
  const std::string first = put("a.sdl", plain);
  const std::string second = put("b.sdl", canonical);
  const std::string third = put("c.sdl", "sdl 1;\r\nlet a = 1;\r\n");
  EXPECT_EQ(run_fmt({"--diff", "--check", first, second, third}), ExitCode::scene_error);
  EXPECT_NE(out_.str().find("--- " + first), std::string::npos);
  EXPECT_EQ(out_.str().find(second), std::string::npos);
  EXPECT_NE(out_.str().find("--- " + third), std::string::npos);
}

TEST_F(Fmt, FilesThatCannotBeRead) {
  EXPECT_EQ(run_fmt({(directory_ / "none.sdl").string()}), ExitCode::file_error);
  EXPECT_EQ(run_fmt({directory_.string()}), ExitCode::file_error);
  EXPECT_EQ(run_fmt({}), ExitCode::usage);
}

}  // namespace
}  // namespace scenec::runtime
