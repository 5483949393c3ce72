// Lists, comprehensions and the rounds of loops.
#include <fmt/format.h>

#include <array>

#include "base/text.hpp"
#include "frontend/eval/evaluate.hpp"
#include "frontend/eval/lists.hpp"

namespace scenec::frontend {

using grammar::NodeRef;
using grammar::SyntaxKind;

namespace {

constexpr std::int64_t largest_exact_integer = std::int64_t{1} << 53;

// Points are by far the most frequent lists: two or three numbers of one dimension need no list.
std::optional<Value> plain_vector(const std::array<Value, 3>& values, std::size_t count) {
  Value vector = make_vector(count, {}, values[0].dimension);
  vector.whole = true;
  for (std::size_t i = 0; i < count; ++i) {
    const Value& value = values[i];
    if (!value.is_number() || value.dimension != values[0].dimension || !is_named(value.dimension))
      return std::nullopt;
    if (value.is(Type::integer) &&
        (value.integer > largest_exact_integer || value.integer < -largest_exact_integer))
      return std::nullopt;
    vector.n[i] = value.real();
    vector.whole = vector.whole && value.is(Type::integer);
    vector.known = vector.known && value.known;
  }
  return vector;
}

// The first four expressions of a list, and how many there are of them.
std::size_t first_elements(NodeRef list, std::array<NodeRef, 4>& nodes) {
  std::size_t count = 0;
  for (NodeRef child : list.children()) {
    if (grammar::is_token(child.kind())) continue;
    nodes[count++] = child;
    if (count == nodes.size()) break;
  }
  return count;
}

Value too_long(Session& session, Span span) {
  return session.error(DiagnosticKind::list_too_long, span,
                       fmt::format("the list has more than {} elements", max_list_elements));
}

}  // namespace

Value Evaluator::list(NodeRef node, Scope& scope) {
  std::array<NodeRef, 4> first;
  const std::size_t first_count = first_elements(node, first);
  if (first_count == 2 || first_count == 3) {
    std::array<Value, 3> values;
    for (std::size_t i = 0; i < first_count; ++i) values[i] = evaluate(first[i], scope);
    if (auto vector = plain_vector(values, first_count)) return std::move(*vector);
    const auto count = static_cast<std::ptrdiff_t>(first_count);
    return checked_list(session_, ValueList(values.begin(), values.begin() + count), node,
                        std::span(first).first(first_count));
  }
  ValueList elements;
  std::vector<NodeRef> nodes;
  for (NodeRef child : node.children()) {
    if (grammar::is_token(child.kind())) continue;
    if (!session_.spend(steps_per_list_element, child.span())) return {};
    if (elements.size() == max_list_elements) return too_long(session_, node.span());
    elements.push_back(evaluate(child, scope));
    nodes.push_back(child);
  }
  return checked_list(session_, std::move(elements), node, nodes);
}

Value Evaluator::comprehension(NodeRef node, Scope& scope) {
  const ast::Loop parts = ast::loop_of(node);
  if (!parts.body) return {};
  ValueList elements;
  bool complete = true;
  loop(parts, scope, [&](Scope& round) {
    elements.push_back(evaluate(parts.body, round));
    complete = !elements.back().poisoned() && session_.spend(steps_per_list_element, node.span());
    if (complete && elements.size() > max_list_elements) {
      too_long(session_, node.span());
      complete = false;
    }
    return complete;
  });
  if (!complete) return {};
  if (!session_.checking_only()) {
    const bool unknown = !elements.empty() && !elements.front().known;
    if (!unknown) return checked_list(session_, std::move(elements), node, {});
  }
  return make_unknown_list(elements.empty() ? Value{} : type_of(elements.front()));
}

// The scope of the variables lives as long as the loop; each round gives them new values.
void Evaluator::declare_variables(const ast::Loop& parts, Scope& round) {
  for (NodeRef name : {parts.first, parts.second}) {
    if (!name) continue;
    if (round.find_here(name.text()) != nullptr) {
      session_.error(
          DiagnosticKind::duplicate_name, name.span(),
          fmt::format("`{}` names both the index and the element", printable(name.text())));
      continue;
    }
    Binding binding{.name = name.text(),
                    .span = name.span(),
                    .kind = BindingKind::loop_variable,
                    .value = {},
                    .node = {}};
    binding.lint_unused = false;
    lint_hiding(name, round);
    round.add(std::move(binding));
  }
}

bool Evaluator::run_round(const ast::Loop& parts, Scope& round, Value index, Value element,
                          const std::function<bool(Scope&)>& body) {
  if (!session_.spend(steps_per_scope, parts.first.span())) return false;
  auto& variables = round.bindings();
  if (variables.size() == 2) variables[0].value = std::move(index);
  variables.back().value = std::move(element);
  return body(round);
}

void Evaluator::loop(const ast::Loop& parts, Scope& scope,
                     const std::function<bool(Scope&)>& body) {
  if (!parts.first) return;  // a syntax error
  if (parts.range) {
    loop_over_range(parts, scope, body);
  } else {
    loop_over_list(parts, scope, body);
  }
}

void Evaluator::loop_over_range(const ast::Loop& parts, Scope& scope,
                                const std::function<bool(Scope&)>& body) {
  const ast::Range range = ast::range_of(parts.range);
  if (!range.low || !range.high) return;
  Scope variables(&scope);
  const Value low = coerce(session_, evaluate(range.low, scope), integer_type,
                           {.subject = "for", .node = range.low});
  const Value high = coerce(session_, evaluate(range.high, scope), integer_type,
                            {.subject = "for", .node = range.high});
  declare_variables(parts, variables);
  if (low.poisoned() || high.poisoned() || !low.known || !high.known) {
    const Session::CheckOnly check(session_);
    run_round(parts, variables, make_unknown(Type::integer),
              low.poisoned() || high.poisoned() ? Value{} : make_unknown(Type::integer), body);
    return;
  }
  std::int64_t index = 0;
  for (std::int64_t i = low.integer; range.closed ? i <= high.integer : i < high.integer;
       ++i, ++index) {
    if (!run_round(parts, variables, make_int(index), make_int(i), body)) return;
    if (i == high.integer) return;  // the largest integer has no successor
  }
}

void Evaluator::loop_over_list(const ast::Loop& parts, Scope& scope,
                               const std::function<bool(Scope&)>& body) {
  if (!parts.list) return;
  Scope variables(&scope);
  const Value list = accepted(session_, evaluate(parts.list, scope), Accept::list,
                              {.subject = "for", .node = parts.list});
  declare_variables(parts, variables);
  if (list.poisoned() || !list.known) {
    const Value element =
        is_listlike(list) && element_count(list) > 0 ? type_of(element_of(list, 0)) : Value{};
    const Session::CheckOnly check(session_);
    run_round(parts, variables, make_unknown(Type::integer), element, body);
    return;
  }
  const std::size_t count = element_count(list);
  for (std::size_t i = 0; i < count; ++i) {
    if (!run_round(parts, variables, make_int(static_cast<std::int64_t>(i)), element_of(list, i),
                   body))
      return;
  }
}

}  // namespace scenec::frontend
