// Calls: binding arguments to parameters, built-in functions and the author's own.
#include <fmt/format.h>

#include <algorithm>

#include "base/text.hpp"
#include "frontend/eval/evaluate.hpp"
#include "frontend/eval/operators.hpp"

namespace scenec::frontend {

using grammar::NodeRef;
using grammar::SyntaxKind;

bool Evaluator::is_active(NodeRef declaration) const {
  return std::find(active_.begin(), active_.end(), declaration) != active_.end();
}

Value Evaluator::recursion(NodeRef call, std::string_view name, NodeRef declaration) {
  const NodeRef declared = ast::item_of(declaration).name;
  return session_.error(Diagnostic(DiagnosticKind::recursive_call, call.span(), fmt::format("`{}` calls itself", printable(name)))
                            .note("declared here", declared ? declared.span() : declaration.span()));
}

namespace {

// Where each argument goes: the index of its parameter. False when one has no place (reported).
template <class NameOf>
bool place_arguments(Session& session, std::string_view callee, const std::vector<ast::Argument>& given, std::size_t parameter_count,
                     NameOf&& name_of, std::vector<std::size_t>& places) {
  std::vector<NodeRef> taken(parameter_count);
  bool named = false;
  for (std::size_t i = 0; i < given.size(); ++i) {
    const ast::Argument& argument = given[i];
    std::size_t place = i;
    const Span span = argument.name ? argument.name.span() : argument.expression ? argument.expression.span() : Span{};
    if (argument.name) {
      named = true;
      place = 0;
      while (place < parameter_count && name_of(place) != argument.name.text()) ++place;
      if (place == parameter_count) {
        std::vector<std::string_view> names;
        for (std::size_t k = 0; k < parameter_count; ++k) names.push_back(name_of(k));
        session.report(unknown_word(DiagnosticKind::unknown_argument, span,
                                    fmt::format("`{}` has no parameter `{}`", printable(callee), printable(argument.name.text())),
                                    argument.name.text(), names, "parameters"));
        return false;
      }
    } else if (named) {
      session.error(DiagnosticKind::unknown_argument, span, "an argument by position stands behind one by name");
      return false;
    } else if (place >= parameter_count) {
      session.error(DiagnosticKind::too_many_arguments, span,
                    fmt::format("`{}` takes {} argument{}; found {}", printable(callee), parameter_count, parameter_count == 1 ? "" : "s", given.size()));
      return false;
    }
    if (taken[place]) {
      session.error(Diagnostic(DiagnosticKind::unknown_argument, span, fmt::format("`{}` is given twice", printable(name_of(place))))
                        .note("first given here", taken[place].span()));
      return false;
    }
    taken[place] = argument.expression;
    places.push_back(place);
  }
  return true;
}

void report_missing(Session& session, NodeRef call, std::string_view callee, std::string_view parameter) {
  session.error(DiagnosticKind::missing_argument, call.span(), fmt::format("`{}` needs `{}`", printable(callee), printable(parameter)));
}

}  // namespace

// ---- built-in functions

bool Evaluator::bind_builtin(Call& call, const Builtin& function, const std::vector<ast::Argument>& given, Scope& scope) {
  const auto parameters = function.parameters;
  std::vector<std::size_t> places;
  if (function.variadic) {
    call.arguments.resize(given.size());
    call.nodes.resize(given.size());
    for (std::size_t i = 0; i < given.size(); ++i) {
      places.push_back(i);
      if (!given[i].name) continue;
      session_.error(DiagnosticKind::unknown_argument, given[i].name.span(), fmt::format("the arguments of `{}` have no names", function.name));
      return false;
    }
    if (given.empty()) {
      report_missing(session_, call.node, function.name, parameters[0].name);
      return false;
    }
  } else {
    const auto name_of = [&](std::size_t i) { return parameters[i].name; };
    call.arguments.resize(parameters.size());
    call.nodes.resize(parameters.size());
    if (!place_arguments(session_, function.name, given, parameters.size(), name_of, places)) return false;
  }
  bool sound = true;
  for (std::size_t i = 0; i < given.size(); ++i) {
    const std::size_t place = places[i];
    call.nodes[place] = given[i].expression;
    if (!given[i].expression) return false;
    const Accept accept = parameters[function.variadic ? 0 : place].accept;
    call.arguments[place] = accepted(session_, evaluate(given[i].expression, scope), accept, call.need(place));
    sound = sound && !call.arguments[place].poisoned();
    call.known = call.known && call.arguments[place].known;
  }
  for (std::size_t i = 0; sound && i < call.nodes.size(); ++i) {
    if (call.nodes[i] || !parameters[i].required) continue;
    report_missing(session_, call.node, function.name, parameters[i].name);
    return false;
  }
  return sound;
}

Value Evaluator::call_builtin(NodeRef node, const Builtin& function, Scope& scope) {
  Call call{.session = session_, .node = node, .function = function.name, .parameters = function.parameters, .arguments = {}, .nodes = {}};
  const auto given = ast::arguments_of(node.find_child(SyntaxKind::arguments));
  if (!bind_builtin(call, function, given, scope)) return {};
  return function.run(call);
}

// Evaluates only the alternative it needs; of the other the types are checked.
Value Evaluator::select(NodeRef node, Scope& scope) {
  constexpr std::array<std::string_view, 3> names{"cond", "a", "b"};
  const auto given = ast::arguments_of(node.find_child(SyntaxKind::arguments));
  std::vector<std::size_t> places;
  if (!place_arguments(session_, "select", given, names.size(), [&](std::size_t i) { return names[i]; }, places)) return {};
  std::array<NodeRef, 3> parts;
  for (std::size_t i = 0; i < given.size(); ++i) parts[places[i]] = given[i].expression;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (parts[i]) continue;
    report_missing(session_, node, "select", names[i]);
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
    if (!dimension) return mixed_dimensions(session_, node.span(), "select", a, b, parts[1], parts[2]);
    if (a.type != b.type || a.dimension != b.dimension) {
      const bool known = result.known;
      result = make_number(result.real(), *dimension);
      result.known = known;
    }
  } else if (a.type != b.type && !(is_listlike(a) && is_listlike(b))) {
    return session_.error(Diagnostic(DiagnosticKind::type_mismatch, node.span(),
                                     fmt::format("the alternatives of `select` are {} and {}", described(a), described(b)))
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
  if (callee.text() == "select") return select(node, scope);
  if (const Builtin* function = find_builtin(callee.text())) return call_builtin(node, *function, scope);
  std::vector<std::string_view> names = builtin_names();
  for (Scope* at = &scope; at != nullptr; at = at->parent()) {
    for (const Binding& binding : at->bindings()) {
      if (binding.kind == BindingKind::function) names.push_back(binding.name);
    }
  }
  session_.report(unknown_word(DiagnosticKind::unknown_function, callee.span(),
                               fmt::format("there is no function `{}`", printable(callee.text())), callee.text(), names, "functions"));
  return {};
}

// ---- functions of the author

Value Evaluator::in_range(const Value& value, NodeRef range_node, Scope& scope, std::string_view subject, Span span) {
  if (!range_node || value.poisoned()) return value;
  const ast::Range range = ast::range_of(range_node);
  if (!range.low || !range.high) return value;
  if (!value.is_number()) {
    return session_.error(DiagnosticKind::type_mismatch, range_node.span(), fmt::format("only numbers have a range; `{}` is {}", printable(subject), described(value)));
  }
  std::array<Value, 2> ends;
  for (std::size_t i = 0; i < 2; ++i) {
    const NodeRef node = i == 0 ? range.low : range.high;
    const Value end = evaluate(node, scope);
    ends[i] = value.is(Type::integer) ? coerce(session_, end, integer_type, {.subject = subject, .node = node})
                                      : coerce_quantity(session_, end, value.dimension, {.subject = subject, .node = node});
    if (ends[i].poisoned()) return {};
    if (!ends[i].known) return value;
  }
  if (!value.known) return value;
  const auto below = [](const Value& a, const Value& b) { return a.is(Type::integer) ? a.integer < b.integer : a.real() < b.real(); };
  if (!below(value, ends[0]) && (range.closed ? !below(ends[1], value) : below(value, ends[1]))) return value;
  return session_.error(Diagnostic(DiagnosticKind::out_of_range, span,
                                   fmt::format("`{}` is {}; needs {} {} {}", printable(subject), quantity_text(value.real(), value.dimension),
                                               quantity_text(ends[0].real(), value.dimension), range.closed ? ".." : "..<",
                                               quantity_text(ends[1].real(), value.dimension)))
                            .note("the range is declared here", range_node.span()));
}

namespace {

std::vector<ast::Item> parameters_of(NodeRef list) {
  std::vector<ast::Item> parameters;
  if (!list) return parameters;
  for (NodeRef child : list.children()) {
    if (child.is(SyntaxKind::parameter)) parameters.push_back(ast::item_of(child));
  }
  return parameters;
}

Binding parameter_binding(const ast::Item& parameter, Value value) {
  Binding binding{.name = parameter.name.text(), .span = parameter.name.span(), .kind = BindingKind::parameter, .value = std::move(value), .node = {}};
  binding.lint_unused = false;
  return binding;
}

}  // namespace

bool Evaluator::bind_arguments(NodeRef parameter_list, NodeRef arguments, NodeRef call, std::string_view callee, Scope& caller, Scope& into) {
  if (!session_.spend(steps_per_scope, call.span())) return false;
  const std::vector<ast::Item> parameters = parameters_of(parameter_list);
  for (const ast::Item& parameter : parameters) {
    if (!parameter.name) return false;
  }
  const auto given = ast::arguments_of(arguments);
  std::vector<std::size_t> places;
  const auto name_of = [&](std::size_t i) { return parameters[i].name.text(); };
  if (!place_arguments(session_, callee, given, parameters.size(), name_of, places)) return false;
  std::vector<NodeRef> expressions(parameters.size());
  for (std::size_t i = 0; i < given.size(); ++i) expressions[places[i]] = given[i].expression;
  bool sound = true;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const ast::Item& parameter = parameters[i];
    const bool given_here = static_cast<bool>(expressions[i]);
    const NodeRef expression = given_here ? expressions[i] : parameter.expression;
    if (!expression) {
      report_missing(session_, call, callee, parameter.name.text());
      sound = false;
      continue;
    }
    const auto type = read_type(session_, parameter.type);
    const Need need{.subject = parameter.name.text(), .function = callee, .node = expression};
    Value value = evaluate(expression, given_here ? caller : into);
    value = type ? coerce(session_, value, *type, need) : Value{};
    value = in_range(value, parameter.range, into, parameter.name.text(), expression.span());
    sound = sound && !value.poisoned();
    if (into.find_here(parameter.name.text()) == nullptr) into.add(parameter_binding(parameter, std::move(value)));
  }
  return sound;
}

void Evaluator::bind_unknown_parameters(NodeRef parameter_list, Scope& into) {
  for (const ast::Item& parameter : parameters_of(parameter_list)) {
    if (!parameter.name) continue;
    const auto type = read_type(session_, parameter.type);
    Value value = type ? unknown_of(*type) : Value{};
    if (parameter.expression) {
      const Need need{.subject = parameter.name.text(), .function = {}, .node = parameter.expression};
      const Value given = evaluate(parameter.expression, into);
      if (type) static_cast<void>(coerce(session_, given, *type, need));
    }
    static_cast<void>(in_range(value, parameter.range, into, parameter.name.text(), parameter.name.span()));
    if (const Binding* before = into.find_here(parameter.name.text())) {
      session_.error(Diagnostic(DiagnosticKind::duplicate_name, parameter.name.span(),
                                fmt::format("`{}` is declared twice", printable(parameter.name.text())))
                         .note("first declared here", before->span));
      continue;
    }
    into.add(parameter_binding(parameter, std::move(value)));
  }
}

void Evaluator::check_function(NodeRef function, Scope& scope) {
  const Session::CheckOnly check(session_);
  const Activating activating(*this, function);
  const ast::Item parts = ast::item_of(function);
  Scope inside(&scope);
  bind_unknown_parameters(parts.parameters, inside);
  const auto type = parts.type ? read_type(session_, parts.type) : std::nullopt;
  const Value value = evaluate(parts.expression, inside);
  if (!parts.expression || !parts.name) return;
  const Need need{.subject = parts.name.text(), .function = {}, .node = parts.expression};
  static_cast<void>(type ? coerce(session_, value, *type, need) : coerce_named(session_, value, need));
}

Value Evaluator::call_binding(NodeRef node, NodeRef callee, Scope::Found found, Scope& scope) {
  const NodeRef declaration = found.binding->node;
  if (found.binding->kind != BindingKind::function) {
    const bool macro = found.binding->kind == BindingKind::macro;
    return session_.error(Diagnostic(DiagnosticKind::unknown_function, callee.span(),
                                     fmt::format("`{}` is a {}, not a function", printable(callee.text()), text_of(found.binding->kind)))
                              .note(macro ? "macros are called as items, outside of expressions" : "declared here", found.binding->span));
  }
  if (is_active(declaration)) return recursion(node, callee.text(), declaration);
  const ast::Item parts = ast::item_of(declaration);
  Scope inside(found.scope);
  if (!bind_arguments(parts.parameters, node.find_child(SyntaxKind::arguments), node, callee.text(), scope, inside)) return {};
  const Activating activating(*this, declaration);
  const Session::Expanding expanding(session_, callee.text(), node.span());
  const Value value = evaluate(parts.expression, inside);
  if (!parts.expression) return {};
  const Need need{.subject = callee.text(), .function = {}, .node = parts.expression};
  if (!parts.type) return coerce_named(session_, value, need);
  const auto type = read_type(session_, parts.type);
  return type ? coerce(session_, value, *type, need) : Value{};
}

}  // namespace scenec::frontend
