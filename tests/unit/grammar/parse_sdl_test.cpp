// The shape of the tree of every native construct.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/grammar/parsing.hpp"

namespace scenec::grammar {
namespace {

// The outline of one item in a well-formed file.
std::string item(const std::string& text) {
  const Parsed parsed(Dialect::sdl, "sdl 1; " + text);
  EXPECT_THAT(parsed.messages(), testing::IsEmpty()) << text;
  EXPECT_EQ(reassembled_text(parsed.tree), parsed.text);
  const std::string whole = outline(parsed.tree);
  const std::string head = "(file (edition sdl 1) ";
  EXPECT_TRUE(whole.starts_with(head)) << whole;
  return whole.substr(head.size(), whole.size() - head.size() - 1);
}
std::string value(const std::string& text) {
  const std::string whole = item("let v = " + text + ";");
  const std::string head = "(let let v ";
  return whole.substr(head.size(), whole.size() - head.size() - 1);
}

TEST(ParseSdl, declarations) {
  EXPECT_EQ(item("include \"a.sdl\" as a;"), "(include include \"a.sdl\" as a)");
  EXPECT_EQ(item("param n: int = 6 in 0 .. 40;"),
            "(param param n (type int) (number_literal 6) in (range (number_literal 0) "
            "(number_literal 40)))");
  EXPECT_EQ(item("@clock param t: time = 0s;"),
            "(param (annotation clock) param t (type time) (number_literal 0s))");
  EXPECT_EQ(item("let a: [[vec2]] = b;"), "(let let a (type (type (type vec2))) (name_ref b))");
  EXPECT_EQ(item("fn f(x: num = 1 in 0 .. 2, y: material): num = x;"),
            "(fn fn f (parameters (parameter x (type num) (number_literal 1) in (range "
            "(number_literal 0) (number_literal 2)))"
            " (parameter y (type material))) (type num) (name_ref x))");
  EXPECT_EQ(item("macro m() { }"), "(macro macro m (parameters) (block))");
  EXPECT_EQ(item("proto p { sphere { } }"), "(proto proto p (block (shape sphere (block))))");
  EXPECT_EQ(item("material oak: ggx { f0 = 1; }"),
            "(material material oak ggx (block (field f0 (number_literal 1))))");
}

TEST(ParseSdl, placed_items) {
  EXPECT_EQ(item("sphere { }"), "(shape sphere (block))");
  EXPECT_EQ(item("sphere ball { material = oak; }"),
            "(shape sphere ball (block (field material (name_ref oak))))");
  EXPECT_EQ(item("group { }"), "(group group (block))");
  EXPECT_EQ(item("group g { }"), "(group group g (block))");
  EXPECT_EQ(item("instance i { of = leaf; }"),
            "(instance instance i (block (field of (name_ref leaf))))");
  EXPECT_EQ(item("light: point { }"), "(light light point (block))");
  EXPECT_EQ(item("light key: point { }"), "(light light key point (block))");
  EXPECT_EQ(item("camera main: pinhole { }"), "(camera camera main pinhole (block))");
  EXPECT_EQ(item("camera: pinhole { }"), "(camera camera pinhole (block))");
  EXPECT_EQ(item("render { stop { time = 2s; } }"),
            "(render render (block (shape stop (block (field time (number_literal 2s))))))");
  EXPECT_EQ(item("row(8, what = leaf,);"),
            "(call_item (qualified_name row) (arguments (argument (number_literal 8)) (argument "
            "what (name_ref leaf))))");
  EXPECT_EQ(item("lib.row();"), "(call_item (qualified_name lib row) (arguments))");
}

TEST(ParseSdl, control) {
  EXPECT_EQ(item("for i in 0 ..< n { }"),
            "(for_item for i in (range (number_literal 0) (name_ref n)) (block))");
  EXPECT_EQ(item("for i, x in xs { }"), "(for_item for i x in (name_ref xs) (block))");
  EXPECT_EQ(
      item("if a { } else if b { } else { }"),
      "(if_item if (name_ref a) (block) else (if_item if (name_ref b) (block) else (block)))");
  EXPECT_EQ(item("assert a, \"m\";"), "(assert_item assert (name_ref a) (string_literal \"m\"))");
  EXPECT_EQ(item("@a @b(1) sphere { }"),
            "(shape (annotation a) (annotation b (arguments (argument (number_literal 1)))) sphere "
            "(block))");
}

TEST(ParseSdl, operators_bind_as_documented) {
  EXPECT_EQ(value("1 + 2 * 3 - 4"),
            "(add_chain (number_literal 1) + (multiply_chain (number_literal 2) * (number_literal "
            "3)) - (number_literal 4))");
  EXPECT_EQ(value("a || b && c == d"),
            "(or_chain (name_ref a) || (and_chain (name_ref b) && (comparison (name_ref c) == "
            "(name_ref d))))");
  EXPECT_EQ(value("- - !a.x"), "(unary - - ! (member (name_ref a) x))");
  EXPECT_EQ(value("a <= b"), "(comparison (name_ref a) <= (name_ref b))");
  EXPECT_EQ(value("5 % 2"), "(multiply_chain (number_literal 5) % (number_literal 2))");
  EXPECT_EQ(value("(1)"), "(paren (number_literal 1))");
}

TEST(ParseSdl, chains_nest_to_the_left) {
  EXPECT_EQ(value("a.b[1].c(2)"),
            "(call (member (index (member (name_ref a) b) (number_literal 1)) c) (arguments "
            "(argument (number_literal 2))))");
  EXPECT_EQ(value("f(a = b, a == b)"),
            "(call (name_ref f) (arguments (argument a (name_ref b)) (argument (comparison "
            "(name_ref a) == (name_ref b)))))");
}

TEST(ParseSdl, literals_and_lists) {
  EXPECT_EQ(value("[1.5e-3m, #f80, .smooth, \"s\", true]"),
            "(list (number_literal 1.5e-3m) (color_literal #f80) (enum_literal .smooth) "
            "(string_literal \"s\") (bool_literal true))");
  EXPECT_EQ(value("[]"), "(list)");
  EXPECT_EQ(value("[1, [2],]"), "(list (number_literal 1) (list (number_literal 2)))");
  EXPECT_EQ(value("[for i in 0..n: i]"),
            "(comprehension for i in (range (number_literal 0) (name_ref n)) (name_ref i))");
  EXPECT_EQ(value("[for i, x in xs: x]"), "(comprehension for i x in (name_ref xs) (name_ref x))");
  EXPECT_EQ(value("50% * 2"), "(multiply_chain (number_literal 50%) * (number_literal 2))");
  EXPECT_EQ(value("[5x, 1e, 0x1F]"),
            "(list (number_literal 5x) (number_literal 1e) (number_literal 0x1F))");
}

TEST(ParseSdl, reserved_words_can_be_keys_and_a_name_may_begin_like_one) {
  EXPECT_EQ(item("let = 1;"), "(field let (number_literal 1))");
  EXPECT_EQ(item("lettuce { }"), "(shape lettuce (block))");
  EXPECT_EQ(value("index"), "(name_ref index)");
}

TEST(ParseSdl, blanks_and_comments_may_stand_anywhere) {
  EXPECT_EQ(item("\r\n let/**/a/*x*//*y*/=//z\r1\t;\n"), "(let let a (number_literal 1))");
  const Parsed parsed(Dialect::sdl, "\xEF\xBB\xBF// c\rsdl 1;\r\n");
  EXPECT_THAT(parsed.messages(), testing::IsEmpty());
  EXPECT_EQ(outline(parsed.tree), "(file (edition sdl 1))");
}

TEST(ParseSdl, spans_reach_from_the_first_token_to_the_last) {
  const Parsed parsed(Dialect::sdl, " sdl 1;  @a let x = 1 + 2 ; ");
  const NodeRef let = parsed.tree.root().find_child(SyntaxKind::let);
  EXPECT_EQ(let.text(), "@a let x = 1 + 2 ;");
  EXPECT_EQ(let.find_child(SyntaxKind::add_chain).text(), "1 + 2");
  EXPECT_EQ(parsed.tree.root().text(), "sdl 1;  @a let x = 1 + 2 ;");
}

TEST(ParseSdl, dialect_is_told_by_extension_or_first_statement) {
  EXPECT_EQ(dialect_of("a.sdl", "Lights {"), Dialect::sdl);
  EXPECT_EQ(dialect_of("dir.sdl/a.txt", "Lights {"), Dialect::course);
  EXPECT_EQ(dialect_of("a.txt", "/* c */ sdl 1; let"), Dialect::sdl);
  EXPECT_EQ(dialect_of("-", "sdl 2 ;"), Dialect::sdl);
  EXPECT_EQ(dialect_of("-", "sdl { }"), Dialect::course);
  EXPECT_EQ(dialect_of("", ""), Dialect::course);
}

}  // namespace
}  // namespace scenec::grammar
