// Comments stay where they are, wherever that is.
#include <gtest/gtest.h>

#include "tests/unit/frontend/format_support.hpp"

namespace scenec::frontend::test {
namespace {

void expect_format(const std::string& before, const std::string& after) {
  EXPECT_EQ(formatted_items(before), after);
  EXPECT_EQ(formatted_items(after), after);
  EXPECT_EQ(problem_of("sdl 1;\n" + before, grammar::Dialect::sdl), "");
}

TEST(FormatComments, BehindAnItem) {
  expect_format("let a=1;// one\nlet b=2;   /* two */\nlet c=3; /* three */ let d=4;",
                "let a = 1; // one\nlet b = 2; /* two */\nlet c = 3;\n/* three */ let d = 4;\n");
}

TEST(FormatComments, OnTheirOwnLine) {
  expect_format("// a\n\n\n// b\nlet a=1;\n   // c\n", "// a\n\n// b\nlet a = 1;\n// c\n");
}

TEST(FormatComments, InABlock) {
  expect_format("group{// a\n// b\nx=1;\n\n// c\n}",
                "group { // a\n  // b\n  x = 1;\n\n  // c\n}\n");
  expect_format("group{/* a */x=1;/* b */}", "group { /* a */ x = 1; /* b */ }\n");
  expect_format("group{/* a */}", "group { /* a */ }\n");
  expect_format("group{\n// a\n}", "group {\n  // a\n}\n");
  expect_format("group{// a\n}", "group { // a\n}\n");
}

TEST(FormatComments, BetweenArguments) {
  expect_format("f(/* a */1/* b */,/* c */2/* d */);",
                "f(/* a */ 1 /* b */, /* c */ 2 /* d */);\n");
  expect_format("f(// a\n1,// b\n// c\n2// d\n// e\n);",
                "f( // a\n  1, // b\n  // c\n  2, // d\n  // e\n);\n");
  expect_format("f(1,\n/* alone */\n2);", "f(\n  1,\n  /* alone */\n  2,\n);\n");
  expect_format("let a=[1,2,/* last */];", "let a = [1, 2 /* last */];\n");
  expect_format("let a=[// none\n];", "let a = [ // none\n];\n");
}

TEST(FormatComments, BeforeAMarkOnTheNextLine) {
  expect_format("let a=1// one\n;", "let a = 1; // one\n");
  expect_format("f(1// one\n,2);", "f(\n  1, // one\n  2,\n);\n");
}

TEST(FormatComments, AMarkDoesNotMakeDocumentation) {
  // Moved before `// y`, the mark would leave `/// z` on a line of its own, above `b`.
  expect_format("let a=1// y\n;/// z\nlet b=2;", "let a = 1 // y\n  ; /// z\nlet b = 2;\n");
}

TEST(FormatComments, InsideAnExpression) {
  expect_format("let a=// x\n1;", "let a = // x\n  1;\n");
  expect_format("let a=\n// x\n1;", "let a =\n  // x\n  1;\n");
  expect_format("let a=1/* x */+2;", "let a = 1 /* x */ + 2;\n");
  expect_format("let a=1+// x\n2;", "let a = 1\n  + // x\n  2;\n");
  expect_format("let a=b[// x\n0];", "let a = b[ // x\n  0];\n");
}

TEST(FormatComments, BlockCommentsMoveWhole) {
  expect_format("group {\n      /* a\n       * b\n     c\n       */\n x = 1;\n}",
                "group {\n  /* a\n   * b\n c\n   */\n  x = 1;\n}\n");
  expect_format("let a /* x\n   y */ = 1;", "let a /* x\n   y */ = 1;\n");
}

TEST(FormatComments, DocumentationKeepsItsItem) {
  expect_format(
      "   /// about a\nlet a=1;/// not about b\nlet b=2;\n/// not about c\n\nlet c=3;",
      "/// about a\nlet a = 1; /// not about b\nlet b = 2;\n/// not about c\n\nlet c = 3;\n");
  expect_format("group{/// not about the sphere\nsphere{}}",
                "group { /// not about the sphere\n  sphere { }\n}\n");
}

TEST(FormatComments, BetweenAnnotationAndItem) {
  expect_format("@allow(x)// a\nlet a=1;", "@allow(x) // a\nlet a = 1;\n");
  expect_format("@allow(x)/* a */let a=1;", "@allow(x) /* a */ let a = 1;\n");
}

TEST(FormatComments, AtTheEndsOfTheFile) {
  EXPECT_EQ(formatted("// a\n\n\nsdl 1;\n\n\n// b", grammar::Dialect::sdl),
            "// a\n\nsdl 1;\n\n// b\n");
  EXPECT_EQ(formatted("/* a */sdl 1;/* b */", grammar::Dialect::sdl), "/* a */ sdl 1; /* b */\n");
}

}  // namespace
}  // namespace scenec::frontend::test
