// Typed views of the native tree: which child of a node is its name, its expression, its block. The
// tree may be broken (syntax errors leave nodes without children); every part may be missing.
#pragma once

#include <string_view>

#include "base/inline_list.hpp"
#include "grammar/syntax_tree.hpp"

namespace scenec::frontend::ast {

using grammar::NodeRef;
using grammar::SyntaxKind;

// First child that is an expression (a node, no token) at or behind the position of `first`.
[[nodiscard]] inline bool is_expression(SyntaxKind kind) {
  return kind >= SyntaxKind::number_literal && kind <= SyntaxKind::or_chain &&
         kind != SyntaxKind::arguments && kind != SyntaxKind::argument;
}
[[nodiscard]] NodeRef expression_of(NodeRef node);
// The one behind it: the message of an `assert`.
[[nodiscard]] NodeRef second_expression_of(NodeRef node);

// `name = expr`.
struct Field {
  NodeRef name;
  NodeRef expression;
};
[[nodiscard]] Field field_of(NodeRef node);

// Every item with a block or a declared name.
//   shape: `kind [name] block`; light, camera, material: `[name] : kind block`; others `[name]
//   block`.
struct Item {
  NodeRef name;
  NodeRef kind;
  NodeRef type;
  NodeRef expression;
  NodeRef range;
  NodeRef parameters;
  NodeRef block;
  bool annotated = false;
};
[[nodiscard]] Item item_of(NodeRef node);

// `for i, x in range|expr`, of an item or a comprehension.
struct Loop {
  NodeRef first;   // the only name, or the index
  NodeRef second;  // the element when there are two names
  NodeRef range;
  NodeRef list;
  NodeRef body;  // block, or the expression behind the colon
};
[[nodiscard]] Loop loop_of(NodeRef node);

struct Range {
  NodeRef low;
  NodeRef high;
  bool closed = true;
};
[[nodiscard]] Range range_of(NodeRef node);

struct Argument {
  NodeRef name;  // empty: by position
  NodeRef expression;
};
using Arguments = InlineList<Argument, 4>;
[[nodiscard]] Arguments arguments_of(NodeRef arguments);

// The item a block item stands for in messages: "a light", "`let`".
[[nodiscard]] std::string_view item_words(SyntaxKind kind);

}  // namespace scenec::frontend::ast
