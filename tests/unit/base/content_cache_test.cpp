#include "base/content_cache.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/unit/base/temporary_directory.hpp"

namespace scenec {
namespace {

namespace fs = std::filesystem;

Hash128 key_of(int i) {
  return hash_bytes("key " + std::to_string(i));
}

void store(ContentCache& cache, const Hash128& key, std::string_view bytes) {
  const std::vector<std::string_view> pieces{bytes.substr(0, bytes.size() / 3),
                                             bytes.substr(bytes.size() / 3)};
  cache.store(key, pieces);
}

std::string found(ContentCache& cache, const Hash128& key) {
  const auto content = cache.find(key);
  return content ? std::string(content->bytes) : "(absent)";
}

void put(const std::string& path, std::string_view bytes) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
}

class ContentCacheTest : public testing::Test {
 protected:
  test::TemporaryDirectory directory_;
  std::string path_ = directory_.path() + "/deep/cache";
  ContentCache cache_{{.directory = path_}};
};

TEST_F(ContentCacheTest, GivesBackWhatWasKept) {
  EXPECT_EQ(found(cache_, key_of(1)), "(absent)");
  store(cache_, key_of(1), "the bytes");
  store(cache_, key_of(2), "");
  EXPECT_EQ(found(cache_, key_of(1)), "the bytes");
  EXPECT_EQ(found(cache_, key_of(2)), "");
  EXPECT_EQ(found(cache_, key_of(3)), "(absent)");
  store(cache_, key_of(1), "other bytes");
  EXPECT_EQ(found(cache_, key_of(1)), "other bytes");
  const ContentCacheCounts counts = cache_.counts();
  EXPECT_EQ(counts.hits, 3U);
  EXPECT_EQ(counts.misses, 2U);
  EXPECT_EQ(counts.stored, 3U);
  EXPECT_EQ(counts.note, "");
}

TEST_F(ContentCacheTest, EveryTruncationAndEveryFlippedBitIsAbsentAndMended) {
  store(cache_, key_of(1), "some bytes that matter");
  const std::string file = cache_.path_of(key_of(1));
  const std::string whole = test::TemporaryDirectory::read(file);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    put(file, whole.substr(0, size));
    EXPECT_EQ(found(cache_, key_of(1)), "(absent)") << size;
  }
  put(file, whole + "x");
  EXPECT_EQ(found(cache_, key_of(1)), "(absent)");
  for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
    std::string damaged = whole;
    damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << bit % 8));
    put(file, damaged);
    EXPECT_EQ(found(cache_, key_of(1)), "(absent)") << bit;
  }
  store(cache_, key_of(1), "some bytes that matter");
  EXPECT_EQ(found(cache_, key_of(1)), "some bytes that matter");
}

TEST_F(ContentCacheTest, AnEntryUnderAnotherKeyIsAbsent) {
  store(cache_, key_of(1), "one");
  fs::rename(cache_.path_of(key_of(1)), cache_.path_of(key_of(2)));
  EXPECT_EQ(found(cache_, key_of(2)), "(absent)");
}

TEST_F(ContentCacheTest, WhatIsNoFileIsAbsentAndDoesNotBlock) {
  fs::create_directories(path_);
  fs::create_directory(cache_.path_of(key_of(1)));
  EXPECT_EQ(found(cache_, key_of(1)), "(absent)");
  ASSERT_EQ(::mkfifo(cache_.path_of(key_of(2)).c_str(), 0600), 0);
  EXPECT_EQ(found(cache_, key_of(2)), "(absent)");
  store(cache_, key_of(3), "three");
  fs::create_symlink(cache_.path_of(key_of(3)), cache_.path_of(key_of(4)));
  EXPECT_EQ(found(cache_, key_of(4)), "(absent)");
  store(cache_, key_of(1), "one");  // cannot replace a directory
  EXPECT_NE(cache_.counts().note, "");
}

TEST_F(ContentCacheTest, ADirectoryThatCannotBeMadeOrWrittenIsNoted) {
  put(directory_.path() + "/file", "");
  ContentCache blocked({.directory = directory_.path() + "/file/cache"});
  store(blocked, key_of(1), "one");
  EXPECT_EQ(found(blocked, key_of(1)), "(absent)");
  EXPECT_NE(blocked.counts().note, "");
  fs::create_directories(directory_.path() + "/sealed");
  ::chmod((directory_.path() + "/sealed").c_str(), 0500);
  ContentCache sealed({.directory = directory_.path() + "/sealed"});
  store(sealed, key_of(1), "one");
  EXPECT_NE(sealed.counts().note, "");
  EXPECT_EQ(sealed.counts().stored, 0U);
  ::chmod((directory_.path() + "/sealed").c_str(), 0700);
}

TEST_F(ContentCacheTest, TheLeastRecentlyUsedGoFirst) {
  ContentCache cache({.directory = path_, .budget = 3 * (64 + 100)});
  const std::string bytes(100, 'x');
  const auto now = fs::file_time_type::clock::now();
  for (int i = 0; i < 3; ++i) {
    store(cache, key_of(i), bytes);
    fs::last_write_time(cache.path_of(key_of(i)), now - std::chrono::seconds(30 - i));
  }
  EXPECT_EQ(found(cache, key_of(0)), bytes);  // used now: 1 is the oldest
  store(cache, key_of(3), bytes);
  EXPECT_EQ(found(cache, key_of(1)), "(absent)");
  EXPECT_EQ(found(cache, key_of(0)), bytes);
  EXPECT_EQ(found(cache, key_of(2)), bytes);
  EXPECT_EQ(found(cache, key_of(3)), bytes);
  store(cache, key_of(4), std::string(1000, 'x'));
  EXPECT_EQ(found(cache, key_of(4)), "(absent)");
  EXPECT_EQ(cache.counts().note, "an entry is larger than the budget");
  EXPECT_EQ(found(cache, key_of(3)), bytes);
}

TEST_F(ContentCacheTest, AbandonedTemporaryFilesAreSweptWhenSpaceIsCounted) {
  fs::create_directories(path_);
  const std::string old_one = path_ + "/.0123.entry.tmp-1";
  const std::string new_one = path_ + "/.4567.entry.tmp-2";
  put(old_one, "x");
  put(new_one, "x");
  put(path_ + "/notes.txt", "not ours");
  fs::last_write_time(old_one, fs::file_time_type::clock::now() - std::chrono::hours(2));
  store(cache_, key_of(1), "one");
  EXPECT_FALSE(fs::exists(old_one));
  EXPECT_TRUE(fs::exists(new_one));
  EXPECT_TRUE(fs::exists(path_ + "/notes.txt"));
}

TEST_F(ContentCacheTest, ProcessesMayWriteAndReadAtOnce) {
  const std::string bytes(200'000, 'b');
  std::vector<pid_t> children;
  for (int child = 0; child < 4; ++child) {
    const pid_t id = ::fork();
    if (id == 0) {
      ContentCache cache({.directory = path_, .budget = 500'000});
      bool sound = true;
      for (int i = 0; i < 50; ++i) {
        const int key = (i + child) % 4;
        if (const auto content = cache.find(key_of(key))) sound = sound && content->bytes == bytes;
        store(cache, key_of(key), bytes);
      }
      ::_exit(sound ? 0 : 1);
    }
    children.push_back(id);
  }
  for (const pid_t id : children) {
    int status = 1;
    ASSERT_EQ(::waitpid(id, &status, 0), id);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  }
}

}  // namespace
}  // namespace scenec
