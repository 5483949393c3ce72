// Hostile and merely large inputs: each ends in reasonable time, with one error or with a scene.
#include <gtest/gtest.h>

#include "tests/unit/frontend/compile_fixture.hpp"

namespace scenec::frontend::test {
namespace {

std::string repeated(std::string_view text, int count) {
  std::string result;
  for (int i = 0; i < count; ++i) result += text;
  return result;
}

TEST(Limits, nesting_up_to_the_limit_of_the_grammar) {
  const std::string deep = repeated("(", 250) + "1" + repeated(")", 250);
  EXPECT_EQ(compiled(scene_with("sphere { radius = " + deep + "; material = grey; }")).codes, "");
  const std::string calls = repeated("max(1, -(", 120) + "1" + repeated("))", 120);
  EXPECT_EQ(compiled(scene_with("sphere { radius = " + calls + "; material = grey; }")).codes, "");
  const std::string groups = repeated("group { transform = move([1, 0, 0]);", 200);
  const Compiled nested =
      compiled(scene_with(groups + "sphere { material = grey; }" + repeated("}", 200)));
  EXPECT_EQ(nested.codes, "");
  ASSERT_TRUE(nested.scene);
  EXPECT_EQ(nested.scene->transforms[nested.scene->items.back().transform].m[3], 200);
}

TEST(Limits, long_lists_and_signs) {
  const std::string list = "let a = [" + repeated("1, ", 1'000'000) + "];";
  EXPECT_EQ(compiled(scene_with(list + "assert sum(a) == 1000000;")).codes, "");
  EXPECT_EQ(number_of(repeated("-", 100'000) + "1"), 1);
}

TEST(Limits, a_bomb_of_macros_ends_at_the_item_limit) {
  std::string text = "macro m0() { sphere { material = grey; } }\n";
  for (int i = 1; i < 12; ++i) {
    text += "macro m" + std::to_string(i) + "() {" +
            repeated("m" + std::to_string(i - 1) + "();", 10) + "}\n";
  }
  Compiler compiler;
  compiler.options.max_items = 1000;
  EXPECT_EQ(compiler(scene_with(text + "m11();")).codes, "E0721");
}

TEST(Limits, many_mistakes_are_all_found_in_time) {
  const Compiled result = compiled(scene_with(repeated("sphere { material = gery; }\n", 20'000)));
  EXPECT_EQ(std::count(result.codes.begin(), result.codes.end(), ' '), 19'999);
}

}  // namespace
}  // namespace scenec::frontend::test
