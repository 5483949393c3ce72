// How much a loop or macro call is bound to do before it is run: a lower bound of the items it
// places and of the steps it takes, so that a scene of a few lines that asks for billions of things
// is refused at once and in one place.
//
// Trip counts that are constant where the bound is asked for are multiplied through bodies; what
// depends on anything else counts as no round. Numbers saturate. A macro is looked at once for each
// set of constant arguments, so the work is bounded by the text, not by what it expands to.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "frontend/ast/sdl_ast.hpp"
#include "frontend/eval/evaluate.hpp"
#include "frontend/session.hpp"

namespace scenec::frontend {

struct Amount {
  std::uint64_t items = 0;
  std::uint64_t steps = 0;
};

class ItemBound {
 public:
  ItemBound(Session& session, Evaluator& evaluator) : session_(session), evaluator_(evaluator) {}

  // Of a loop or macro call about to be run in `scope`.
  [[nodiscard]] Amount of(grammar::NodeRef node, Scope& scope) { return item(node, scope, 0); }

 private:
  using NodeRef = grammar::NodeRef;
  // A macro and those of its arguments that are constant integers.
  using MacroKey = std::tuple<const grammar::SyntaxTree*, std::uint32_t,
                              std::vector<std::optional<std::int64_t>>>;

  Amount block(NodeRef node, Scope& scope, int depth);
  Amount item(NodeRef node, Scope& scope, int depth);
  Amount loop(NodeRef node, Scope& scope, int depth);
  Amount branches(NodeRef node, Scope& scope, int depth);
  Amount call(NodeRef node, Scope& scope, int depth);
  [[nodiscard]] std::uint64_t rounds(const ast::Loop& parts, Scope& scope);
  // The value when it is found without much work: no calls of the author's functions, no lists
  // made.
  [[nodiscard]] Value constant(NodeRef expression, Scope& scope);
  [[nodiscard]] Scope::Found macro_of(NodeRef call, Scope& scope);

  Session& session_;
  Evaluator& evaluator_;
  std::map<MacroKey, Amount> macros_;
  std::uint64_t visits_ = 0;
};

}  // namespace scenec::frontend
