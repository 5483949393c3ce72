// Where pictures may go: bad places are refused before rendering, a full disk leaves nothing
// partial, and the bytes do not depend on the number of threads.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/process/child.hpp"

namespace {

namespace fs = std::filesystem;
using scenec::test::Child;
using scenec::test::ChildResult;
using scenec::test::Sandbox;
using testing::ElementsAre;
using testing::HasSubstr;

// Would render for minutes, were it not refused.
const std::vector<std::string> long_render{"scene.sdl", "--size",     "4000x4000", "--samples",
                                           "10000",     "--progress", "none"};

class Output : public testing::Test {
 protected:
  void SetUp() override { sandbox_.write("scene.sdl", scenec::test::small_scene); }

  ChildResult run(std::vector<std::string> words, const std::vector<std::string>& more) const {
    words.insert(words.end(), more.begin(), more.end());
    return scenec::test::run_child(
        words, {.directory = sandbox_.path(), .file_size_limit = {}, .standard_output = {}});
  }
  void expect_refused(const std::string& path, std::string_view reason) const {
    const ChildResult result = run(long_render, {"-o", path});
    EXPECT_EQ(result.exit_code, 3) << path << "\n" << result.err;
    EXPECT_THAT(result.err, HasSubstr(std::string(reason))) << path;
    EXPECT_LT(result.seconds, 2) << path;
  }

  Sandbox sandbox_;
};

TEST_F(Output, BadPlacesAreRefusedBeforeRendering) {
  fs::create_directory(sandbox_.path() / "folder.png");
  sandbox_.write("locked.png", "old");
  fs::permissions(sandbox_.path() / "locked.png", fs::perms::owner_read);
  expect_refused("folder.png", "is a directory");
  expect_refused("none/out.png", "does not exist");
  expect_refused("scene.sdl/out.png", "directory");
  expect_refused("locked.png", "is read-only");
  expect_refused("/dev/full", "not a regular file");
  expect_refused("out.jpeg", "`.png`");
  expect_refused("out", "no extension");
  expect_refused(std::string(300, 'x') + ".png", "too long");
  EXPECT_EQ(scenec::test::bytes_of(sandbox_.path() / "locked.png"), "old");
  EXPECT_THAT(sandbox_.names(), ElementsAre("folder.png", "locked.png", "scene.sdl"));
}

TEST_F(Output, AnInputIsNeverReplaced) {
  const ChildResult result = run({"dump", "scene.sdl"}, {"-o", "./scene.sdl"});
  EXPECT_EQ(result.exit_code, 3) << result.err;
  EXPECT_EQ(scenec::test::bytes_of(sandbox_.path() / "scene.sdl"), scenec::test::small_scene);
}

TEST_F(Output, AFullDiskLeavesNoPartialFile) {
  sandbox_.write("out.exr", "old");
  Child child({"scene.sdl", "-o", "out.exr", "--size", "256x256", "--samples", "1"},
              {.directory = sandbox_.path(), .file_size_limit = 8192, .standard_output = {}});
  const ChildResult result = child.wait();
  EXPECT_EQ(result.exit_code, 3) << result.err;
  EXPECT_THAT(result.err, HasSubstr("out.exr"));
  EXPECT_EQ(scenec::test::bytes_of(sandbox_.path() / "out.exr"), "old");
  EXPECT_THAT(sandbox_.names(), ElementsAre("out.exr", "scene.sdl"));
}

TEST_F(Output, StandardOutputThatIsFullIsAnError) {
  Child child(
      {"dump", "scene.sdl"},
      {.directory = sandbox_.path(), .file_size_limit = {}, .standard_output = "/dev/full"});
  EXPECT_EQ(child.wait().exit_code, 3);
}

TEST_F(Output, ThreadsDoNotChangeABit) {
  for (const char* const name : {"one.png", "two.png", "one.exr", "two.exr"}) {
    const std::string threads = std::string(name).starts_with("one") ? "1" : "2";
    const ChildResult result =
        run({"scene.sdl"}, {"-o", name, "--threads", threads, "--size", "120x90"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
  }
  for (const char* const extension : {".png", ".exr"}) {
    const std::string one =
        scenec::test::bytes_of(sandbox_.path() / (std::string("one") + extension));
    EXPECT_GT(one.size(), 100u);
    EXPECT_EQ(one, scenec::test::bytes_of(sandbox_.path() / (std::string("two") + extension)));
  }
}

TEST_F(Output, ThePictureIsNamedAfterTheSceneAndLandsInTheWorkingDirectory) {
  fs::create_directory(sandbox_.path() / "scenes");
  fs::rename(sandbox_.path() / "scene.sdl", sandbox_.path() / "scenes" / "ball.sdl");
  const ChildResult result = run({"scenes/ball.sdl"}, {});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(sandbox_.names(), ElementsAre("ball.png", "scenes"));
}

}  // namespace
