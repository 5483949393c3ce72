// Loops, branches, assertions and macro calls. What is run has been checked where it is written;
// while it runs, only values are looked at again.
#include <fmt/format.h>

#include <optional>

#include "base/text.hpp"
#include "frontend/eval/operators.hpp"
#include "frontend/lower/lowering_access.hpp"

namespace scenec::frontend {

using grammar::SyntaxKind;

// Whether the loop or call can be run within the limits; what is run already has been asked for.
bool Lowering::affordable(NodeRef node, Scope& scope) {
  if (session_.running()) return true;
  const Amount least = item_bound_.of(node, scope);
  const NodeRef head = node.find_child(node.is(SyntaxKind::call_item) ? SyntaxKind::qualified_name
                                                                      : SyntaxKind::keyword);
  return session_.affords(least.items, least.steps, head ? head.span() : node.span());
}

// The block in a scope of its own.
void Lowering::body(NodeRef block, Scope& scope, const Surroundings& around) {
  Scope inside(&scope);
  items(block, inside, around);
  close(inside);
}

void Lowering::for_loop(NodeRef node, Scope& scope, const Surroundings& around) {
  const ast::Loop parts = ast::loop_of(node);
  if (!parts.body) return;
  const auto round = [&](Scope& variables) {
    body(parts.body, variables, around);
    return !session_.out_of_steps() && session_.item_count() <= session_.options.limits.items;
  };
  if (!session_.running()) {
    const Session::CheckOnly check(session_);
    evaluator_.loop(parts, scope, round);
  }
  if (session_.checking_only() || !affordable(node, scope)) return;
  const Session::Running run(session_);
  evaluator_.loop(parts, scope, round);
}

// `if ... else if ... else`: the branches follow each other in a loop, however many there are.
void Lowering::if_chain(NodeRef node, Scope& scope, const Surroundings& around) {
  bool decided = false;
  const auto branch = [&](NodeRef block, bool taken) {
    if (taken) return body(block, scope, around);
    if (session_.running()) return;
    const Session::CheckOnly check(session_);
    body(block, scope, around);
  };
  for (NodeRef at = node; at;) {
    NodeRef next;
    std::vector<NodeRef> blocks;
    for (NodeRef child : at.children()) {
      if (child.is(SyntaxKind::block)) blocks.push_back(child);
      if (child.is(SyntaxKind::if_item)) next = child;
    }
    const NodeRef test = ast::expression_of(at);
    Value truth;
    if (decided) {
      if (!session_.running()) {
        const Session::CheckOnly check(session_);
        truth = condition(session_, evaluator_.evaluate(test, scope), "if", test);
      }
    } else if (test) {
      truth = condition(session_, evaluator_.evaluate(test, scope), "if", test);
    }
    const bool known = !truth.poisoned() && truth.known && !session_.checking_only();
    const bool taken = known && !decided && truth.boolean();
    if (!blocks.empty()) branch(blocks[0], taken);
    if (!known && !decided) decided = true;  // a mistake in the condition: no branch is run
    decided = decided || taken;
    if (blocks.size() > 1) branch(blocks[1], !decided);
    at = next;
  }
}

void Lowering::assertion(NodeRef node, Scope& scope) {
  const NodeRef test = ast::expression_of(node);
  if (!test) return;
  const Value truth = condition(session_, evaluator_.evaluate(test, scope), "assert", test);
  const bool fails = !truth.poisoned() && truth.known && !truth.boolean();
  std::string text = "the assertion does not hold";
  if (const NodeRef words = ast::second_expression_of(node)) {
    std::optional<Session::CheckOnly> check;  // of an unused message only the type matters
    if (!fails) check.emplace(session_);
    const Value message = accepted(session_, evaluator_.evaluate(words, scope), Accept::string,
                                   {.subject = "assert", .node = words});
    if (message.is(Type::string) && message.known) text = printable(message.text(), 400);
  }
  if (fails) session_.error(DiagnosticKind::assertion_failed, test.span(), std::move(text));
}

void Lowering::macro_call(NodeRef node, Scope& scope, const Surroundings& around) {
  const NodeRef qualified = node.find_child(SyntaxKind::qualified_name);
  const NodeRef arguments = node.find_child(SyntaxKind::arguments);
  if (!qualified || !arguments) return;
  std::vector<NodeRef> names;
  for (NodeRef child : qualified.children()) {
    if (child.is(SyntaxKind::name)) names.push_back(child);
  }
  if (names.empty()) return;
  Scope::Found found;
  if (names.size() == 1) {
    found = evaluator_.resolve(names[0], scope);
  } else if (const auto space = evaluator_.name_space(names[0], scope)) {
    if (*space == nullptr) return;
    found = evaluator_.resolve_in(**space, names[0], names[1]);
  } else {
    static_cast<void>(evaluator_.resolve(names[0], scope));
  }
  if (found.binding == nullptr) return;
  const NodeRef name = names.back();
  const NodeRef declaration = found.binding->node;
  if (found.binding->kind != BindingKind::macro) {
    session_.error(Diagnostic(DiagnosticKind::name_without_value, name.span(),
                              fmt::format("`{}` is a {}, not a macro", printable(name.text()),
                                          text_of(found.binding->kind)))
                       .note("declared here", found.binding->span));
    return;
  }
  if (evaluator_.is_active(declaration)) {
    static_cast<void>(evaluator_.recursion(node, name.text(), declaration));
    return;
  }
  const ast::Item parts = ast::item_of(declaration);
  Scope inside(found.scope);
  const bool sound =
      evaluator_.bind_arguments(parts.parameters, arguments, node, name.text(), scope, inside);
  if (!sound || session_.checking_only() || !parts.block) return;
  const Evaluator::Activating activating(evaluator_, declaration);
  if (!affordable(node, scope) || !evaluator_.may_go_deeper(node)) return;
  const Session::Expanding expanding(session_, Session::Callee::macro, name.text(), node.span());
  body(parts.block, inside, around);
}

}  // namespace scenec::frontend
