#include "backend/scene_memory.hpp"

#include <gtest/gtest.h>

#include <string>

namespace scenec::backend {
namespace {

Hash128 key(std::uint64_t number) {
  return {number, number};
}
std::shared_ptr<const std::string> text(const char* value) {
  return std::make_shared<const std::string>(value);
}

TEST(scene_memory, what_was_kept_is_found_by_key_and_kind) {
  SceneMemory memory;
  memory.keep(key(1), text("a"), 10);
  EXPECT_EQ(*memory.find<std::string>(key(1)), "a");
  EXPECT_FALSE(memory.find<std::string>(key(2)));
  EXPECT_FALSE(memory.find<int>(key(1)));
  EXPECT_EQ(memory.counts().reused, 1U);
  EXPECT_EQ(memory.counts().made, 1U);
}

TEST(scene_memory, what_was_used_longest_ago_goes_first) {
  SceneMemory memory(30);
  memory.keep(key(1), text("a"), 10);
  memory.keep(key(2), text("b"), 10);
  memory.keep(key(3), text("c"), 10);
  EXPECT_TRUE(memory.find<std::string>(key(1)));
  memory.keep(key(4), text("d"), 10);
  EXPECT_TRUE(memory.find<std::string>(key(1)));
  EXPECT_FALSE(memory.find<std::string>(key(2)));
  EXPECT_EQ(memory.bytes(), 30U);
  memory.keep(key(5), text("too large"), 31);
  EXPECT_FALSE(memory.find<std::string>(key(5)));
  EXPECT_EQ(memory.bytes(), 30U);
  memory.keep(key(1), text("again"), 20);
  EXPECT_EQ(*memory.find<std::string>(key(1)), "again");
  EXPECT_LE(memory.bytes(), 30U);
}

}  // namespace
}  // namespace scenec::backend
