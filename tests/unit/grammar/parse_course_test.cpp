// Words, numbers, blocks and brackets of the course dialect, and its few syntax errors.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/grammar/parsing.hpp"

namespace scenec::grammar {
namespace {

using testing::ElementsAre;

std::string tree_of(const std::string& text) {
  const Parsed parsed(Dialect::course, text);
  EXPECT_THAT(parsed.messages(), testing::IsEmpty()) << text;
  EXPECT_EQ(reassembled_text(parsed.tree), parsed.text);
  return outline(parsed.tree);
}

TEST(ParseCourse, braces_split_what_they_touch) {
  EXPECT_EQ(tree_of("Material{shininess 20}Sphere"),
            "(course_file (course_word Material) (course_block (course_word shininess) "
            "(course_number 20)) (course_word Sphere))");
  EXPECT_EQ(tree_of("[1 .5]"),
            "(course_file (course_bracket (course_number 1) (course_number .5)))");
}

TEST(ParseCourse, a_number_is_a_number_as_a_whole) {
  for (const char* number : {"200.0", "1e-05", ".16", "1.", "+1", "-0", "1E+3", "-.5e2"}) {
    EXPECT_EQ(tree_of(number), "(course_file (course_number " + std::string(number) + "))");
  }
  for (const char* word : {"2D_tex", "scene..sphere&cube", "-", "mesh/bunny.obj", "1.5f", "1e", ".",
                           "a#b", "http://x", "inf"}) {
    EXPECT_EQ(tree_of(word), "(course_file (course_word " + std::string(word) + "))");
  }
}

TEST(ParseCourse, comments_begin_at_the_start_of_a_word) {
  const Parsed parsed(Dialect::course, "\xEF\xBB\xBF# one\r\na // two\r1");
  EXPECT_EQ(outline(parsed.tree), "(course_file (course_word a) (course_number 1))");
  EXPECT_EQ(parsed.tree.trivia().size(), 2u);
  EXPECT_EQ(reassembled_text(parsed.tree), parsed.text);
}

TEST(ParseCourse, unbalanced_braces_are_reported_where_they_are) {
  EXPECT_THAT(Parsed(Dialect::course, "a { b {").errors(), ElementsAre("E0118 6..7"));
  EXPECT_THAT(Parsed(Dialect::course, "a }\n]").errors(), ElementsAre("E0119 2..3", "E0119 4..5"));
  EXPECT_THAT(Parsed(Dialect::course, "a { [ 1 } b").errors(), ElementsAre("E0118 4..5"));
  EXPECT_THAT(Parsed(Dialect::course, "a { 1 ] }").errors(), ElementsAre("E0119 6..7"));
  EXPECT_THAT(Parsed(Dialect::course, "[ 1 }").errors(), ElementsAre("E0120 4..5"));
}

TEST(ParseCourse, bad_bytes_and_limits) {
  EXPECT_THAT(Parsed(Dialect::course, std::string("a \0 }", 5)).errors(),
              ElementsAre("E0123 2..3"));
  EXPECT_THAT(Parsed(Dialect::course, "a \xFF }").errors(), ElementsAre("E0124 2..3"));
  EXPECT_THAT(Parsed(Dialect::course, "a {{{{", {.nesting = 3}).errors(),
              ElementsAre("E0701 5..6"));
  EXPECT_THAT(Parsed(Dialect::course, "abcd abcde", {.token = 4}).errors(),
              ElementsAre("E0702 5..10"));
  EXPECT_THAT(Parsed(Dialect::course, "abcd", {.file = 3}).errors(), ElementsAre("E0702 0..0"));
}

}  // namespace
}  // namespace scenec::grammar
