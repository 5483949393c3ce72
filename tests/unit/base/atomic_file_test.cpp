#include "base/atomic_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <thread>
#include <vector>

#include "tests/unit/base/temporary_directory.hpp"

namespace scenec {
namespace {

using std::filesystem::create_symlink;
using test::TemporaryDirectory;
using testing::Optional;
using Names = std::set<std::string>;

class AtomicFile : public testing::Test {
 protected:
  TemporaryDirectory directory;
};

mode_t mode_of(const std::string& path) {
  struct stat info{};
  EXPECT_EQ(::stat(path.c_str(), &info), 0);
  return info.st_mode & 07777;
}

TEST_F(AtomicFile, WritesNewAndReplacesOld) {
  const std::string path = directory / "out.png";
  const std::string bytes("new\0bytes", 9);
  EXPECT_EQ(find_output_problem(path), std::nullopt);
  EXPECT_EQ(write_file_atomically(path, bytes), std::nullopt);
  EXPECT_EQ(directory.read(path), bytes);
  EXPECT_EQ(write_file_atomically(path, ""), std::nullopt);
  EXPECT_EQ(directory.read(path), "");
  EXPECT_EQ(directory.entries(), Names{"out.png"});
}

TEST_F(AtomicFile, KeepsTheModeOfWhatItReplaces) {
  const std::string path = directory.write("out", "old");
  ::chmod(path.c_str(), 0640);
  EXPECT_EQ(write_file_atomically(path, "new"), std::nullopt);
  EXPECT_EQ(mode_of(path), 0640U);
  const mode_t mask = ::umask(027);
  EXPECT_EQ(write_file_atomically(directory / "fresh", "x"), std::nullopt);
  ::umask(mask);
  EXPECT_EQ(mode_of(directory / "fresh"), 0640U);
}

TEST_F(AtomicFile, BareNamesLieInTheWorkingDirectory) {
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(directory.path());
  EXPECT_EQ(write_file_atomically("bare", "x"), std::nullopt);
  std::filesystem::current_path(before);
  EXPECT_EQ(directory.read(directory / "bare"), "x");
}

TEST_F(AtomicFile, TheLongestNameIsWritten) {
  const std::string path = directory / std::string(255, 'n');
  EXPECT_EQ(write_file_atomically(path, "x"), std::nullopt);
  EXPECT_EQ(directory.read(path), "x");
  EXPECT_THAT(write_file_atomically(directory / std::string(256, 'n'), "x"),
              Optional(std::string("file name too long")));
}

TEST_F(AtomicFile, LinksAreWrittenThrough) {
  directory.write("target", "old");
  create_symlink("target", directory / "link");
  create_symlink("link", directory / "link to link");
  EXPECT_EQ(write_file_atomically(directory / "link to link", "new"), std::nullopt);
  EXPECT_TRUE(std::filesystem::is_symlink(directory / "link"));
  EXPECT_EQ(directory.read(directory / "target"), "new");

  std::filesystem::create_directory(directory / "sub");
  create_symlink("sub/fresh", directory / "dangling");
  EXPECT_EQ(write_file_atomically(directory / "dangling", "made"), std::nullopt);
  EXPECT_EQ(directory.read(directory / "sub/fresh"), "made");
  EXPECT_EQ(directory.entries(), (Names{"target", "link", "link to link", "sub", "dangling"}));
}

// ---- refused before any work --------------------------------------------------------------------

void expect_refused(const std::string& path, const std::string& text) {
  EXPECT_THAT(find_output_problem(path), Optional(testing::HasSubstr(text))) << path;
  EXPECT_THAT(write_file_atomically(path, "x"), Optional(testing::HasSubstr(text))) << path;
}

TEST_F(AtomicFile, PlacesThatHoldNoFileAreRefused) {
  expect_refused("", "empty");
  expect_refused(std::string("a\0b", 3), "NUL");
  expect_refused(directory.path(), "is a directory");
  expect_refused(directory / "out/", "directory");
  expect_refused(directory / "absent/out.png", "absent` does not exist");
  expect_refused("/dev/full", "is not a regular file");
  expect_refused("/dev/null", "is not a regular file");
  expect_refused(directory.write("file", "x") + "/out.png", "is not a directory");
  ASSERT_EQ(::mkfifo((directory / "fifo").c_str(), 0600), 0);
  expect_refused(directory / "fifo", "is not a regular file");
  create_symlink("/dev/full", directory / "full");
  expect_refused(directory / "full", "is not a regular file");
  create_symlink("loop", directory / "loop");
  expect_refused(directory / "loop", "too many levels of symbolic links");
  create_symlink("absent/x", directory / "far");
  expect_refused(directory / "far", "does not exist");
  EXPECT_EQ(directory.entries(), (Names{"file", "fifo", "full", "loop", "far"}));
}

// Root may write anywhere; the bits say what the owner meant.
TEST_F(AtomicFile, ReadOnlyIsRefusedEvenForRoot) {
  const std::string path = directory.write("out.png", "precious");
  ::chmod(path.c_str(), 0444);
  expect_refused(path, "is read-only");
  EXPECT_EQ(directory.read(path), "precious");
  create_symlink("out.png", directory / "link");
  expect_refused(directory / "link", "is read-only");

  std::filesystem::create_directory(directory / "locked");
  ::chmod((directory / "locked").c_str(), 0555);
  expect_refused(directory / "locked/out.png", "is not writable");
  ::chmod((directory / "locked").c_str(), 0755);
}

// ---- failures while writing ---------------------------------------------------------------------

// Runs `work` in a child process and returns how it ended, so that limits do not touch the others.
template <class Work>
int in_child(Work work) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(work());
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

// A file size limit fails in the middle of a write as a full disk does; its signal, whose default
// is to end the process, must not.
TEST_F(AtomicFile, AFullDiskLeavesTheOldFileAndNothingElse) {
  const std::string path = directory.write("out.exr", "old");
  const std::string bytes(1 << 20, 'x');
  const int ended = in_child([&] {
    const rlimit limit{100000, 100000};
    if (::setrlimit(RLIMIT_FSIZE, &limit) != 0) return 10;
    const auto problem = write_file_atomically(path, bytes);
    if (!problem || *problem != "file too large") return 11;
    if (write_file_atomically(path, "small")) return 12;  // and goes on
    return write_file_atomically(path + "2", bytes) ? 0 : 13;
  });
  EXPECT_EQ(ended, 0);
  EXPECT_EQ(directory.read(path), "small");
  EXPECT_EQ(directory.entries(), Names{"out.exr"});
}

TEST_F(AtomicFile, TheSizeSignalIsDeliveredAsBeforeAfterwards) {
  const int ended = in_child([&] {
    if (write_file_atomically(directory / "out", "x")) return 10;
    ::raise(SIGXFSZ);
    return 11;
  });
  EXPECT_EQ(ended, -SIGXFSZ);
}

TEST_F(AtomicFile, NoDescriptorsLeft) {
  const int ended = in_child([&] {
    const rlimit limit{3, 3};
    if (::setrlimit(RLIMIT_NOFILE, &limit) != 0) return 10;
    const auto problem = write_file_atomically(directory / "out", "x");
    return problem && *problem == "too many open files" ? 0 : 11;
  });
  EXPECT_EQ(ended, 0);
  EXPECT_EQ(directory.entries(), Names{});
}

TEST_F(AtomicFile, LeftoversOfOtherProcessesAreNotTouched) {
  const std::string left = ".out.tmp-" + std::to_string(::getpid());
  directory.write(left, "leftover");
  EXPECT_EQ(write_file_atomically(directory / "out", "x"), std::nullopt);
  EXPECT_EQ(directory.read(directory / left), "leftover");
  EXPECT_EQ(directory.entries(), (Names{left, "out"}));
}

TEST_F(AtomicFile, ManyWritersLeaveOneCompleteFile) {
  const std::string path = directory / "out";
  {
    std::vector<std::jthread> threads;
    for (char letter = 'a'; letter < 'e'; ++letter) {
      threads.emplace_back([&, letter] {
        for (int i = 0; i < 20; ++i) {
          EXPECT_EQ(write_file_atomically(path, std::string(10000, letter)), std::nullopt);
        }
      });
    }
  }
  const std::string bytes = directory.read(path);
  ASSERT_EQ(bytes.size(), 10000U);
  EXPECT_EQ(bytes, std::string(10000, bytes[0]));
  EXPECT_EQ(directory.entries(), Names{"out"});
}

}  // namespace
}  // namespace scenec
