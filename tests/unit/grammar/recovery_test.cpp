// One mistake, one diagnostic, in the right place; and what stands behind it is read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/grammar/parsing.hpp"

namespace scenec::grammar {
namespace {

using testing::ElementsAre;

// Each line of `text` that holds a mistake is marked by its code in a trailing `// E0102` comment;
// the diagnostics must be exactly those, on those lines.
void expect_marked(const std::string& text) {
  std::vector<std::string> expected;
  std::vector<std::string> actual;
  const auto line_of = [&](std::size_t offset) {
    return std::to_string(
        1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(offset), '\n'));
  };
  for (std::size_t at = text.find("E0"); at != std::string::npos; at = text.find("E0", at + 1)) {
    expected.push_back(line_of(at) + " " + text.substr(at, 5));
  }
  const Parsed parsed(Dialect::sdl, text);
  for (const Diagnostic& one : parsed.sink.sorted()) {
    actual.push_back(line_of(one.span.begin) + " " + std::string(info_of(one.kind).code));
  }
  EXPECT_THAT(actual, testing::ElementsAreArray(expected))
      << testing::PrintToString(parsed.messages());
  EXPECT_EQ(reassembled_text(parsed.tree), parsed.text);
}

TEST(Recovery, seven_lines_with_six_mistakes) {
  expect_marked(
      "sdl 1;\n"
      "sphere { center = [0, 1, 0] radius = 0.5; }  // E0102\n"
      "let a 3;                                     // E0101\n"
      "sphere { radius: 2; material = m; }          // E0106\n"
      "let b = [1, 2;                               // E0118\n"
      "box { min = ; max = 1; }                     // E0110\n"
      "let c = 1 m;                                 // E0111\n");
  expect_marked(
      "sdl 1;\n"
      "let a = 1                                    // E0102\n"
      "}                                            // E0119\n"
      "material oak = ggx { f0 = 0.04; }            // E0107\n"
      "row(count = 8 9, what = [1, 2], x = { a; }); // E0101\n"
      "let render = 3;                              // E0109\n"
      "sphere { a = \"x; }                          // E0116\n"
      "}\n");
}

TEST(Recovery, spans_are_the_narrowest) {
  const auto errors = [](const std::string& text) {
    return Parsed(Dialect::sdl, "sdl 1;" + text).errors();
  };
  EXPECT_THAT(errors("a = 1 }"), ElementsAre("E0102 11..11", "E0119 12..13"));
  EXPECT_THAT(errors("a: 1;"), ElementsAre("E0106 7..8"));
  EXPECT_THAT(errors("a = (1;"), ElementsAre("E0118 10..11"));
  EXPECT_THAT(errors("a = [1 2];"), ElementsAre("E0101 13..14"));
  EXPECT_THAT(errors("a = (1];"), ElementsAre("E0120 12..13"));
  EXPECT_THAT(errors("a = 1 < 2 < 3 < 4;"), ElementsAre("E0121 16..17"));
  EXPECT_THAT(errors("a = 5%2;"), ElementsAre("E0112 11..12"));
  EXPECT_THAT(errors("a = .5;"), ElementsAre("E0113 10..12"));
  EXPECT_THAT(errors("a = 1.;"), ElementsAre("E0128 11..12"));
  EXPECT_THAT(errors("a = #12;"), ElementsAre("E0114 10..13"));
  EXPECT_THAT(errors("a = \"\\q\\u{110000}\";"), ElementsAre("E0115 11..13", "E0115 13..15"));
  EXPECT_THAT(errors("a = b $ c;"), ElementsAre("E0122 12..13"));
  EXPECT_THAT(errors("a = \xC3\xA9;"), ElementsAre("E0122 10..12"));
  EXPECT_THAT(errors("/* x"), ElementsAre("E0117 6..8"));
  EXPECT_THAT(errors("else { }"), ElementsAre("E0126 6..10"));
  EXPECT_THAT(errors("sdl 1;"), ElementsAre("E0105 6..9"));
  EXPECT_THAT(errors("g { s { a = 1;"), ElementsAre("E0118 12..13"));
}

TEST(Recovery, the_edition_comes_first) {
  EXPECT_THAT(Parsed(Dialect::sdl, "").errors(), ElementsAre("E0103 0..0"));
  EXPECT_THAT(Parsed(Dialect::sdl, "// only a comment").errors(), ElementsAre("E0103 17..17"));
  EXPECT_THAT(Parsed(Dialect::sdl, "let a = 1;").errors(), ElementsAre("E0103 0..0"));
  EXPECT_THAT(Parsed(Dialect::sdl, "sdl 2;").errors(), ElementsAre("E0104 4..5"));
}

TEST(Recovery, bad_bytes_are_the_only_report) {
  EXPECT_THAT(Parsed(Dialect::sdl, std::string("sdl 1; \0 let", 12)).errors(),
              ElementsAre("E0123 7..8"));
  EXPECT_THAT(Parsed(Dialect::sdl, "sdl 1; \xC0\xAF \xFF").errors(), ElementsAre("E0124 7..8"));
  EXPECT_THAT(Parsed(Dialect::sdl, "sdl 1; // \xE2\x80\xAE\nlet a 1;").errors(),
              ElementsAre("E0125 10..13", "E0101 20..21"));
}

TEST(Recovery, a_lost_brace_is_not_reported_twice) {
  const auto errors = [](const std::string& text) {
    return Parsed(Dialect::sdl, "sdl 1;\n" + text).errors();
  };
  EXPECT_THAT(errors("sphere radius = 3; }\nlet a = 1;"), ElementsAre("E0101 14..20"));
  EXPECT_THAT(errors("if x = 3 { } else { }\nlet a = 1;"), ElementsAre("E0101 12..13"));
  EXPECT_THAT(errors("for i on x { a = ; }"), ElementsAre("E0101 13..15"));
}

TEST(Recovery, broken_text_stays_in_the_tree) {
  const Parsed parsed(Dialect::sdl, "sdl 1; sphere { a = 1 + * 2; b = 3; }");
  EXPECT_EQ(outline(parsed.tree),
            "(file (edition sdl 1) (shape sphere (block (error a (number_literal 1) + * 2;) (field "
            "b (number_literal 3)))))");
  const Parsed empty(Dialect::sdl, "sdl 1; a = ;");
  EXPECT_EQ(outline(empty.tree), "(file (edition sdl 1) (field a (error)))");
}

TEST(Recovery, a_flood_of_mistakes_ends) {
  std::string text = "sdl 1;\n";
  for (int i = 0; i < 100000; ++i) text += ";\n";
  const Parsed parsed(Dialect::sdl, text);
  EXPECT_EQ(parsed.sink.error_count(), 100u);
  EXPECT_EQ(reassembled_text(parsed.tree), parsed.text);
}

TEST(Recovery, names_the_whole_token_before_what_is_missing) {
  EXPECT_THAT(Parsed(Dialect::sdl, "sdl 1;\nrender { method = .path }\n").messages(),
              ElementsAre(testing::HasSubstr("expected `;` after `.path`, found `}`")));
  EXPECT_THAT(Parsed(Dialect::sdl, "sdl 1;\nlet a = \"x\"\n").messages(),
              ElementsAre(testing::HasSubstr("expected `;` after a string")));
}

}  // namespace
}  // namespace scenec::grammar
