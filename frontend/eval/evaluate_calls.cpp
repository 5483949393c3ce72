// Calls of built-in functions, and who is called.
#include <fmt/format.h>

#include <algorithm>

#include "base/text.hpp"
#include "frontend/eval/arguments.hpp"
#include "frontend/eval/evaluate.hpp"
#include "frontend/eval/operators.hpp"

namespace scenec::frontend {

using grammar::NodeRef;
using grammar::SyntaxKind;

// ---- built-in functions

bool Evaluator::bind_builtin(Call& call, const Builtin& function, const ast::Arguments& given,
                             Scope& scope) {
  const auto parameters = function.parameters;
  ArgumentPlaces places;
  if (function.variadic) {
    call.arguments.grow(given.size());
    call.nodes.grow(given.size());
    for (std::size_t i = 0; i < given.size(); ++i) {
      places.push_back(i);
      if (!given[i].name) continue;
      session_.error(DiagnosticKind::unknown_argument, given[i].name.span(),
                     fmt::format("the arguments of `{}` have no names", function.name));
      return false;
    }
    if (given.empty()) {
      report_missing_argument(session_, call.node, function.name, parameters[0].name);
      return false;
    }
  } else {
    const auto name_of = [&](std::size_t i) { return parameters[i].name; };
    call.arguments.grow(parameters.size());
    call.nodes.grow(parameters.size());
    if (!place_arguments(session_, function.name, given, parameters.size(), name_of, places))
      return false;
  }
  bool sound = true;
  for (std::size_t i = 0; i < given.size(); ++i) {
    const std::size_t place = places[i];
    call.nodes[place] = given[i].expression;
    if (!given[i].expression) return false;
    const Accept accept = parameters[function.variadic ? 0 : place].accept;
    call.arguments[place] =
        accepted(session_, evaluate(given[i].expression, scope), accept, call.need(place));
    sound = sound && !call.arguments[place].poisoned();
    call.known = call.known && call.arguments[place].known;
  }
  for (std::size_t i = 0; sound && i < call.nodes.size(); ++i) {
    if (call.nodes[i] || !parameters[i].required) continue;
    report_missing_argument(session_, call.node, function.name, parameters[i].name);
    return false;
  }
  return sound;
}

Value Evaluator::call_builtin(NodeRef node, const Builtin& function, Scope& scope) {
  Call call{.session = session_,
            .node = node,
            .function = function.name,
            .parameters = function.parameters,
            .arguments = {},
            .nodes = {}};
  const auto given = ast::arguments_of(node.find_child(SyntaxKind::arguments));
  if (!bind_builtin(call, function, given, scope)) return {};
  return function.run(call);
}

// Evaluates only the alternative it needs; of the other the types are checked.
Value Evaluator::select(NodeRef node, Scope& scope) {
  constexpr std::array<std::string_view, 3> names{"cond", "a", "b"};
  const auto given = ast::arguments_of(node.find_child(SyntaxKind::arguments));
  ArgumentPlaces places;
  if (!place_arguments(
          session_, "select", given, names.size(), [&](std::size_t i) { return names[i]; }, places))
    return {};
  std::array<NodeRef, 3> parts;
  for (std::size_t i = 0; i < given.size(); ++i) parts[places[i]] = given[i].expression;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (parts[i]) continue;
    report_missing_argument(session_, node, "select", names[i]);
    return {};
  }
  const Value chosen = condition(session_, evaluate(parts[0], scope), "select", parts[0]);
  const auto typed = [&](NodeRef part) {
    const Session::CheckOnly check(session_);
    return evaluate(part, scope);
  };
  const bool decided = !chosen.poisoned() && chosen.known;
  Value a = decided && chosen.boolean() ? evaluate(parts[1], scope) : typed(parts[1]);
  Value b = decided && !chosen.boolean() ? evaluate(parts[2], scope) : typed(parts[2]);
  if (chosen.poisoned() || a.poisoned() || b.poisoned()) return {};
  Value result = decided && !chosen.boolean() ? b : a;
  result.literal_zero = false;
  if (a.is_number() && b.is_number()) {
    const auto dimension = common_dimension(a, b);
    if (!dimension)
      return mixed_dimensions(session_, node.span(), "select", a, b, parts[1], parts[2]);
    if (a.type != b.type || a.dimension != b.dimension) {
      const bool known = result.known;
      result = make_number(result.real(), *dimension);
      result.known = known;
    }
  } else if (a.type != b.type && !(is_listlike(a) && is_listlike(b))) {
    return session_.error(Diagnostic(DiagnosticKind::type_mismatch, node.span(),
                                     fmt::format("the alternatives of `select` are {} and {}",
                                                 described(a), described(b)))
                              .hint("both must have one type"));
  }
  return decided ? result : type_of(result);
}

Value Evaluator::call(NodeRef node, NodeRef callee, Scope& scope) {
  const Scope::Found found = scope.find(callee.text(), callee.span());
  if (found.binding != nullptr) {
    found.binding->used = true;
    return call_binding(node, callee, found, scope);
  }
  const char* place = callee.text().data();
  if (const auto* known = builtins_.find(place)) return call_builtin(node, **known, scope);
  if (callee.text() == "select") return select(node, scope);
  if (const Builtin* function = find_builtin(callee.text())) {
    builtins_.put(place, function);
    return call_builtin(node, *function, scope);
  }
  std::vector<std::string_view> names = builtin_names();
  for (Scope* at = &scope; at != nullptr; at = at->parent()) {
    for (const Binding& binding : at->bindings()) {
      if (binding.kind == BindingKind::function) names.push_back(binding.name);
    }
  }
  session_.report(unknown_word(DiagnosticKind::unknown_function, callee.span(),
                               fmt::format("there is no function `{}`", printable(callee.text())),
                               callee.text(), names, "functions"));
  return {};
}

}  // namespace scenec::frontend
