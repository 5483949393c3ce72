// `dump --stage ast`: the native tree without punctuation, keywords and trivia, one construct a
// line.
#include <string>
#include <vector>

#include "base/text.hpp"
#include "frontend/compile.hpp"
#include "grammar/syntax_tree.hpp"

namespace scenec::frontend {

using grammar::NodeRef;
using grammar::SyntaxKind;

namespace {

// Leaves are shown behind the construct they belong to.
bool is_shown_token(NodeRef node) {
  switch (node.kind()) {
    case SyntaxKind::name:
    case SyntaxKind::number:
    case SyntaxKind::string:
    case SyntaxKind::color:
    case SyntaxKind::enum_value:
    case SyntaxKind::operator_token:
    case SyntaxKind::error_text:
      return true;
    case SyntaxKind::keyword:
      return node.text() == "true" || node.text() == "false";
    case SyntaxKind::punctuation:
      return node.text() == "..<" || node.text() == "..";
    default:
      return false;
  }
}

}  // namespace

std::string dump_ast(const grammar::SyntaxTree& native) {
  std::string text;
  std::vector<std::uint32_t> ends;  // of the constructs around the present one
  const auto& nodes = native.nodes();
  for (std::uint32_t i = 0; i < nodes.size(); ++i) {
    const NodeRef node(&native, i);
    if (grammar::is_token(node.kind())) continue;
    while (!ends.empty() && i >= ends.back()) ends.pop_back();
    text.append(2 * ends.size(), ' ');
    text += grammar::name_of(node.kind());
    for (NodeRef child : node.children()) {
      if (is_shown_token(child)) text += ' ' + printable(child.text());
    }
    text += '\n';
    ends.push_back(nodes[i].next);
  }
  return text;
}

}  // namespace scenec::frontend
