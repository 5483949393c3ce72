#include "base/file_system.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <thread>

#include "tests/unit/base/temporary_directory.hpp"

namespace scenec {
namespace {

using test::TemporaryDirectory;
constexpr std::uint64_t no_limit = 1U << 30;

class RealFiles : public testing::Test {
 protected:
  FileError error_of(const std::string& path, std::uint64_t limit = no_limit) {
    const auto content = files.read(path, limit);
    EXPECT_FALSE(content.ok()) << path;
    return content.ok() ? FileError::read_failed : content.error();
  }

  TemporaryDirectory directory;
  RealFileSystem files;
};

TEST_F(RealFiles, ReadsBytes) {
  const std::string bytes("a\0b\r\n\xff", 6);
  const auto content = files.read(directory.write("a.sdl", bytes), no_limit);
  ASSERT_TRUE(content.ok());
  EXPECT_EQ(content.value().bytes, bytes);
  EXPECT_TRUE(files.is_file(directory / "a.sdl"));
}

TEST_F(RealFiles, ReadsEmptyAndLargeFiles) {
  const auto empty = files.read(directory.write("empty", ""), 0);
  ASSERT_TRUE(empty.ok());
  EXPECT_EQ(empty.value().bytes, "");
  const std::string large(5'000'000, 'x');
  const auto content = files.read(directory.write("large", large), no_limit);
  ASSERT_TRUE(content.ok());
  EXPECT_EQ(content.value().bytes, large);
}

TEST_F(RealFiles, ContentOutlivesTheFile) {
  const auto content = files.read(directory.write("a", "kept"), no_limit);
  std::filesystem::remove(directory / "a");
  EXPECT_EQ(content.value().bytes, "kept");
}

TEST_F(RealFiles, SaysWhyNot) {
  EXPECT_EQ(error_of(directory / "absent"), FileError::not_found);
  EXPECT_EQ(error_of(""), FileError::not_found);
  EXPECT_EQ(error_of(directory.path()), FileError::is_directory);
  EXPECT_EQ(error_of(directory.write("file", "x") + "/below"), FileError::not_found);
  EXPECT_EQ(error_of("/dev/zero"), FileError::not_regular);
  EXPECT_EQ(error_of("/dev/null"), FileError::not_regular);
  EXPECT_EQ(error_of(std::string(5000, 'x')), FileError::not_found);
  std::filesystem::create_symlink("loop", directory / "loop");
  EXPECT_EQ(error_of(directory / "loop"), FileError::not_found);
  std::filesystem::create_symlink("nowhere", directory / "dangling");
  EXPECT_EQ(error_of(directory / "dangling"), FileError::not_found);
  EXPECT_FALSE(files.is_file(directory.path()));
  EXPECT_FALSE(files.is_file("/dev/null"));
}

TEST_F(RealFiles, ANameWithNulIsNotAShorterName) {
  std::string path = directory.write("a", "x");
  path += std::string("\0.sdl", 5);
  EXPECT_EQ(error_of(path), FileError::not_found);
  EXPECT_FALSE(files.is_file(path));
}

TEST_F(RealFiles, FifosAndSocketsDoNotHang) {
  ASSERT_EQ(::mkfifo((directory / "fifo").c_str(), 0600), 0);
  EXPECT_EQ(error_of(directory / "fifo"), FileError::not_regular);

  const int socket = ::socket(AF_UNIX, SOCK_STREAM, 0);
  ASSERT_GE(socket, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  (directory / "socket").copy(address.sun_path, sizeof address.sun_path - 1);
  const auto* generic = static_cast<const sockaddr*>(static_cast<const void*>(&address));
  ASSERT_EQ(::bind(socket, generic, sizeof address), 0);
  EXPECT_EQ(error_of(directory / "socket"), FileError::not_regular);
  ::close(socket);
}

TEST_F(RealFiles, PermissionsAreSaid) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may read everything";
  const std::string path = directory.write("secret", "x");
  ::chmod(path.c_str(), 0);
  EXPECT_EQ(error_of(path), FileError::no_permission);
}

TEST_F(RealFiles, LimitIsInclusive) {
  const std::string path = directory.write("ten", "0123456789");
  EXPECT_TRUE(files.read(path, 10).ok());
  EXPECT_EQ(error_of(path, 9), FileError::too_large);
  // A sparse file of 1 TiB: refused by its size, before any memory is asked for.
  const std::string sparse = directory.write("sparse", "");
  if (::truncate(sparse.c_str(), off_t{1} << 40) == 0) {
    EXPECT_EQ(error_of(sparse), FileError::too_large);
  }
}

// Files of /proc say they are empty; what counts is what they give.
TEST_F(RealFiles, FilesLargerThanTheySayAreReadWhole) {
  const auto content = files.read("/proc/self/status", no_limit);
  ASSERT_TRUE(content.ok());
  EXPECT_NE(content.value().bytes.find("VmPeak"), std::string_view::npos);
  EXPECT_EQ(error_of("/proc/self/status", 10), FileError::too_large);
}

TEST_F(RealFiles, GrowingFileEndsSomewhere) {
  const std::string path = directory.write("log", "start\n");
  constexpr int longest = 200'000;  // lines; far below the limit of 1 GiB
  std::jthread writer([&](const std::stop_token& stop) {
    std::ofstream stream(path, std::ios::app);
    for (int i = 0; i < longest && !stop.stop_requested(); ++i) stream << "a line\n" << std::flush;
  });
  std::size_t size = 0;
  for (int i = 0; i < 100; ++i) {
    const auto content = files.read(path, no_limit);
    ASSERT_TRUE(content.ok());
    ASSERT_TRUE(content.value().bytes.starts_with("start\n"));
    ASSERT_GE(content.value().bytes.size(), size);
    size = content.value().bytes.size();
  }
}

TEST(FileErrors, HaveTexts) {
  EXPECT_EQ(text_of(FileError::not_found), "no such file");
  EXPECT_EQ(text_of(FileError::is_directory), "is a directory");
  EXPECT_EQ(text_of(FileError::not_regular), "is not a regular file");
}

// ---- memory and recording -----------------------------------------------------------------------

TEST(MemoryFiles, BehaveLikeFiles) {
  MemoryFileSystem files;
  files.put("a.sdl", "one");
  const auto first = files.read("a.sdl", 3);
  files.put("a.sdl", "two!");
  EXPECT_EQ(first.value().bytes, "one");  // what was read stays
  EXPECT_EQ(files.read("a.sdl", 4).value().bytes, "two!");
  EXPECT_EQ(files.read("a.sdl", 3).error(), FileError::too_large);
  EXPECT_EQ(files.read("b.sdl", 3).error(), FileError::not_found);
  EXPECT_TRUE(files.is_file("a.sdl"));
  EXPECT_FALSE(files.is_file("b.sdl"));
}

TEST(Recording, RemembersReadsAndMisses) {
  MemoryFileSystem memory;
  memory.put("z.sdl", "zz");
  memory.put("seen.sdl", "s");
  RecordingFileSystem files(memory);
  EXPECT_TRUE(files.read("z.sdl", no_limit).ok());
  EXPECT_FALSE(files.read("absent.png", no_limit).ok());
  EXPECT_FALSE(files.is_file("maybe.sdl"));
  EXPECT_TRUE(files.is_file("seen.sdl"));
  EXPECT_TRUE(files.is_file("z.sdl"));  // keeps the hash
  const auto records = files.records();
  ASSERT_EQ(records.size(), 4U);
  EXPECT_EQ(records[0].path, "absent.png");
  EXPECT_FALSE(records[0].found);
  EXPECT_EQ(records[1].path, "maybe.sdl");
  EXPECT_FALSE(records[1].found);
  EXPECT_EQ(records[2].path, "seen.sdl");
  EXPECT_TRUE(records[2].found);
  EXPECT_EQ(records[2].hash, Hash128{});
  EXPECT_EQ(records[3].path, "z.sdl");
  EXPECT_EQ(records[3].hash, hash_bytes("zz"));
}

TEST(Recording, KeepsTheFirstContent) {
  MemoryFileSystem memory;
  memory.put("a", "first");
  RecordingFileSystem files(memory);
  (void)files.read("a", no_limit);
  memory.put("a", "second");
  (void)files.read("a", no_limit);
  EXPECT_EQ(files.records().at(0).hash, hash_bytes("first"));
}

TEST(Recording, AMissThatTurnsUpIsFound) {
  MemoryFileSystem memory;
  RecordingFileSystem files(memory);
  EXPECT_FALSE(files.is_file("a"));
  memory.put("a", "now");
  (void)files.read("a", no_limit);
  ASSERT_EQ(files.records().size(), 1U);
  EXPECT_TRUE(files.records()[0].found);
  EXPECT_EQ(files.records()[0].hash, hash_bytes("now"));
}

TEST(Recording, ManyThreadsMayRead) {
  MemoryFileSystem memory;
  for (int i = 0; i < 50; ++i) memory.put(std::to_string(i), "x");
  RecordingFileSystem files(memory);
  {
    std::vector<std::jthread> threads;
    for (int thread = 0; thread < 4; ++thread) {
      threads.emplace_back([&] {
        for (int i = 0; i < 100; ++i) (void)files.read(std::to_string(i), no_limit);
      });
    }
  }
  EXPECT_EQ(files.records().size(), 100U);
}

// ---- paths --------------------------------------------------------------------------------------

TEST(Paths, AreNormalised) {
  EXPECT_EQ(normalized_path("a//b/./c/"), "a/b/c");
  EXPECT_EQ(normalized_path("a/../b"), "b");
  EXPECT_EQ(normalized_path("../../a"), "../../a");
  EXPECT_EQ(normalized_path("a/../../b"), "../b");
  EXPECT_EQ(normalized_path("/../a"), "/a");
  EXPECT_EQ(normalized_path("/"), "/");
  EXPECT_EQ(normalized_path("a/.."), ".");
  EXPECT_EQ(normalized_path(""), ".");
}

TEST(Paths, AreTakenApartAndJoined) {
  EXPECT_EQ(directory_of("scene.sdl"), "");
  EXPECT_EQ(directory_of("a/b/scene.sdl"), "a/b");
  EXPECT_EQ(directory_of("/scene.sdl"), "/");
  EXPECT_EQ(joined_path("", "a.png"), "a.png");
  EXPECT_EQ(joined_path("dir", "a.png"), "dir/a.png");
  EXPECT_EQ(joined_path("dir/sub", "../a.png"), "dir/a.png");
  EXPECT_EQ(joined_path("dir", "/abs/a.png"), "/abs/a.png");
  EXPECT_EQ(joined_path("/", "a"), "/a");
  EXPECT_EQ(extension_of("a/B.PNG"), ".png");
  EXPECT_EQ(extension_of("a.tar.gz"), ".gz");
  EXPECT_EQ(extension_of("dir.d/file"), "");
  EXPECT_EQ(extension_of(".profile"), "");
  EXPECT_EQ(extension_of("x."), ".");
}

TEST(Paths, AreMadeRelative) {
  EXPECT_EQ(relative_path("/a/b/c.sdl", "/a"), "b/c.sdl");
  EXPECT_EQ(relative_path("/a/b", "/a/c/d"), "../../b");
  EXPECT_EQ(relative_path("a/b", ""), "a/b");
  EXPECT_EQ(relative_path("a", "a"), ".");
  EXPECT_EQ(relative_path("a", "b"), "../a");
  EXPECT_EQ(relative_path("/abs", "rel"), "/abs");
  EXPECT_EQ(relative_path("a", "../b"), "a");  // not known from the text alone
  EXPECT_EQ(relative_path("../b/c", "../b"), "c");
}

}  // namespace
}  // namespace scenec
