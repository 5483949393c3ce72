#include "base/rooted_file_system.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "tests/unit/base/temporary_directory.hpp"

namespace scenec {
namespace {

namespace fs = std::filesystem;
using Walk = RootedFileSystem::Walk;

// outside/secret and outside/root/{a.sdl, sub/b.sdl}; the root is outside/root.
class RootedFiles : public testing::TestWithParam<Walk> {
 protected:
  void SetUp() override {
    fs::create_directories(fs::path(root()) / "sub");
    directory_.write("secret", "secret");
    directory_.write("root/a.sdl", "a");
    directory_.write("root/sub/b.sdl", "b");
  }
  [[nodiscard]] std::string outside() const { return directory_.path(); }
  [[nodiscard]] std::string root() const { return directory_ / "root"; }
  // A symbolic link in the root.
  void link(const std::string& name, const std::string& target) const {
    fs::create_symlink(target, fs::path(root()) / name);
  }
  // The bytes of a file named from the root, or why there are none.
  [[nodiscard]] std::string read(const std::string& path) const {
    return read_absolute(path.starts_with('/') ? path : root() + "/" + path);
  }
  [[nodiscard]] std::string read_absolute(const std::string& path) const {
    RootedFileSystem files(root(), GetParam());
    const auto content = files.read(path, 1000);
    EXPECT_EQ(files.is_file(path), content.ok() || content.error() == FileError::too_large) << path;
    return std::string(content ? content.value().bytes : text_of(content.error()));
  }

  test::TemporaryDirectory directory_;
  const std::string refused{text_of(FileError::outside_root)};
  const std::string absent{text_of(FileError::not_found)};
};

TEST_P(RootedFiles, ReadsWhatLiesBeneath) {
  EXPECT_EQ(read("a.sdl"), "a");
  EXPECT_EQ(read("sub/b.sdl"), "b");
  EXPECT_EQ(read("sub//../sub/./b.sdl"), "b");
  EXPECT_EQ(read("none"), absent);
  EXPECT_EQ(read("a.sdl/b"), absent);
  EXPECT_EQ(read("sub"), text_of(FileError::is_directory));
  EXPECT_EQ(read("."), text_of(FileError::is_directory));
  directory_.write("root/large", std::string(1001, 'x'));
  EXPECT_EQ(read("large"), text_of(FileError::too_large));
}

TEST_P(RootedFiles, RefusesPathsThatLeadOut) {
  EXPECT_EQ(read("../secret"), refused);
  EXPECT_EQ(read("sub/../../secret"), refused);
  EXPECT_EQ(read("../none"), refused) << "whether a file exists outside is nobody's business";
  EXPECT_EQ(read("/etc/passwd"), refused);
  EXPECT_EQ(read(root() + "x"), refused) << "a longer name is not beneath";
  EXPECT_EQ(read("/dev/zero"), refused);
  EXPECT_EQ(read("~/x"), absent) << "`~` is a name like any other";
  EXPECT_EQ(read("C:\\x"), absent);
  EXPECT_EQ(read("\n"), absent);
  EXPECT_EQ(read(std::string("a.sdl\0b", 7)), absent);
}

TEST_P(RootedFiles, FollowsLinksThatStay) {
  link("same", "a.sdl");
  link("down", "sub/b.sdl");
  link("directory", "sub");
  link("round", "sub/../directory/../a.sdl");
  link("absolute", root() + "/sub/b.sdl");
  link("to_absolute", "absolute");
  link("itself", ".");
  fs::create_symlink("../a.sdl", fs::path(root()) / "sub" / "up");
  EXPECT_EQ(read("same"), "a");
  EXPECT_EQ(read("down"), "b");
  EXPECT_EQ(read("directory/b.sdl"), "b");
  EXPECT_EQ(read("directory/up"), "a");
  EXPECT_EQ(read("round"), "a");
  EXPECT_EQ(read("absolute"), "b");
  EXPECT_EQ(read("to_absolute"), "b");
  EXPECT_EQ(read("itself/itself/a.sdl"), "a");
}

TEST_P(RootedFiles, RefusesLinksThatLeave) {
  link("up", "..");
  link("file", "../secret");
  link("absolute", outside() + "/secret");
  link("deep", "sub/../../secret");
  link("there_and_back", "../root/a.sdl");
  link("clever", root() + "/../secret");
  link("chain", "file");
  EXPECT_EQ(read("up/secret"), refused);
  EXPECT_EQ(read("file"), refused);
  EXPECT_EQ(read("absolute"), refused);
  EXPECT_EQ(read("deep"), refused);
  EXPECT_EQ(read("there_and_back"), refused);
  EXPECT_EQ(read("clever"), refused);
  EXPECT_EQ(read("chain"), refused);
}

TEST_P(RootedFiles, RefusesLinksOfProc) {
  link("root", "/proc/self/root" + outside() + "/secret");
  link("directory", "/proc/self/cwd");
  EXPECT_EQ(read("root"), refused);
  EXPECT_EQ(read("directory/CMakeCache.txt"), refused);
  // Beneath a root that is /proc itself, too.
  RootedFileSystem files("/proc/self", GetParam());
  EXPECT_FALSE(files.read("/proc/self/root/etc/passwd", 100000).ok());
  EXPECT_FALSE(files.is_file("/proc/self/cwd/CMakeCache.txt"));
}

TEST_P(RootedFiles, RefusesWhatIsNoRegularFile) {
  ASSERT_EQ(::mkfifo((root() + "/fifo").c_str(), 0600), 0);
  link("zero", "/dev/zero");
  link("to_fifo", "fifo");
  EXPECT_EQ(read("fifo"), text_of(FileError::not_regular));
  EXPECT_EQ(read("to_fifo"), text_of(FileError::not_regular));
  EXPECT_EQ(read("zero"), refused);
  RootedFileSystem everything("/", GetParam());
  const auto content = everything.read("/dev/zero", 1000);
  ASSERT_FALSE(content.ok());
  EXPECT_EQ(content.error(), FileError::not_regular);
}

TEST_P(RootedFiles, EndsLoopsOfLinks) {
  link("self", "self");
  link("ping", "pong");
  link("pong", "ping");
  link("growing", "growing/growing");
  link("dangling", "none");
  EXPECT_EQ(read("self"), absent);
  EXPECT_EQ(read("ping"), absent);
  EXPECT_EQ(read("growing"), absent);
  EXPECT_EQ(read("dangling"), absent);
}

TEST_P(RootedFiles, HardLinksAreFilesOfTheRoot) {
  fs::create_hard_link(outside() + "/secret", root() + "/hard");
  EXPECT_EQ(read("hard"), "secret");
}

TEST_P(RootedFiles, HardLinksAreRefusedWhereAsked) {
  fs::create_hard_link(outside() + "/secret", root() + "/hard");
  RootedFileSystem strict(root(), GetParam());
  strict.refuse_hard_links();
  const auto hard = strict.read(root() + "/hard", 100);
  ASSERT_FALSE(hard);
  EXPECT_EQ(hard.error(), FileError::outside_root);
  EXPECT_NE(strict.reason_of(hard.error()).find("--strict-links"), std::string::npos);
}

TEST_P(RootedFiles, TheRootMayBeNamedThroughALink) {
  fs::create_directory_symlink("root", directory_ / "alias");
  RootedFileSystem files(directory_ / "alias", GetParam());
  EXPECT_TRUE(files.is_file(directory_ / "alias/a.sdl"));
  EXPECT_TRUE(files.is_file(root() + "/a.sdl"));
  EXPECT_FALSE(files.is_file(outside() + "/secret"));
}

TEST_P(RootedFiles, KeepsItsRootWhenAnotherTakesTheName) {
  RootedFileSystem files(root(), GetParam());
  fs::rename(root(), directory_ / "moved");
  fs::create_directory_symlink("/etc", root());
  EXPECT_TRUE(files.is_file(root() + "/a.sdl"));
  EXPECT_FALSE(files.is_file(root() + "/passwd"));
}

TEST_P(RootedFiles, PermitsWhatTheUserNamed) {
  RootedFileSystem files(root(), GetParam());
  const std::string path = outside() + "/secret";
  files.permit(path);
  EXPECT_TRUE(files.is_file(path));
  EXPECT_TRUE(files.read(path, 100).ok());
  EXPECT_FALSE(files.is_file(outside() + "/./secret")) << "as it was named";
}

TEST_P(RootedFiles, SaysWhereTheRootIs) {
  const RootedFileSystem here(".", GetParam());
  EXPECT_EQ(here.reason_of(FileError::outside_root),
            "lies outside the root `.` (`--root DIR` moves it)");
  const RootedFileSystem there(root(), GetParam());
  EXPECT_NE(there.reason_of(FileError::outside_root).find("`" + root() + "`"), std::string::npos);
  EXPECT_EQ(there.reason_of(FileError::not_found), absent);
}

TEST_P(RootedFiles, AMissingRootHoldsNothing) {
  RootedFileSystem files(directory_ / "none", GetParam());
  const auto content = files.read(directory_ / "none/a", 100);
  ASSERT_FALSE(content.ok());
  EXPECT_EQ(content.error(), FileError::not_found);
}

INSTANTIATE_TEST_SUITE_P(BothWalks, RootedFiles, testing::Values(Walk::by_system, Walk::by_name),
                         [](const auto& walk) {
                           return walk.param == Walk::by_system ? "BySystem" : "ByName";
                         });

}  // namespace
}  // namespace scenec
