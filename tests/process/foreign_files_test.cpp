// Scenes that name what is no file of theirs: each is one located error within 2 s and 256 MiB, and
// nothing is read that lies outside the root.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <string>

#include "tests/process/child.hpp"

namespace {

namespace fs = std::filesystem;
using scenec::test::ChildResult;
using scenec::test::Sandbox;
using testing::HasSubstr;

const std::string head = "sdl 1;\nmaterial matt: diffuse { color = gray(0.5); }\n";
const std::string rest =
    "sphere { radius = 1m; material = matt; }\n"
    "light: point { position = [0, 3, 3]; power = 60W; }\n"
    "camera main: pinhole { eye = [0, 0, 5]; aim = [0, 0, 0]; fov = 40deg; }\n";

// SANDBOX/secret.sdl and SANDBOX/desk/scene.sdl; `desk` is the working directory.
class ForeignFiles : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directory(desk());
    sandbox_.write("secret.sdl", "sdl 1;\nlet secret = 42;\n");
  }
  [[nodiscard]] fs::path desk() const { return sandbox_.path() / "desk"; }
  void link(const std::string& name, const std::string& target) const {
    fs::create_symlink(target, desk() / name);
  }
  [[nodiscard]] ChildResult check(const std::string& text) const {
    sandbox_.write("desk/scene.sdl", head + text + rest);
    return scenec::test::run_child(
        {"check", "scene.sdl"},
        {.directory = desk(), .file_size_limit = {}, .standard_output = {}});
  }
  void expect_error(const std::string& text, const std::string& code) const {
    const ChildResult result = check(text);
    EXPECT_EQ(result.exit_code, 1) << result.err;
    EXPECT_THAT(result.err, HasSubstr("error[" + code + "]")) << text;
    EXPECT_THAT(result.err, HasSubstr("\n1 error")) << text;
    EXPECT_EQ(result.err.find("42"), std::string::npos) << result.err;
    scenec::test::expect_bounded(result, text.substr(0, text.find('\n')));
  }
  void expect_include_error(const std::string& path, const std::string& code) const {
    expect_error("include \"" + path + "\" as other;\n", code);
  }
  void expect_asset_error(const std::string& path, const std::string& code) const {
    expect_error("mesh { file = \"" + path + "\"; material = matt; }\n", code);
  }

  Sandbox sandbox_;
};

TEST_F(ForeignFiles, PathsThatLeadOutOfTheRoot) {
  link("link.sdl", "../secret.sdl");
  link("up", "..");
  link("proc.sdl", "/proc/self/root" + (sandbox_.path() / "secret.sdl").string());
  link("cwd", "/proc/self/cwd");
  const std::string absolute = (sandbox_.path() / "secret.sdl").string();
  for (const std::string& path :
       {std::string("../secret.sdl"), std::string("link.sdl"), std::string("up/secret.sdl"),
        std::string("proc.sdl"), std::string("cwd/../secret.sdl"), absolute}) {
    // `cwd/..` is the working directory by its name.
    expect_include_error(path, path.starts_with("cwd/") ? "E0601" : "E0602");
  }
  expect_asset_error("../secret.obj", "E0602");
  expect_asset_error("/etc/passwd", "E0602");
}

TEST_F(ForeignFiles, DevicesAndPipes) {
  ASSERT_EQ(::mkfifo((desk() / "pipe.sdl").c_str(), 0600), 0);
  link("zero.sdl", "/dev/zero");
  expect_include_error("pipe.sdl", "E0601");
  expect_include_error("zero.sdl", "E0602");
  expect_include_error("/dev/zero", "E0602");
  expect_include_error("/dev/stdin", "E0602");
  fs::rename(desk() / "pipe.sdl", desk() / "pipe.obj");
  expect_asset_error("pipe.obj", "E0601");
}

TEST_F(ForeignFiles, CyclesOfIncludes) {
  sandbox_.write("desk/a.sdl",
                 "sdl 1;\ninclude \"b.sdl\" as b;\n@allow(unused_declaration) let x = b.y;\n");
  sandbox_.write("desk/b.sdl", "sdl 1;\ninclude \"a.sdl\" as a;\nlet y = a.x;\n");
  expect_include_error("a.sdl", "E0244");
  expect_include_error("scene.sdl", "E0244");
}

TEST_F(ForeignFiles, TheRootCanBeMoved) {
  sandbox_.write("desk/scene.sdl", head +
                                       "include \"../secret.sdl\" as other;\n"
                                       "assert other.secret == 42, \"read\";\n" +
                                       rest);
  const auto run = [&](const std::string& root) {
    return scenec::test::run_child(
               {"check", "--root", root, "scene.sdl"},
               {.directory = desk(), .file_size_limit = {}, .standard_output = {}})
        .exit_code;
  };
  EXPECT_EQ(run(".."), 0);
  EXPECT_EQ(run("/"), 0);
  EXPECT_EQ(run("."), 1);
  EXPECT_EQ(run("missing"), 2);
}

}  // namespace
