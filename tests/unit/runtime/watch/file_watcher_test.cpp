// The watcher against a real folder: what it says for each way of saving a file. Waiting ends with
// the event that is waited for, never with a sleep.
#include "runtime/watch/file_watcher.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <condition_variable>
#include <filesystem>

#include "runtime/watch/scene_folder.hpp"
#include "tests/unit/base/temporary_directory.hpp"

namespace scenec::runtime {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using test::TemporaryDirectory;

class Watched {
 public:
  explicit Watched(WatcherOptions options = {})
      : watcher_(
            options, [this](const FilesSettled& settled) { take(settled); },
            [this](const std::string& text) {
              const std::lock_guard lock(mutex_);
              notices_.push_back(text);
            }) {}

  // Reads the files as a compiler would, and waits until they are watched.
  void read(std::size_t scene, const std::vector<std::string>& paths) {
    RealFileSystem disk;
    RecordingFileSystem files(disk);
    for (const std::string& path : paths) static_cast<void>(files.read(path, 1 << 20));
    watcher_.watch(scene, files.records());
    watcher_.wait_until_armed();
  }

  // The next event that says so; nothing after ten seconds.
  std::optional<FilesSettled> next(std::chrono::milliseconds longest = 10s) {
    std::unique_lock lock(mutex_);
    if (!arrived_.wait_for(lock, longest, [&] { return !events_.empty(); })) return std::nullopt;
    FilesSettled event = events_.front();
    events_.erase(events_.begin());
    return event;
  }
  bool next_is_change(std::size_t scene = 0) {
    while (auto event = next()) {
      if (event->changed.contains(scene)) return true;
    }
    return false;
  }
  std::vector<std::string> notices() {
    const std::lock_guard lock(mutex_);
    return notices_;
  }
  FileWatcher& watcher() { return watcher_; }

 private:
  void take(const FilesSettled& settled) {
    const std::lock_guard lock(mutex_);
    events_.push_back(settled);
    arrived_.notify_all();
  }

  std::mutex mutex_;
  std::condition_variable arrived_;
  std::vector<FilesSettled> events_;
  std::vector<std::string> notices_;
  FileWatcher watcher_;
};

TEST(file_watcher, a_file_written_in_place_is_a_change_of_its_scenes) {
  const TemporaryDirectory folder;
  const std::string a = folder.write("a", "1");
  const std::string b = folder.write("b", "1");
  Watched watched;
  watched.read(0, {a});
  watched.read(1, {a, b});
  folder.write("b", "2");
  const auto event = watched.next();
  ASSERT_TRUE(event);
  EXPECT_EQ(event->changed, std::set<std::size_t>{1});
  folder.write("a", "2");
  const auto both = watched.next();
  ASSERT_TRUE(both);
  EXPECT_EQ(both->changed, (std::set<std::size_t>{0, 1}));
}

TEST(file_watcher, the_same_bytes_are_no_change) {
  const TemporaryDirectory folder;
  const std::string a = folder.write("a", "1");
  Watched watched;
  watched.read(0, {a});
  folder.write("a", "1");
  const auto event = watched.next();
  ASSERT_TRUE(event);
  EXPECT_TRUE(event->changed.empty());
  EXPECT_EQ(event->touched, std::set<std::size_t>{0});
}

TEST(file_watcher, a_rename_over_the_file_is_a_change_time_and_again) {
  const TemporaryDirectory folder;
  const std::string a = folder.write("a", "1");
  Watched watched;
  for (int i = 2; i < 5; ++i) {
    watched.read(0, {a});
    folder.write(".a.new", std::to_string(i));
    fs::rename(folder / ".a.new", a);
    EXPECT_TRUE(watched.next_is_change()) << i;
  }
}

TEST(file_watcher, vim_moves_the_file_away_and_writes_a_new_one) {
  const TemporaryDirectory folder;
  const std::string a = folder.write("a", "1");
  Watched watched;
  watched.read(0, {a});
  fs::rename(a, folder / "a~");
  folder.write("a", "2");
  fs::remove(folder / "a~");
  const auto event = watched.next();
  ASSERT_TRUE(event);
  EXPECT_EQ(event->changed, std::set<std::size_t>{0});
}

TEST(file_watcher, a_file_that_is_refilled_through_one_descriptor_is_waited_for) {
  const TemporaryDirectory folder;
  const std::string a = folder.write("a", "1");
  WatcherOptions options;
  options.settle.most = 20s;  // the machine of a test may be slow
  Watched watched(options);
  watched.read(0, {a});
  const int file = ::open(a.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC);
  ASSERT_GE(file, 0);
  EXPECT_FALSE(watched.next(300ms));
  ASSERT_EQ(::write(file, "2", 1), 1);
  EXPECT_FALSE(watched.next(100ms));
  ::close(file);
  EXPECT_TRUE(watched.next_is_change());
}

TEST(file_watcher, a_missing_file_that_appears_is_a_change) {
  const TemporaryDirectory folder;
  Watched watched;
  watched.read(0, {folder / "sub/dir/a"});
  fs::create_directories(folder / "sub/dir");
  folder.write("sub/dir/a", "1");
  EXPECT_TRUE(watched.next_is_change());
}

TEST(file_watcher, a_file_that_is_deleted_and_put_back_is_two_changes) {
  const TemporaryDirectory folder;
  const std::string a = folder.write("a", "1");
  Watched watched;
  watched.read(0, {a});
  fs::remove(a);
  EXPECT_TRUE(watched.next_is_change());
  watched.read(0, {a});
  folder.write("a", "1");
  EXPECT_TRUE(watched.next_is_change());
}

TEST(file_watcher, a_link_that_is_turned_round_is_a_change) {
  const TemporaryDirectory folder;
  folder.write("one", "1");
  folder.write("two", "2");
  fs::create_symlink("one", folder / "link");
  Watched watched;
  watched.read(0, {folder / "link"});
  fs::create_symlink("two", folder / "link.new");
  fs::rename(folder / "link.new", folder / "link");
  EXPECT_TRUE(watched.next_is_change());
  watched.read(0, {folder / "link"});
  folder.write("two", "3");
  EXPECT_TRUE(watched.next_is_change());
}

TEST(file_watcher, a_directory_that_is_renamed_takes_its_files_along) {
  const TemporaryDirectory folder;
  fs::create_directories(folder / "top/sub");
  const std::string a = folder.write("top/sub/a", "1");
  Watched watched;
  watched.read(0, {a});
  fs::rename(folder / "top", folder / "elsewhere");
  EXPECT_TRUE(watched.next_is_change());
  watched.read(0, {a});
  fs::create_directories(folder / "top/sub");
  folder.write("top/sub/a", "2");
  EXPECT_TRUE(watched.next_is_change());
}

TEST(file_watcher, rights_taken_away_and_given_back_are_changes) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may read everything";
  const TemporaryDirectory folder;
  const std::string a = folder.write("a", "1");
  Watched watched;
  watched.read(0, {a});
  fs::permissions(a, fs::perms::none);
  EXPECT_TRUE(watched.next_is_change());
  watched.read(0, {a});
  fs::permissions(a, fs::perms::owner_all);
  EXPECT_TRUE(watched.next_is_change());
}

TEST(file_watcher, links_in_a_circle_are_a_missing_file) {
  const TemporaryDirectory folder;
  const std::string a = folder.write("a", "1");
  Watched watched;
  watched.read(0, {a});
  fs::create_symlink("a", folder / "b");
  fs::create_symlink("b", folder / "a.new");
  fs::rename(folder / "a.new", a);
  EXPECT_TRUE(watched.next_is_change());
}

TEST(file_watcher, files_saved_together_are_one_change) {
  const TemporaryDirectory folder;
  std::vector<std::string> paths;
  for (const char* const name : {"a", "b", "c", "d", "e"}) paths.push_back(folder.write(name, "1"));
  WatcherOptions options;
  options.settle = {.quiet = 300ms, .quiet_after_burst = 300ms, .most = 20s};
  Watched watched(options);
  watched.read(0, paths);
  for (const char* const name : {"a", "b", "c", "d", "e"}) folder.write(name, "2");
  EXPECT_TRUE(watched.next_is_change());
  EXPECT_FALSE(watched.next(400ms));
}

TEST(file_watcher, a_file_outside_of_what_may_be_read_is_told_once) {
  const TemporaryDirectory folder;
  const std::string a = folder.write("a", "1");
  Watched watched;
  // It is there, and the scene says that it could not be read: so it was refused.
  const FileRecord refused{.path = a, .found = false, .hash = {}};
  watched.watcher().watch(0, {refused});
  EXPECT_TRUE(watched.next_is_change());
  watched.watcher().watch(0, {refused});
  EXPECT_FALSE(watched.next(200ms));
}

TEST(file_watcher, without_notification_the_files_are_looked_at) {
  const TemporaryDirectory folder;
  const std::string a = folder.write("a", "1");
  WatcherOptions options;
  options.poll = true;
  options.poll_every = 20ms;
  Watched watched(options);
  watched.read(0, {a});
  folder.write("a", "22");
  EXPECT_TRUE(watched.next_is_change());
  watched.read(0, {a});
  fs::remove(a);
  EXPECT_TRUE(watched.next_is_change());
}

class Folders : public testing::TestWithParam<bool> {};

// What is saved in a folder is no change of what it lists; what comes and goes is one.
TEST_P(Folders, a_listing_changes_when_scenes_come_and_go) {
  const TemporaryDirectory folder;
  const std::string in_it = folder.write("in_it.sdl", "one");
  Watched watched({.poll = GetParam(), .poll_every = 20ms});
  constexpr std::size_t listing = 7;
  const auto look = [&] {
    watched.watcher().watch(listing, {listing_of(folder.path())});
    watched.watcher().wait_until_armed();
  };
  watched.read(0, {in_it});
  look();
  folder.write("notes.txt", "no scene");
  folder.write("in_it.sdl", "another");
  auto event = watched.next();
  ASSERT_TRUE(event);
  EXPECT_FALSE(event->changed.contains(listing));
  folder.write("new.sdl", "two");
  EXPECT_TRUE(watched.next_is_change(listing));
  look();
  fs::rename(folder.path() + "/new.sdl", folder.path() + "/newer.sdl");
  EXPECT_TRUE(watched.next_is_change(listing));
  look();
  fs::remove(folder.path() + "/newer.sdl");
  EXPECT_TRUE(watched.next_is_change(listing));
  look();
  fs::rename(folder.path(), folder.path() + "-gone");
  EXPECT_TRUE(watched.next_is_change(listing));
  look();
  fs::rename(folder.path() + "-gone", folder.path());
  EXPECT_TRUE(watched.next_is_change(listing));
}
INSTANTIATE_TEST_SUITE_P(file_watcher, Folders, testing::Values(false, true));

TEST(file_watcher, fifty_thousand_touches_lose_nothing) {
  const TemporaryDirectory folder;
  const std::string a = folder.write("a", "1");
  Watched watched;
  watched.read(0, {a});
  for (int i = 0; i < 25'000; ++i) {
    const int file = ::open((folder / "noise").c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
    ::close(file);
    ::unlink((folder / "noise").c_str());
  }
  folder.write("a", "2");
  EXPECT_TRUE(watched.next_is_change());
}

}  // namespace
}  // namespace scenec::runtime
