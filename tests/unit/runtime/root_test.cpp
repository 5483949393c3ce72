#include "runtime/root.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/unit/base/temporary_directory.hpp"

namespace scenec::runtime {
namespace {

namespace fs = std::filesystem;

// desk/scenes/a.sdl, course/scenes/a.txt and aside/b.sdl; `desk` is the working directory.
class Root : public testing::Test {
 protected:
  void SetUp() override {
    before_ = fs::current_path();
    for (const char* const folder : {"desk/scenes", "course/scenes", "aside", "desktop"}) {
      fs::create_directories(fs::path(directory_.path()) / folder);
    }
    directory_.write("desk/scenes/a.sdl", "sdl 1;\n");
    directory_.write("course/scenes/a.txt", "Group {}\n");
    directory_.write("course/scenes/native.txt", "sdl 1;\n");
    fs::current_path(directory_ / "desk");
  }
  void TearDown() override { fs::current_path(before_); }

  test::TemporaryDirectory directory_;
  fs::path before_;
};

TEST_F(Root, IsTheWorkingDirectoryForWhatLiesBeneathIt) {
  EXPECT_EQ(root_of({}, "a.sdl"), ".");
  EXPECT_EQ(root_of({}, "scenes/a.sdl"), ".");
  EXPECT_EQ(root_of({}, "scenes/a.txt"), ".");
  EXPECT_EQ(root_of({}, directory_ / "desk/scenes/a.sdl"), ".");
  EXPECT_EQ(root_of({}, "../desk/a.sdl"), ".");
}

TEST_F(Root, IsElseWhereTheSceneLies) {
  EXPECT_EQ(root_of({}, "../aside/b.sdl"), "../aside");
  EXPECT_EQ(root_of({}, directory_ / "aside/b.sdl"), directory_ / "aside");
  EXPECT_EQ(root_of({}, "../a.sdl"), "..");
  EXPECT_EQ(root_of({}, "../desktop/a.sdl"), "../desktop") << "a longer name is not beneath";
}

TEST_F(Root, IsTheParentOfACourseScene) {
  EXPECT_EQ(root_of({}, "../course/scenes/a.txt"), "../course");
  EXPECT_EQ(root_of({}, "../course/scenes/native.txt"), "../course/scenes");
  Options options;
  options.dialect = grammar::Dialect::course;
  EXPECT_EQ(root_of(options, "../course/scenes/native.txt"), "../course");
  options.dialect = grammar::Dialect::sdl;
  EXPECT_EQ(root_of(options, "../course/scenes/a.txt"), "../course/scenes");
}

TEST_F(Root, IsWhatTheOptionNames) {
  Options options;
  options.root = "/";
  EXPECT_EQ(root_of(options, "scenes/a.sdl"), "/");
}

TEST_F(Root, ASceneLiesWhereItsFolderLeads) {
  fs::create_directory_symlink(directory_ / "aside", directory_ / "desk/link");
  fs::create_directory_symlink(directory_ / "desk/scenes", directory_ / "aside/back");
  EXPECT_EQ(root_of({}, "link/b.sdl"), "link");
  EXPECT_EQ(root_of({}, "../aside/back/a.sdl"), "../aside/back");
}

}  // namespace
}  // namespace scenec::runtime
