#include "runtime/watch/settle.hpp"

#include <gtest/gtest.h>

namespace scenec::runtime {
namespace {

using std::chrono::milliseconds;
using Touch = Settle::Touch;

const Settle::Time start{};

TEST(settle, one_file_is_quiet_after_thirty_milliseconds) {
  Settle settle;
  EXPECT_FALSE(settle.deadline());
  settle.touch("a", Touch::closed, start);
  EXPECT_EQ(settle.deadline(), start + milliseconds(30));
  settle.touch("a", Touch::closed, start + milliseconds(20));
  EXPECT_EQ(settle.deadline(), start + milliseconds(50));
  const Settle::Burst burst = settle.take(start + milliseconds(50));
  EXPECT_EQ(burst.paths, std::set<std::string>{"a"});
  EXPECT_EQ(burst.first, start);
  EXPECT_EQ(burst.last, start + milliseconds(20));
  EXPECT_FALSE(burst.forced);
  EXPECT_FALSE(settle.pending());
}

TEST(settle, several_files_are_waited_for_longer_and_so_is_the_burst_behind_them) {
  Settle settle;
  settle.touch("a", Touch::closed, start);
  settle.touch("b", Touch::closed, start + milliseconds(10));
  EXPECT_EQ(settle.deadline(), start + milliseconds(110));
  static_cast<void>(settle.take(start + milliseconds(110)));
  settle.touch("a", Touch::closed, start + milliseconds(500));
  EXPECT_EQ(settle.deadline(), start + milliseconds(600));
  static_cast<void>(settle.take(start + milliseconds(600)));
  settle.touch("a", Touch::closed, start + milliseconds(900));
  EXPECT_EQ(settle.deadline(), start + milliseconds(930));
}

TEST(settle, a_file_that_is_still_written_is_waited_for) {
  Settle settle;
  settle.touch("a", Touch::writing, start);
  EXPECT_EQ(settle.deadline(), start + milliseconds(1000));
  settle.touch("a", Touch::closed, start + milliseconds(500));
  EXPECT_EQ(settle.deadline(), start + milliseconds(530));
}

TEST(settle, a_file_that_is_gone_may_be_about_to_come_back) {
  Settle settle;
  settle.touch("a", Touch::missing, start);
  EXPECT_EQ(settle.deadline(), start + milliseconds(100));
  settle.touch("a", Touch::changed, start + milliseconds(1));
  EXPECT_EQ(settle.deadline(), start + milliseconds(31));
}

TEST(settle, nobody_waits_longer_than_a_second) {
  Settle settle;
  for (int ms = 0; ms <= 990; ms += 10) settle.touch("a", Touch::closed, start + milliseconds(ms));
  EXPECT_EQ(settle.deadline(), start + milliseconds(1000));
  EXPECT_TRUE(settle.take(start + milliseconds(1000)).forced);
}

}  // namespace
}  // namespace scenec::runtime
