// The tables of docs/stdlib.md are made from the libraries: names, parameters, types and what `///`
// says. SCENEC_UPDATE_DOCS=1 writes them anew.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <string>
#include <string_view>

#include "base/source_map.hpp"
#include "frontend/ast/sdl_ast.hpp"
#include "frontend/lower/std_library.hpp"
#include "grammar/parse.hpp"
#include "tests/support/scenes.hpp"

namespace scenec::frontend {
namespace {

using grammar::NodeRef;
using grammar::SyntaxKind;

constexpr std::string_view table_head =
    "| name | model, type or parameters | what it is |\n|---|---|---|\n";

// The text of a node on one line, as it is written otherwise.
std::string one_line(std::string_view text) {
  std::string line;
  for (const char c : text) {
    const bool blank = c == ' ' || c == '\n' || c == '\r' || c == '\t';
    if (!blank) {
      line += c == '|' ? std::string("\\|") : std::string(1, c);
    } else if (!line.empty() && line.back() != ' ') {
      line += ' ';
    }
  }
  return line;
}
std::string code(std::string_view text) {
  return "`" + one_line(text) + "`";
}

std::string parameters_of(const ast::Item& item) {
  std::string text;
  for (const NodeRef parameter : item.parameters.children()) {
    if (!parameter.is(SyntaxKind::parameter)) continue;
    if (!text.empty()) text += ", ";
    text += code(parameter.text());
  }
  return text;
}

// What stands in the middle column; empty for items that are no declarations for others.
std::string kind_of(NodeRef node, const ast::Item& item) {
  switch (node.kind()) {
    case SyntaxKind::material:
      return code(item.kind.text());
    case SyntaxKind::let:
      EXPECT_TRUE(item.type) << "declare the type of `" << item.name.text() << "`";
      return item.type ? code(item.type.text()) : "?";
    case SyntaxKind::fn:
      EXPECT_TRUE(item.type) << "declare the result of `" << item.name.text() << "`";
      return parameters_of(item) + (item.type ? " → " + code(item.type.text()) : "");
    case SyntaxKind::macro:
      return parameters_of(item);
    case SyntaxKind::proto:
      return "proto";
    default:
      return "";
  }
}

std::string table_of(const LibraryFile& library) {
  SourceMap sources;
  DiagnosticSink sink;
  const FileId file = sources.add(std::string(library.name), std::string(library.text));
  const grammar::SyntaxTree tree = grammar::parse_sdl(file, sources.text(file), sink);
  EXPECT_FALSE(sink.has_errors()) << library.name;
  std::string rows(table_head);
  for (const NodeRef node : tree.root().children()) {
    if (grammar::is_token(node.kind())) continue;
    const ast::Item item = ast::item_of(node);
    if (!item.name) continue;
    const std::string kind = kind_of(node, item);
    const std::string doc = one_line(tree.documentation_of(node));
    EXPECT_NE(doc, "") << library.name << ": `" << item.name.text() << "` has no `///`";
    rows += "| " + code(item.name.text()) + " | " + kind + " | " + doc + " |\n";
  }
  return rows;
}

// Replaces the table behind the heading of the library; everything else is written by hand.
void replace_table(std::string& text, const LibraryFile& library) {
  const std::string mark = ": `" + std::string(library.name) + ".sdl`\n\n";
  const std::size_t at = text.find(mark);
  ASSERT_NE(at, std::string::npos) << "docs/stdlib.md has no heading `## Title" << mark;
  const std::size_t begin = at + mark.size();
  std::size_t end = begin;
  while (end < text.size() && text[end] == '|') end = text.find('\n', end) + 1;
  text.replace(begin, end - begin, table_of(library));
}

TEST(StdLibraryDocs, AreUpToDate) {
  const auto path = scenec::test::source_directory() / "docs" / "stdlib.md";
  const std::string before = scenec::test::text_of_file(path);
  std::string text = before;
  for (const LibraryFile& library : library_files()) replace_table(text, library);
  if (std::getenv("SCENEC_UPDATE_DOCS") != nullptr) {
    std::ofstream(path, std::ios::binary) << text;
    return;
  }
  EXPECT_EQ(before, text) << "run unit_frontend with SCENEC_UPDATE_DOCS=1 and read the difference";
}

}  // namespace
}  // namespace scenec::frontend
