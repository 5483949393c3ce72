// What the grammar tests share: parse a text, and see its tree and its diagnostics as text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.hpp"
#include "grammar/parse.hpp"
#include "grammar/syntax_tree.hpp"

namespace scenec::grammar {

struct Parsed {
  std::string text;
  DiagnosticSink sink;
  SyntaxTree tree;

  Parsed(Dialect dialect, std::string source, const ParseLimits& limits = {})
      : text(std::move(source)),
        tree(dialect == Dialect::sdl ? parse_sdl(FileId(0), text, sink, limits)
                                     : parse_course(FileId(0), text, sink, limits)) {}

  // "E0102 12..12" for each diagnostic, sorted.
  [[nodiscard]] std::vector<std::string> errors() const {
    std::vector<std::string> lines;
    for (const Diagnostic& one : sink.sorted()) {
      lines.push_back(std::string(info_of(one.kind).code) + " " + std::to_string(one.span.begin) +
                      ".." + std::to_string(one.span.end));
    }
    return lines;
  }
  [[nodiscard]] std::vector<std::string> messages() const {
    std::vector<std::string> lines;
    for (const Diagnostic& one : sink.sorted()) lines.push_back(one.message);
    return lines;
  }
};

// The tree without punctuation on one line: `(let let a (number_literal 1))`.
inline std::string outline(const SyntaxTree& tree) {
  std::string out;
  std::vector<std::uint32_t> ends;
  for (std::uint32_t index = 0; index < tree.nodes().size(); ++index) {
    const SyntaxNode& node = tree.nodes()[index];
    for (; !ends.empty() && ends.back() <= index; ends.pop_back()) out += ')';
    if (is_token(node.kind)) {
      if (node.kind != SyntaxKind::punctuation)
        out += ' ' + std::string(tree.text().substr(node.begin, node.end - node.begin));
      continue;
    }
    if (!out.empty()) out += ' ';
    out += '(' + std::string(name_of(node.kind));
    ends.push_back(node.next);
  }
  out.append(ends.size(), ')');
  return out;
}

}  // namespace scenec::grammar
