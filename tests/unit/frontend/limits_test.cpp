// Hostile and merely large inputs: each ends in reasonable time, with one error or with a scene.
#include <gtest/gtest.h>

#include <string>
#include <vector>

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
  compiler.options.limits.items = 1000;
  EXPECT_EQ(compiler(scene_with(text + "m11();")).codes, "E0721");
}

// Refused at the outermost loop or call, before its first item.
TEST(Limits, what_must_place_too_much_is_refused_before_it_is_run) {
  const std::string ball = "sphere { material = grey; }";
  const std::vector<std::string> bombs{
      "for i in 0 ..< 1000000000 { " + ball + " }",
      "for i in 1 .. 3000 { for j in 1 .. 1000 { " + ball + " } }",
      "let n = 1700;\nfor i in 0 ..< n { for j in 0 ..< n { " + ball + " } }",
      "macro m(n: int) { for i in 0 ..< n { " + ball + " } }\nm(n = 3000000);",
      "macro m(a: int, n: int) { for i in a ..< n { " + ball + " } }\nfor i in 0 ..< 10 { m(0, " +
          "1000000); }",
      "for x in [1, 2, 3] { for i in -1000000 .. 0 { if x > 1 { " + ball + " " + ball +
          " } else { " + ball + " } } }",
      "proto p { for i in 0 ..< 3000000 { " + ball + " } }\ninstance { of = p; material = grey; }",
      "group { for i in -9223372036854775807 .. 9223372036854775807 { " + ball + " } }",
  };
  for (const std::string& bomb : bombs) {
    const Compiled result = compiled(scene_with(bomb));
    EXPECT_EQ(result.codes, "E0721") << bomb << result.rendered;
    EXPECT_NE(result.messages.find("at least"), std::string::npos) << result.messages;
  }
  // What only might be too much is run.
  const std::vector<std::string> harmless{
      "let n = 3000000;\ngroup { for n in 0 ..< 3 { for i in 0 ..< n { " + ball + " } } }",
      "for i in 0 ..< 2100000 { if i < 3 { " + ball + " } }",
      "macro m(n: int) { let k = 2; for i in 0 ..< n * 0 + k { " + ball +
          " } }\nlet k = 3000000;\n" + "assert k > 0;\nm(k);",
      "if false { for i in 0 ..< 3000000 { " + ball + " } }",
      "@allow(unused_declaration) macro m() { for i in 0 ..< 3000000 { " + ball + " } }",
  };
  for (const std::string& scene : harmless) {
    const Compiled result = compiled(scene_with(scene));
    EXPECT_EQ(result.codes.find('E'), std::string::npos) << scene << result.rendered;
  }
}

TEST(Limits, rounds_that_place_nothing_are_counted_as_well) {
  const Compiled result =
      compiled(scene_with("for i in 0 ..< 1000000000 { let a = i; assert a >= 0; }"));
  EXPECT_EQ(result.codes, "E0720") << result.rendered;
}

TEST(Limits, calls_that_double_are_checked_in_linear_time_and_run_within_the_steps) {
  std::string text = "fn f0(x: num): num = x;\n";
  for (int i = 1; i < 60; ++i) {
    const std::string inner = "f" + std::to_string(i - 1) + "(x)";
    text += "fn f" + std::to_string(i) + "(x: num): num = " + inner + " + " + inner + ";\n";
  }
  EXPECT_EQ(
      compiled(scene_with(text + "assert f5(1) == 32;\n@allow(unused_declaration) fn g(): num "
                                 "= f59(1);"))
          .codes,
      "");
}

TEST(Limits, long_chains_of_calls_end_with_a_message_not_on_the_stack) {
  std::string macros = "macro m0() { sphere { material = grey; } }\n",
              functions = "fn f0(x: num): num = x;\n";
  for (int i = 1; i < 3000; ++i) {
    const std::string number = std::to_string(i), before = std::to_string(i - 1);
    macros += "macro m" + number + "() { " + repeated("group { ", 40) + "m" + before + "();" +
              repeated("}", 40) + " }\n";
    functions += "fn f" + number + "(x: num): num = " + repeated("(", 100) + "f" + before + "(x)" +
                 repeated(")", 100) + ";\n";
  }
  EXPECT_EQ(compiled(scene_with(macros + "m2999();")).codes, "E0725");
  EXPECT_EQ(
      compiled(scene_with(functions + "sphere { radius = f2999(1); material = grey; }")).codes,
      "E0725");
}

TEST(Limits, many_mistakes_are_all_found_in_time) {
  const Compiled result = compiled(scene_with(repeated("sphere { material = gery; }\n", 20'000)));
  EXPECT_EQ(std::count(result.codes.begin(), result.codes.end(), ' '), 19'999);
}

}  // namespace
}  // namespace scenec::frontend::test
