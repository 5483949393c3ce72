// Formats texts from memory, and compares what formatting must not change.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.hpp"
#include "base/source_map.hpp"
#include "frontend/format/formatter.hpp"
#include "grammar/parse.hpp"

namespace scenec::frontend::test {

// A text with its tree; nothing for a text with errors.
class Parsed {
 public:
  Parsed(std::string text, grammar::Dialect dialect) {
    const FileId file = sources_.add("scene", std::move(text));
    const auto parse =
        dialect == grammar::Dialect::sdl ? grammar::parse_sdl : grammar::parse_course;
    tree_ = parse(file, sources_.text(file), sink_, {});
  }
  [[nodiscard]] bool has_errors() const { return sink_.has_errors(); }
  [[nodiscard]] const grammar::SyntaxTree& tree() const { return tree_; }

  // The texts of the tokens in order, without the comma behind the last element of a list.
  [[nodiscard]] std::vector<std::string> tokens() const {
    std::vector<std::string> texts;
    for (const grammar::SyntaxNode& node : tree_.nodes()) {
      if (!grammar::is_token(node.kind)) continue;
      std::string text(tree_.text().substr(node.begin, node.end - node.begin));
      const bool closes = text == ")" || text == "]";
      if (closes && !texts.empty() && texts.back() == ",") texts.pop_back();
      texts.push_back(std::move(text));
    }
    return texts;
  }
  // The texts of the comments in order, without blanks and line ends in CR LF.
  [[nodiscard]] std::vector<std::string> comments() const {
    std::vector<std::string> texts;
    for (const grammar::Trivia& one : tree_.trivia()) {
      std::string& text = texts.emplace_back();
      for (const char c : tree_.text().substr(one.begin, one.end - one.begin)) {
        if (c != ' ' && c != '\t' && c != '\r') text += c;
      }
    }
    return texts;
  }
  // What `///` says about each item, in order.
  [[nodiscard]] std::vector<std::string> documentation() const {
    std::vector<std::string> texts;
    for (std::uint32_t i = 0; i < tree_.nodes().size(); ++i) {
      const grammar::NodeRef node(&tree_, i);
      const bool holds_items =
          node.is(grammar::SyntaxKind::file) || node.is(grammar::SyntaxKind::block);
      if (!holds_items) continue;
      for (const grammar::NodeRef item : node.children()) {
        if (!grammar::is_token(item.kind())) texts.push_back(tree_.documentation_of(item));
      }
    }
    return texts;
  }

 private:
  SourceMap sources_;
  DiagnosticSink sink_;
  grammar::SyntaxTree tree_;
};

inline std::optional<std::string> formatted(const std::string& text, grammar::Dialect dialect) {
  const Parsed parsed(text, dialect);
  if (parsed.has_errors()) return std::nullopt;
  return format(parsed.tree());
}

// Native text behind the edition line, which is left out of the result.
inline std::string formatted_items(const std::string& items) {
  const std::string edition = "sdl 1;\n";
  const auto text = formatted(edition + items, grammar::Dialect::sdl);
  if (!text) return "(syntax error)";
  return text->starts_with(edition) ? text->substr(edition.size()) : *text;
}
inline std::string formatted_course(const std::string& text) {
  return formatted(text, grammar::Dialect::course).value_or("(syntax error)");
}

// What is wrong with the formatting of a text that parses, or nothing.
inline std::string problem_of(const std::string& text, grammar::Dialect dialect) {
  const Parsed before(text, dialect);
  const std::string once = format(before.tree());
  const Parsed after(once, dialect);
  if (after.has_errors()) return "does not parse any more:\n" + once;
  if (before.tokens() != after.tokens()) return "tokens differ:\n" + once;
  if (before.comments() != after.comments()) return "comments differ:\n" + once;
  if (before.documentation() != after.documentation()) return "documentation differs:\n" + once;
  const std::string twice = format(after.tree());
  if (twice != once) return "formatted again it differs:\n" + once + "\n---\n" + twice;
  return {};
}

}  // namespace scenec::frontend::test
