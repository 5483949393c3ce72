// Functions and macros of the author: parameters, ranges, recursion, checking where they are
// written.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/text.hpp"
#include "frontend/eval/arguments.hpp"
#include "frontend/eval/evaluate.hpp"

namespace scenec::frontend {

using grammar::NodeRef;
using grammar::SyntaxKind;

bool Evaluator::is_active(NodeRef declaration) const {
  return std::find(active_.begin(), active_.end(), declaration) != active_.end();
}

Value Evaluator::recursion(NodeRef call, std::string_view name, NodeRef declaration) {
  const NodeRef declared = ast::item_of(declaration).name;
  return session_.error(
      Diagnostic(DiagnosticKind::recursive_call, call.span(),
                 fmt::format("`{}` calls itself", printable(name)))
          .note("declared here", declared ? declared.span() : declaration.span()));
}

Value Evaluator::in_range(const Value& value, NodeRef range_node, Scope& scope,
                          std::string_view subject, Span span) {
  if (!range_node || value.poisoned()) return value;
  const ast::Range range = ast::range_of(range_node);
  if (!range.low || !range.high) return value;
  if (!value.is_number()) {
    return session_.error(
        DiagnosticKind::type_mismatch, range_node.span(),
        fmt::format("only numbers have a range; `{}` is {}", printable(subject), described(value)));
  }
  std::array<Value, 2> ends;
  for (std::size_t i = 0; i < 2; ++i) {
    const NodeRef node = i == 0 ? range.low : range.high;
    const Value end = evaluate(node, scope);
    ends[i] =
        value.is(Type::integer)
            ? coerce(session_, end, integer_type, {.subject = subject, .node = node})
            : coerce_quantity(session_, end, value.dimension, {.subject = subject, .node = node});
    if (ends[i].poisoned()) return {};
    if (!ends[i].known) return value;
  }
  if (!value.known) return value;
  const auto below = [](const Value& a, const Value& b) {
    return a.is(Type::integer) ? a.integer < b.integer : a.real() < b.real();
  };
  if (!below(value, ends[0]) && (range.closed ? !below(ends[1], value) : below(value, ends[1])))
    return value;
  return session_.error(Diagnostic(DiagnosticKind::out_of_range, span,
                                   fmt::format("`{}` is {}; needs {} {} {}", printable(subject),
                                               quantity_text(value.real(), value.dimension),
                                               quantity_text(ends[0].real(), value.dimension),
                                               range.closed ? ".." : "..<",
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
  Binding binding{.name = parameter.name.text(),
                  .span = parameter.name.span(),
                  .kind = BindingKind::parameter,
                  .value = std::move(value),
                  .node = {}};
  binding.lint_unused = false;
  return binding;
}

}  // namespace

bool Evaluator::bind_arguments(NodeRef parameter_list, NodeRef arguments, NodeRef call,
                               std::string_view callee, Scope& caller, Scope& into) {
  if (!session_.spend(steps_per_call, call.span())) return false;
  const std::vector<ast::Item> parameters = parameters_of(parameter_list);
  for (const ast::Item& parameter : parameters) {
    if (!parameter.name) return false;
  }
  const auto given = ast::arguments_of(arguments);
  ArgumentPlaces places;
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
      report_missing_argument(session_, call, callee, parameter.name.text());
      sound = false;
      continue;
    }
    const auto type = read_type(session_, parameter.type);
    const Need need{.subject = parameter.name.text(), .function = callee, .node = expression};
    Value value = evaluate(expression, given_here ? caller : into);
    value = type ? coerce(session_, value, *type, need) : Value{};
    value = in_range(value, parameter.range, into, parameter.name.text(), expression.span());
    sound = sound && !value.poisoned();
    if (into.find_here(parameter.name.text()) == nullptr)
      into.add(parameter_binding(parameter, std::move(value)));
  }
  return sound;
}

void Evaluator::bind_unknown_parameters(NodeRef parameter_list, Scope& into) {
  for (const ast::Item& parameter : parameters_of(parameter_list)) {
    if (!parameter.name) continue;
    const auto type = read_type(session_, parameter.type);
    Value value = type ? unknown_of(*type) : Value{};
    if (parameter.expression) {
      const Need need{
          .subject = parameter.name.text(), .function = {}, .node = parameter.expression};
      const Value given = evaluate(parameter.expression, into);
      if (type) static_cast<void>(coerce(session_, given, *type, need));
    }
    static_cast<void>(
        in_range(value, parameter.range, into, parameter.name.text(), parameter.name.span()));
    if (const Binding* before = into.find_here(parameter.name.text())) {
      session_.error(
          Diagnostic(DiagnosticKind::duplicate_name, parameter.name.span(),
                     fmt::format("`{}` is declared twice", printable(parameter.name.text())))
              .note("first declared here", before->span));
      continue;
    }
    lint_hiding(parameter.name, into);
    into.add(parameter_binding(parameter, std::move(value)));
  }
}

void Evaluator::check_defaults(NodeRef parameter_list, Scope& scope) {
  if (session_.checking_only()) return;  // a default may depend on what is not known here
  Scope inside(&scope);
  for (const ast::Item& parameter : parameters_of(parameter_list)) {
    if (!parameter.name || inside.find_here(parameter.name.text()) != nullptr) continue;
    const auto type = read_type(session_, parameter.type);
    if (type && parameter.expression && parameter.range) {
      const Need need{
          .subject = parameter.name.text(), .function = {}, .node = parameter.expression};
      const Value value = coerce(session_, evaluate(parameter.expression, inside), *type, need);
      static_cast<void>(in_range(value, parameter.range, inside, parameter.name.text(),
                                 parameter.expression.span()));
    }
    inside.add(parameter_binding(parameter, type ? unknown_of(*type) : Value{}));
  }
}

Value Evaluator::check_function(NodeRef function, Scope& scope) {
  check_defaults(ast::item_of(function).parameters, scope);
  const Session::CheckOnly check(session_);
  const Activating activating(*this, function);
  const ast::Item parts = ast::item_of(function);
  Scope inside(&scope);
  bind_unknown_parameters(parts.parameters, inside);
  const auto type = parts.type ? read_type(session_, parts.type) : std::nullopt;
  const Value value = evaluate(parts.expression, inside);
  if (!parts.expression || !parts.name) return {};
  const Need need{.subject = parts.name.text(), .function = {}, .node = parts.expression};
  return type_of(type ? coerce(session_, value, *type, need) : coerce_named(session_, value, need));
}

Value Evaluator::call_binding(NodeRef node, NodeRef callee, Scope::Found found, Scope& scope) {
  const NodeRef declaration = found.binding->node;
  if (found.binding->kind != BindingKind::function) {
    const bool macro = found.binding->kind == BindingKind::macro;
    return session_.error(
        Diagnostic(DiagnosticKind::unknown_function, callee.span(),
                   fmt::format("`{}` is a {}, not a function", printable(callee.text()),
                               text_of(found.binding->kind)))
            .note(macro ? "macros are called as items, outside of expressions" : "declared here",
                  found.binding->span));
  }
  if (is_active(declaration)) return recursion(node, callee.text(), declaration);
  const ast::Item parts = ast::item_of(declaration);
  Scope inside(found.scope);
  if (!bind_arguments(parts.parameters, node.find_child(SyntaxKind::arguments), node, callee.text(),
                      scope, inside))
    return {};
  // Of a checked body the type of the result is known; going through it again for every call would
  // take time that doubles with each function that calls another one twice.
  if (session_.checking_only() && found.binding->checked) return found.binding->value;
  if (!may_go_deeper(node)) return {};
  const Activating activating(*this, declaration);
  const Session::Expanding expanding(session_, Session::Callee::function, callee.text(),
                                     node.span());
  const Value value = evaluate(parts.expression, inside);
  if (!parts.expression) return {};
  const Need need{.subject = callee.text(), .function = {}, .node = parts.expression};
  if (!parts.type) return coerce_named(session_, value, need);
  const auto type = read_type(session_, parts.type);
  return type ? coerce(session_, value, *type, need) : Value{};
}

}  // namespace scenec::frontend
