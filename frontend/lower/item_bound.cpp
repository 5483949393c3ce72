#include "frontend/lower/item_bound.hpp"

#include <algorithm>
#include <limits>

namespace scenec::frontend {

using grammar::NodeRef;
using grammar::SyntaxKind;

namespace {

// Both only make the bound smaller than it could be.
constexpr int deepest = 512;
constexpr std::uint64_t most_visits = 100'000;

constexpr std::uint64_t saturated = std::numeric_limits<std::uint64_t>::max();
std::uint64_t plus(std::uint64_t a, std::uint64_t b) {
  return a > saturated - b ? saturated : a + b;
}
std::uint64_t times(std::uint64_t a, std::uint64_t b) {
  return b != 0 && a > saturated / b ? saturated : a * b;
}
Amount sum(const Amount& a, const Amount& b) {
  return {plus(a.items, b.items), plus(a.steps, b.steps)};
}

bool is_cheap(NodeRef expression) {
  switch (expression.kind()) {
    case SyntaxKind::number_literal:
    case SyntaxKind::bool_literal:
    case SyntaxKind::name_ref:
      return true;
    case SyntaxKind::paren:
    case SyntaxKind::unary:
    case SyntaxKind::multiply_chain:
    case SyntaxKind::add_chain:
    case SyntaxKind::comparison:
    case SyntaxKind::and_chain:
    case SyntaxKind::or_chain:
      break;
    default:
      return false;
  }
  const auto children = expression.children();
  return std::all_of(children.begin(), children.end(), [](NodeRef child) {
    return grammar::is_token(child.kind()) || is_cheap(child);
  });
}

// A name whose value is not known here; it hides what has the name further out.
void hide(Scope& scope, NodeRef name, BindingKind kind, NodeRef declaration) {
  if (!name || scope.find_here(name.text()) != nullptr) return;
  scope.add(
      {.name = name.text(), .span = name.span(), .kind = kind, .value = {}, .node = declaration});
}

std::size_t written_elements(NodeRef list) {
  std::size_t count = 0;
  for (NodeRef child : list.children()) count += grammar::is_token(child.kind()) ? 0u : 1u;
  return count;
}

}  // namespace

Value ItemBound::constant(NodeRef expression, Scope& scope) {
  if (!expression || !is_cheap(expression)) return {};
  const Session::Muted muted(session_);  // mistakes are reported when it is run
  const Value value = evaluator_.evaluate(expression, scope);
  return value.known ? value : Value{};
}

std::uint64_t ItemBound::rounds(const ast::Loop& parts, Scope& scope) {
  if (parts.list) {
    if (parts.list.is(SyntaxKind::list)) return written_elements(parts.list);
    const Value list = constant(parts.list, scope);
    return is_listlike(list) ? element_count(list) : 0;
  }
  if (!parts.range) return 0;
  const ast::Range range = ast::range_of(parts.range);
  const Value low = constant(range.low, scope), high = constant(range.high, scope);
  if (!low.is(Type::integer) || !high.is(Type::integer) || high.integer < low.integer) return 0;
  const std::uint64_t span =
      static_cast<std::uint64_t>(high.integer) - static_cast<std::uint64_t>(low.integer);
  return range.closed ? plus(span, 1) : span;
}

Amount ItemBound::block(NodeRef node, Scope& scope, int depth) {
  Amount total;
  if (!node || depth > deepest || ++visits_ > most_visits) return total;
  Scope inside(&scope);
  for (NodeRef child : node.children()) {
    if (grammar::is_token(child.kind())) continue;
    total = sum(total, item(child, inside, depth + 1));
    if (child.is(SyntaxKind::macro)) {
      hide(inside, ast::item_of(child).name, BindingKind::macro, child);
    } else if (child.is(SyntaxKind::let) || child.is(SyntaxKind::fn)) {
      hide(inside, ast::item_of(child).name, BindingKind::let, child);
    }
  }
  return total;
}

Amount ItemBound::item(NodeRef node, Scope& scope, int depth) {
  switch (node.kind()) {
    case SyntaxKind::shape:
    case SyntaxKind::instance:
    case SyntaxKind::light:
      return {1, 0};
    case SyntaxKind::group:
    case SyntaxKind::proto:
      return block(ast::item_of(node).block, scope, depth);
    case SyntaxKind::for_item:
      return loop(node, scope, depth);
    case SyntaxKind::if_item:
      return branches(node, scope, depth);
    case SyntaxKind::call_item:
      return call(node, scope, depth);
    default:
      return {};
  }
}

Amount ItemBound::loop(NodeRef node, Scope& scope, int depth) {
  const ast::Loop parts = ast::loop_of(node);
  if (!parts.first || !parts.body) return {};
  const std::uint64_t count = rounds(parts, scope);
  if (count == 0) return {};
  Scope variables(&scope);
  hide(variables, parts.first, BindingKind::loop_variable, {});
  hide(variables, parts.second, BindingKind::loop_variable, {});
  Amount once = block(parts.body, variables, depth);
  once.steps = plus(once.steps, steps_per_scope);
  return {times(count, once.items), times(count, once.steps)};
}

// The branch taken, or the least any branch does; one without `else` may do nothing.
Amount ItemBound::branches(NodeRef node, Scope& scope, int depth) {
  std::optional<Amount> least;
  const auto consider = [&](const Amount& amount) {
    least = least
                ? Amount{std::min(least->items, amount.items), std::min(least->steps, amount.steps)}
                : amount;
  };
  for (NodeRef at = node; at;) {
    NodeRef next;
    std::vector<NodeRef> blocks;
    for (NodeRef child : at.children()) {
      if (child.is(SyntaxKind::block)) blocks.push_back(child);
      if (child.is(SyntaxKind::if_item)) next = child;
    }
    const Value taken = constant(ast::expression_of(at), scope);
    const bool known = taken.is(Type::boolean);
    if (!blocks.empty() && (!known || taken.boolean())) consider(block(blocks[0], scope, depth));
    if (known && taken.boolean()) return *least;
    if (blocks.size() > 1) {
      consider(block(blocks[1], scope, depth));
      return *least;
    }
    at = next;
  }
  return {};
}

Scope::Found ItemBound::macro_of(NodeRef node, Scope& scope) {
  const NodeRef qualified = node.find_child(SyntaxKind::qualified_name);
  if (!qualified) return {};
  std::vector<NodeRef> names;
  for (NodeRef child : qualified.children()) {
    if (child.is(SyntaxKind::name)) names.push_back(child);
  }
  Scope::Found found;
  if (names.size() == 1) found = scope.find(names[0].text(), names[0].span());
  if (names.size() == 2) {
    const auto space = evaluator_.name_space(names[0], scope);
    if (space && *space != nullptr) found = {(*space)->find_here(names[1].text()), *space};
  }
  const bool is_macro = found.binding != nullptr && found.binding->kind == BindingKind::macro;
  return is_macro ? found : Scope::Found{};
}

Amount ItemBound::call(NodeRef node, Scope& scope, int depth) {
  if (visits_ > most_visits) return {};
  const Scope::Found found = macro_of(node, scope);
  if (found.binding == nullptr) return {};
  const NodeRef declaration = found.binding->node;
  const ast::Item parts = ast::item_of(declaration);
  if (!parts.block || !parts.parameters) return {};
  std::vector<ast::Item> parameters;
  for (NodeRef child : parts.parameters.children()) {
    if (child.is(SyntaxKind::parameter)) parameters.push_back(ast::item_of(child));
  }
  MacroKey key{&declaration.tree(), declaration.index(), {}};
  auto& constants = std::get<2>(key);
  constants.resize(parameters.size());
  std::size_t position = 0;
  for (const ast::Argument& argument : ast::arguments_of(node.find_child(SyntaxKind::arguments))) {
    std::size_t place = argument.name ? parameters.size() : position++;
    for (std::size_t i = 0; argument.name && i < parameters.size(); ++i) {
      if (parameters[i].name && parameters[i].name.text() == argument.name.text()) place = i;
    }
    if (place >= parameters.size()) return {};  // a mistake, reported when it is run
    const Value value = constant(argument.expression, scope);
    if (value.is(Type::integer)) constants[place] = value.integer;
  }
  const auto [entry, added] = macros_.try_emplace(std::move(key));
  if (!added) return entry->second;
  Scope inside(found.scope);
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    hide(inside, parameters[i].name, BindingKind::parameter, {});
    const auto& value = std::get<2>(entry->first)[i];
    if (value && parameters[i].name) inside.bindings().back().value = make_int(*value);
  }
  Amount amount = block(parts.block, inside, depth + 1);
  amount.steps = plus(amount.steps, steps_per_call);
  return entry->second = amount;
}

}  // namespace scenec::frontend
