// The dependency file: its text, where it goes, and that make and ninja act on it.
#include "runtime/dependencies.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "runtime/cli.hpp"

namespace scenec::runtime {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string text_of(const DependencyRule& rule) {
  return dependency_text(rule).value();
}

TEST(DependencyText, NamesTargetsAndFiles) {
  EXPECT_EQ(
      text_of({.targets = {"out.png", "log"},
               .scene = "a.sdl",
               .files = {{"a.sdl", true, {}}, {"m/b.obj", true, {}}, {"std:lights", true, {}}},
               .complete = true}),
      "out.png log: \\\n  a.sdl \\\n  m/b.obj\n");
}

TEST(DependencyText, PhonyRulesStandForEveryFileButTheScene) {
  EXPECT_EQ(text_of({.targets = {"o"},
                     .scene = "a.sdl",
                     .files = {{"a.sdl", true, {}}, {"b", true, {}}, {"c", true, {}}},
                     .phony = true,
                     .complete = true}),
            "o: \\\n  a.sdl \\\n  b \\\n  c\nb:\nc:\n");
}

TEST(DependencyText, MissedFilesCountWhileSomethingIsWrong) {
  DependencyRule rule{
      .targets = {"o"}, .scene = "a.sdl", .files = {{"a.sdl", true, {}}, {"b", false, {}}}};
  EXPECT_EQ(text_of(rule), "o: \\\n  a.sdl \\\n  b\nb:\n");
  rule.complete = true;
  EXPECT_EQ(text_of(rule), "o: \\\n  a.sdl\n");
  // The scene itself, missing.
  EXPECT_EQ(text_of({.targets = {"o"}, .scene = "a.sdl", .files = {{"a.sdl", false, {}}}}),
            "o: \\\n  a.sdl\na.sdl:\n");
}

TEST(DependencyText, EscapesWhatMakeWouldRead) {
  EXPECT_EQ(text_of({.targets = {"a b:c"}, .scene = "x#y$z", .files = {}}),
            "a\\ b\\:c: \\\n  x\\#y$$z\n");
  EXPECT_EQ(text_of({.targets = {"o"}, .scene = "a\\ b\\c", .files = {}}),
            "o: \\\n  a\\\\\\ b\\c\n");
}

TEST(DependencyText, ALineEndInANameIsRefused) {
  const auto text = dependency_text({.targets = {"o"}, .scene = "a\nb", .files = {}});
  ASSERT_FALSE(text.ok());
  EXPECT_EQ(text.error(), "a\nb");
}

class Dependencies : public testing::Test {
 protected:
  Dependencies()
      : before_(fs::current_path()),
        directory_(fs::temp_directory_path() / ("scenec-deps-" + std::to_string(::getpid()))) {
    fs::remove_all(directory_);
    fs::create_directories(directory_);
    fs::current_path(directory_);
    put("lib.sdl", "sdl 1;\nlet size = 1m;\n");
    put("scene.sdl",
        "sdl 1;\ninclude \"lib.sdl\" as lib;\nmaterial m: diffuse { color = gray(0.6); }\n"
        "sphere { radius = lib.size; material = m; }\n"
        "light: point { position = [2, 3, 4]; power = 900W; }\n"
        "camera main: pinhole { eye = [0, 0, 5]; aim = [0, 0, 0]; fov = 40deg; }\n"
        "render { size = [2, 2]; samples = 1; }\n");
  }
  ~Dependencies() override {
    fs::current_path(before_);
    fs::remove_all(directory_);
  }

  static void put(const std::string& name, const std::string& text) {
    std::ofstream(name, std::ios::binary) << text;
  }
  static std::string get(const std::string& name) {
    std::ifstream file(name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  }
  ExitCode call(const std::vector<std::string>& words) {
    out_.str({});
    err_.str({});
    return run(words, {.out = out_, .err = err_, .variable = [](std::string_view) {
                         return std::optional<std::string>();
                       }});
  }
  // The targets make still has something to do for, with `rule` as the makefile; empty: none.
  static bool is_up_to_date(const std::string& rule, const std::string& target) {
    put("Makefile", rule + "\t@exit 1\n");
    return std::system(("make -q '" + target + "' >/dev/null 2>&1").c_str()) == 0;
  }

  fs::path before_;
  fs::path directory_;
  std::ostringstream out_;
  std::ostringstream err_;
};

TEST_F(Dependencies, StandBesideTheOutputUnlessNamed) {
  fs::create_directory("sub");
  EXPECT_EQ(call({"scene.sdl", "-o", "sub/out.png", "-MD"}), ExitCode::ok) << err_.str();
  EXPECT_EQ(get("sub/out.d"), "sub/out.png: \\\n  scene.sdl \\\n  lib.sdl\n");
  EXPECT_EQ(call({"scene.sdl", "-MD", "-MP"}), ExitCode::ok) << err_.str();
  EXPECT_EQ(get("scene.d"), "scene.png: \\\n  scene.sdl \\\n  lib.sdl\nlib.sdl:\n");
  EXPECT_EQ(call({"check", "scene.sdl", "-MD", "-MFa.d", "-MT", "x", "-MTy z"}), ExitCode::ok);
  EXPECT_EQ(get("a.d"), "x y\\ z: \\\n  scene.sdl \\\n  lib.sdl\n");
  EXPECT_EQ(call({"dump", "scene.sdl", "-o", "s.ir", "-MD"}), ExitCode::ok) << err_.str();
  EXPECT_EQ(get("s.d"), "s.ir: \\\n  scene.sdl \\\n  lib.sdl\n");
}

TEST_F(Dependencies, AreWrittenOnFailureToo) {
  fs::remove("lib.sdl");
  EXPECT_EQ(call({"scene.sdl", "-MD"}), ExitCode::scene_error);
  EXPECT_EQ(get("scene.d"), "scene.png: \\\n  scene.sdl \\\n  lib.sdl\nlib.sdl:\n");
  EXPECT_EQ(call({"none.sdl", "-MD"}), ExitCode::file_error);
  EXPECT_EQ(get("none.d"), "none.png: \\\n  none.sdl\nnone.sdl:\n");
}

TEST_F(Dependencies, NeverReplaceAnInputOrTheOutput) {
  EXPECT_EQ(call({"scene.sdl", "-MD", "-MF", "./scene.sdl"}), ExitCode::usage);
  EXPECT_EQ(call({"scene.sdl", "-MD", "-MF", "scene.png"}), ExitCode::usage);
  const std::string before = get("lib.sdl");
  EXPECT_EQ(call({"scene.sdl", "-MD", "-MF", "lib.sdl"}), ExitCode::file_error);
  EXPECT_THAT(err_.str(), HasSubstr("E0622"));
  EXPECT_EQ(get("lib.sdl"), before);
  EXPECT_FALSE(fs::exists("scene.png"));
  EXPECT_EQ(call({"scene.sdl", "-MD", "-MF", "no/such/a.d"}), ExitCode::file_error);
}

TEST_F(Dependencies, NinjaUnderstandsThem) {
  if (std::system("ninja --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "no ninja";
  const std::string odd = "li b#1:$x.sdl";
  fs::rename("lib.sdl", odd);
  std::string scene = get("scene.sdl");
  scene.replace(scene.find("lib.sdl"), 7, odd);
  put("scene.sdl", scene);
  ASSERT_EQ(call({"scene.sdl", "-o", "o.png", "-MD", "-MF", "d.in"}), ExitCode::ok) << err_.str();
  // Ninja reads the file once the command has run, so the command here hands it over.
  put("build.ninja",
      "rule r\n  command = cp d.in d && touch o.png && echo ran >> log\n  depfile = d\n"
      "build o.png: r\n");
  const char* const build = "ninja >/dev/null 2>&1";
  ASSERT_EQ(std::system(build), 0);
  ASSERT_EQ(std::system(build), 0);
  EXPECT_EQ(get("log"), "ran\n");
  fs::last_write_time(odd, fs::file_time_type::clock::now() + std::chrono::seconds(5));
  ASSERT_EQ(std::system(build), 0);
  EXPECT_EQ(get("log"), "ran\nran\n");
}

TEST_F(Dependencies, MakeUnderstandsThem) {
  if (std::system("make --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "no make";
  const std::string odd = "li b#1:$x.sdl";
  fs::rename("lib.sdl", odd);
  std::string scene = get("scene.sdl");
  scene.replace(scene.find("lib.sdl"), 7, odd);
  put("sc ene.sdl", scene);
  ASSERT_EQ(call({"sc ene.sdl", "-o", "o:u #t.png", "-MD", "-MF", "d"}), ExitCode::ok)
      << err_.str();
  EXPECT_TRUE(is_up_to_date(get("d"), "o:u #t.png")) << get("d");
  fs::last_write_time(odd, fs::file_time_type::clock::now() + std::chrono::seconds(5));
  EXPECT_FALSE(is_up_to_date(get("d"), "o:u #t.png")) << get("d");
}

}  // namespace
}  // namespace scenec::runtime
