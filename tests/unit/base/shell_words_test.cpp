#include "base/shell_words.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scenec {
namespace {

using testing::ElementsAre;
using testing::Optional;

TEST(ShellWords, AreReadAsAShellReadsThem) {
  EXPECT_THAT(shell_words("  a b=1\t'c d' \"e f\"g \\  ''"),
              Optional(ElementsAre("a", "b=1", "c d", "e fg", " ", "")));
  EXPECT_THAT(shell_words(""), Optional(ElementsAre()));
  EXPECT_EQ(shell_words("a 'b"), std::nullopt);
  EXPECT_EQ(shell_words("a\\"), std::nullopt);
}

TEST(ShellWords, AreWrittenSoThatTheyReadBack) {
  EXPECT_EQ(shell_word("--size=8x8"), "--size=8x8");
  for (const char* const text : {"", "a b", "it's", "'", "\"", "\\", "$(x)", "n=[1, 2]", "*"})
    EXPECT_THAT(shell_words("x " + shell_word(text)), Optional(ElementsAre("x", text)));
}

}  // namespace
}  // namespace scenec
