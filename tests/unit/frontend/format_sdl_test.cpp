// The layout of native text, construct by construct.
#include <gtest/gtest.h>

#include "tests/unit/frontend/format_support.hpp"

namespace scenec::frontend::test {
namespace {

// Formatting `before` gives `after`, and `after` stays as it is.
void expect_format(const std::string& before, const std::string& after) {
  EXPECT_EQ(formatted_items(before), after);
  EXPECT_EQ(formatted_items(after), after);
}

TEST(FormatSdl, BlanksBetweenTokens) {
  expect_format("let  a=1+2*- 3 ;", "let a = 1 + 2 * -3;\n");
  expect_format("let a=!b||c&&d==e;", "let a = !b || c && d == e;\n");
  expect_format("let a=f ( x , y=[ 1,2 ] ) [ 0 ] . x;", "let a = f(x, y = [1, 2])[0].x;\n");
  expect_format("let a=( 1+2 )%3;let b=5% %2;", "let a = (1 + 2) % 3;\nlet b = 5% % 2;\n");
  expect_format("let a = [0 .x, - -1, .path];", "let a = [0 .x, --1, .path];\n");
  expect_format("let a:[ [num] ]=[];", "let a: [[num]] = [];\n");
  expect_format("let a = [for i,x in 0..n:i*2];", "let a = [for i, x in 0 .. n: i * 2];\n");
}

TEST(FormatSdl, Declarations) {
  expect_format("include  \"a.sdl\"  as lib;", "include \"a.sdl\" as lib;\n");
  expect_format("@ clock param t:time=0s in 0s..6s;", "@clock param t: time = 0s in 0s .. 6s;\n");
  expect_format("fn f(i:int,a:angle=4deg):angle=a*i;",
                "fn f(i: int, a: angle = 4deg): angle = a * i;\n");
  expect_format("macro m( n:int in 1..<9, ){}", "macro m(n: int in 1 ..< 9) { }\n");
  expect_format("material oak:ggx{f0=0.04;}", "material oak: ggx { f0 = 0.04; }\n");
  expect_format("light:point{power=1W;}light key :point{}",
                "light: point { power = 1W; }\nlight key: point { }\n");
  expect_format("lib . row ( 8,what=leaf ) ;", "lib.row(8, what = leaf);\n");
  expect_format("assert n%2==0,\"even\";", "assert n % 2 == 0, \"even\";\n");
}

TEST(FormatSdl, ABlockOnOneLineStays) {
  expect_format("sphere{center=[0,1,0];radius=0.5;}",
                "sphere { center = [0, 1, 0]; radius = 0.5; }\n");
  expect_format("for i in 0..9{sphere{radius=i;}}", "for i in 0 .. 9 { sphere { radius = i; } }\n");
}

TEST(FormatSdl, ABlockOnSeveralLinesIsBrokenWhole) {
  expect_format("sphere{ center=[0,1,0];\nradius=0.5; }",
                "sphere {\n  center = [0, 1, 0];\n  radius = 0.5;\n}\n");
  expect_format("group\n{\nsphere{radius=1;}}", "group {\n  sphere { radius = 1; }\n}\n");
}

TEST(FormatSdl, ABlockThatDoesNotFitIsBroken) {
  const std::string name(80, 'n');
  expect_format("sphere " + name + " { radius = 1; }", "sphere " + name + " {\n  radius = 1;\n}\n");
  // 100 columns just fit.
  const std::string fits(77, 'n');
  expect_format("sphere " + fits + " { radius=1; }", "sphere " + fits + " { radius = 1; }\n");
}

TEST(FormatSdl, BranchesAreBrokenTogether) {
  expect_format("if a{b=1;}else if c{}else{d=1;}",
                "if a { b = 1; } else if c { } else { d = 1; }\n");
  expect_format("if a{b=1;}\nelse if c{d=1;}else{}",
                "if a {\n  b = 1;\n} else if c {\n  d = 1;\n} else { }\n");
}

TEST(FormatSdl, LongListsHaveAnElementALineAndATrailingComma) {
  const std::string word(60, 'w');
  expect_format("let a = [" + word + ", " + word + "];",
                "let a = [\n  " + word + ",\n  " + word + ",\n];\n");
  expect_format("f(" + word + ", x = " + word + ");",
                "f(\n  " + word + ",\n  x = " + word + ",\n);\n");
  expect_format("macro m(" + word + ": int, b" + word + ": num) { }",
                "macro m(\n  " + word + ": int,\n  b" + word + ": num,\n) { }\n");
  expect_format("let a = [\n  1,\n  2,\n];", "let a = [1, 2];\n");
}

TEST(FormatSdl, NumbersShareLines) {
  std::string numbers;
  for (int i = 0; i < 40; ++i) numbers += "10" + std::to_string(i) + ", ";
  const std::string text = formatted_items("let a = [" + numbers + "-1];");
  EXPECT_EQ(
      text,
      "let a = [\n"
      "  100, 101, 102, 103, 104, 105, 106, 107, 108, 109, 1010, 1011, 1012, 1013, 1014, 1015,"
      " 1016, 1017,\n"
      "  1018, 1019, 1020, 1021, 1022, 1023, 1024, 1025, 1026, 1027, 1028, 1029, 1030, 1031,"
      " 1032, 1033,\n"
      "  1034, 1035, 1036, 1037, 1038, 1039, -1,\n"
      "];\n");
  EXPECT_EQ(formatted_items(text), text);
}

TEST(FormatSdl, ASoleBracketIsBrokenInStead) {
  const std::string word(50, 'w');
  expect_format("let a = bspline([" + word + ", " + word + "]);",
                "let a = bspline([\n  " + word + ",\n  " + word + ",\n]);\n");
}

TEST(FormatSdl, LongChainsBreakBeforeTheirOperators) {
  const std::string word(60, 'w');
  expect_format("let a = " + word + " + " + word + ";",
                "let a = " + word + "\n  + " + word + ";\n");
}

TEST(FormatSdl, AtMostOneBlankLine) {
  expect_format("\n\n\nlet a = 1;\n\n\n\nlet b = 2;\nlet c = 3;\n\n\n",
                "\nlet a = 1;\n\nlet b = 2;\nlet c = 3;\n");
  expect_format("group {\n\n\n  a = 1;\n\n\n  b = 2;\n\n}", "group {\n  a = 1;\n\n  b = 2;\n}\n");
}

TEST(FormatSdl, AnnotationsKeepTheirLine) {
  expect_format("@ allow ( x )\n@clock let a=1;", "@allow(x)\n@clock let a = 1;\n");
}

TEST(FormatSdl, LineEndsAndByteOrderMark) {
  EXPECT_EQ(formatted("\xEF\xBB\xBFsdl 1;\r\n/* a\r\n b */\rlet a=1;", grammar::Dialect::sdl),
            "sdl 1;\n/* a\n b */\nlet a = 1;\n");
}

TEST(FormatSdl, WidthsCountCodePoints) {
  std::string accents;
  for (int i = 0; i < 70; ++i) accents += "\xC3\xA9";
  expect_format("assert f(\"" + accents + "\", 1, 2);", "assert f(\"" + accents + "\", 1, 2);\n");
}

}  // namespace
}  // namespace scenec::frontend::test
