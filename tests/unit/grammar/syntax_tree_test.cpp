// The tree loses nothing, whatever the bytes; comments find their declarations; the dump is stable.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/unit/grammar/inputs.hpp"
#include "tests/unit/grammar/parsing.hpp"

namespace scenec::grammar {
namespace {

// Every subtree lies within its parent, children follow each other, spans are those of the tokens.
void expect_sound(const SyntaxTree& tree) {
  const std::span<const SyntaxNode> nodes = tree.nodes();
  ASSERT_FALSE(nodes.empty());
  ASSERT_EQ(nodes[0].next, nodes.size());
  std::uint32_t place = 0;
  for (std::uint32_t index = 0; index < nodes.size(); ++index) {
    const SyntaxNode& node = nodes[index];
    ASSERT_GT(node.next, index);
    ASSERT_LE(node.begin, node.end);
    if (is_token(node.kind)) {
      ASSERT_EQ(node.next, index + 1);
      ASSERT_GE(node.begin, place);
      place = node.end;
      continue;
    }
    std::uint32_t child = index + 1;
    while (child < node.next) {
      ASSERT_GE(nodes[child].begin, node.begin);
      ASSERT_LE(nodes[child].end, node.end);
      child = nodes[child].next;
    }
    ASSERT_EQ(child, node.next);
  }
}

TEST(SyntaxTree, holds_every_byte_of_every_input) {
  for (const GoldenInput& input : golden_inputs()) {
    for (Dialect dialect : {Dialect::sdl, Dialect::course}) {
      const Parsed parsed(dialect, input.text);
      expect_sound(parsed.tree);
      EXPECT_EQ(reassembled_text(parsed.tree), input.text) << input.name;
      const bool broken =
          parsed.tree.nodes().end() !=
          std::find_if(parsed.tree.nodes().begin(), parsed.tree.nodes().end(),
                       [](const SyntaxNode& node) { return node.kind == SyntaxKind::error; });
      if (broken) {
        EXPECT_TRUE(parsed.sink.has_errors()) << input.name;
      }
    }
  }
}

TEST(SyntaxTree, well_formed_inputs_are_accepted) {
  std::size_t accepted = 0;
  for (const GoldenInput& input : golden_inputs()) {
    if (!Parsed(input.dialect, input.text).sink.has_errors()) ++accepted;
  }
  EXPECT_GE(accepted, 11u);
}

TEST(SyntaxTree, holds_every_byte_of_mutated_inputs) {
  const std::uint32_t seed = 20240611;
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  static constexpr char marks[] = "{}()[];:=,.@#\"/*\\%-+<>&|!? \n\rabz019e\x00\xFF\xE2\x80\xAE";
  const std::string bytes(marks, sizeof marks - 1);  // the NUL among them counts
  const auto below = [&](std::size_t limit) { return static_cast<std::size_t>(random()) % limit; };
  const std::vector<GoldenInput> inputs = golden_inputs();
  for (int round = 0; round < 4000; ++round) {
    std::string text = inputs[below(inputs.size())].text;
    for (std::size_t change = 1 + below(6); change > 0 && !text.empty(); --change) {
      const std::size_t place = below(text.size());
      switch (below(4)) {
        case 0:
          text[place] = bytes[below(bytes.size())];
          break;
        case 1:
          text.insert(place, 1, bytes[below(bytes.size())]);
          break;
        case 2:
          text.erase(place, 1 + below(8));
          break;
        default:
          text.resize(place);
          break;
      }
    }
    const Dialect dialect = below(3) == 0 ? Dialect::course : Dialect::sdl;
    const Parsed parsed(dialect, text);
    expect_sound(parsed.tree);
    ASSERT_EQ(reassembled_text(parsed.tree), text) << "round " << round;
    // What was dropped from the tree without a report would be silently ignored by the compiler.
    bool has_error = false;
    for (const SyntaxNode& node : parsed.tree.nodes())
      has_error =
          has_error || node.kind == SyntaxKind::error || node.kind == SyntaxKind::error_text;
    if (has_error) {
      ASSERT_TRUE(parsed.sink.has_errors()) << text;
    }
  }
}

TEST(SyntaxTree, documentation_is_what_stands_just_above) {
  const auto documentation = [](const std::string& text) {
    const Parsed parsed(Dialect::sdl, "sdl 1;\n" + text);
    const NodeRef let = parsed.tree.root().find_child(SyntaxKind::let);
    return parsed.tree.documentation_of(let);
  };
  EXPECT_EQ(documentation("/// one\r\n///two  \r\n  ///  three\r\nlet a = 1;"), "one\ntwo\n three");
  EXPECT_EQ(documentation("/// one\n@allow(x)\nlet a = 1;"), "one");
  EXPECT_EQ(documentation("/// lone CR\rlet a = 1;"), "lone CR");
  EXPECT_EQ(documentation("/// far\n\nlet a = 1;"), "");
  EXPECT_EQ(documentation("/// one\n// two\nlet a = 1;"), "");
  EXPECT_EQ(documentation("sphere { } /// behind code\nlet a = 1;"), "");
  EXPECT_EQ(documentation("//// four\nlet a = 1;"), "");
  EXPECT_EQ(documentation("let a = 1; /// behind"), "");
}

TEST(SyntaxTree, dump_shows_tokens_and_comments) {
  const Parsed parsed(Dialect::sdl, "// head\nsdl 1;\nlet a = -b; /* tail */");
  EXPECT_EQ(dump_tree(parsed.tree),
            "file\n"
            "  comment line_comment \"// head\"\n"
            "  edition\n"
            "    keyword \"sdl\"\n"
            "    number \"1\"\n"
            "    punctuation \";\"\n"
            "  let\n"
            "    keyword \"let\"\n"
            "    name \"a\"\n"
            "    punctuation \"=\"\n"
            "    unary\n"
            "      operator_token \"-\"\n"
            "      name_ref\n"
            "        name \"b\"\n"
            "    punctuation \";\"\n"
            "  comment block_comment \"/* tail */\"\n");
}

}  // namespace
}  // namespace scenec::grammar
