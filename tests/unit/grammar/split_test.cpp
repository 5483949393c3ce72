// Where a text may be cut, and that the trees of its parts are, put together, the tree of the
// whole.
#include "grammar/split.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/unit/grammar/parsing.hpp"

namespace scenec::grammar {
namespace {

std::vector<std::string> parts_of(const std::string& text, std::size_t least,
                                  const ParseLimits& limits = {}) {
  std::vector<std::string> parts;
  ItemSplitter splitter(text, limits);
  while (const auto part = splitter.next(least))
    parts.push_back(text.substr(part->begin, part->end - part->begin));
  if (!splitter.finished()) parts.push_back("stuck");
  return parts;
}

using Parts = std::vector<std::string>;

TEST(Split, a_part_ends_behind_an_item) {
  EXPECT_EQ(parts_of("sdl 1; let a = 1;\nsphere { radius = 1; }", 1),
            (Parts{"sdl 1;", " let a = 1;", "\nsphere { radius = 1; }"}));
  EXPECT_EQ(parts_of("sdl 1; let a = 1; let b = 2; let c = 3;", 11),
            (Parts{"sdl 1; let a = 1;", " let b = 2;", " let c = 3;"}));
  EXPECT_EQ(parts_of("", 1), Parts{});
  EXPECT_EQ(parts_of("sdl 1;\n// the end", 1), (Parts{"sdl 1;", "\n// the end"}));
}

TEST(Split, comments_and_strings_hide_marks) {
  EXPECT_EQ(parts_of("a { // } ;\n /* } ; \n */ b = \"} ; \\\" }\"; } c();", 1),
            (Parts{"a { // } ;\n /* } ; \n */ b = \"} ; \\\" }\"; }", " c();"}));
  EXPECT_EQ(parts_of("let a = 1 / 2; // ; }\nlet b = 2;", 1),
            (Parts{"let a = 1 / 2;", " // ; }\nlet b = 2;"}));
}

TEST(Split, else_belongs_to_its_if) {
  EXPECT_EQ(parts_of("if a { } /* } */ else if b { }\nelse { } elsewhere {}", 1),
            (Parts{"if a { } /* } */ else if b { }\nelse { }", " elsewhere {}"}));
}

TEST(Split, what_cannot_be_cut_is_left_to_the_whole) {
  EXPECT_EQ(parts_of("a { } }", 1), (Parts{"a { }", "stuck"}));
  EXPECT_EQ(parts_of("a { ", 1), Parts{"stuck"});
  EXPECT_EQ(parts_of("a(); /* ", 1), (Parts{"a();", "stuck"}));
  const ParseLimits short_lines{.line = 8};
  EXPECT_EQ(parts_of("a();a();\nb();", 1, short_lines), (Parts{"a();", "a();", "\nb();"}));
  EXPECT_EQ(parts_of("a();a();a();\nb();", 1, short_lines),
            (Parts{"a();", "a();", "a();", "stuck"}));
  EXPECT_EQ(parts_of("a(); /* 0123456789 */", 1, short_lines), (Parts{"a();", "stuck"}));
}

TEST(Split, the_trees_of_the_parts_are_the_tree_of_the_whole) {
  const std::string text =
      "\xEF\xBB\xBFsdl 1; // first\n@allow(no_light) /* a */ sphere ball { center = [1, -2.5m, 3]; "
      "}\n"
      "/// documented\nlet a = (1 + 2) * f(x = 3)[0].y; if a < 1 { } else { b(); }\n";
  const Parsed whole(Dialect::sdl, text);
  ASSERT_EQ(whole.errors(), Parts{});
  std::string put_together;
  std::vector<std::uint32_t> trivia;
  ItemSplitter splitter(text);
  DiagnosticSink sink;
  while (const auto place = splitter.next(1)) {
    const SyntaxTree part = parse_sdl_part(FileId(0), text, *place, sink);
    for (NodeRef item : part.root().children()) {
      put_together += std::string(name_of(item.kind())) + std::to_string(item.span().begin) + ".." +
                      std::to_string(item.span().end) + '\n';
      for (NodeRef child : item.children()) put_together += std::string(child.text()) + '\n';
    }
    for (const Trivia& one : part.trivia()) trivia.push_back(one.begin);
  }
  std::string expected;
  std::vector<std::uint32_t> expected_trivia;
  for (NodeRef item : whole.tree.root().children()) {
    expected += std::string(name_of(item.kind())) + std::to_string(item.span().begin) + ".." +
                std::to_string(item.span().end) + '\n';
    for (NodeRef child : item.children()) expected += std::string(child.text()) + '\n';
  }
  for (const Trivia& one : whole.tree.trivia()) expected_trivia.push_back(one.begin);
  EXPECT_EQ(put_together, expected);
  EXPECT_EQ(trivia, expected_trivia);
  EXPECT_EQ(sink.error_count(), 0u);
}

}  // namespace
}  // namespace scenec::grammar
