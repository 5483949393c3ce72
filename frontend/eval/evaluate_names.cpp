// Names, members and indices: what stands behind a word, a dot or a bracket.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/text.hpp"
#include "frontend/eval/evaluate.hpp"
#include "ir/render_settings.hpp"

namespace scenec::frontend {

using grammar::NodeRef;
using grammar::SyntaxKind;

namespace {

// Searching all names for the nearest costs time; an author reads no more of them than this.
constexpr std::size_t max_searched_names = 200;

bool declares(SyntaxKind kind) {
  switch (kind) {
    case SyntaxKind::let:
    case SyntaxKind::param:
    case SyntaxKind::fn:
    case SyntaxKind::macro:
    case SyntaxKind::proto:
    case SyntaxKind::material:
    case SyntaxKind::include:
      return true;
    default:
      return false;
  }
}

bool hides_built_in(std::string_view name) {
  constexpr auto filters = ir::EnumNames<ir::FilterKind>::names;  // of use in one place only
  if (std::find(filters.begin(), filters.end(), name) != filters.end()) return false;
  return find_constant(name).has_value() || find_builtin(name) != nullptr || name == "select";
}

}  // namespace

void Evaluator::lint_hiding(NodeRef name, Scope& scope) {
  if (session_.running()) return;  // said where it is written
  const std::string_view word = name.text();
  const Binding* const outer =
      scope.parent() != nullptr ? scope.parent()->find(word, name.span()).binding : nullptr;
  if (outer == nullptr && !hides_built_in(word)) return;
  Diagnostic diagnostic(
      DiagnosticKind::shadowed_name, name.span(),
      outer != nullptr
          ? fmt::format("`{}` hides an outer {}", printable(word), text_of(outer->kind))
          : fmt::format("`{}` hides a built-in name", printable(word)));
  if (outer != nullptr) diagnostic.notes.push_back({"the outer one is declared here", outer->span});
  session_.lint(std::move(diagnostic));
}

// A declaration of the name further down (or around the use): the file is searched only when
// something is wrong already.
std::optional<Span> Evaluator::declared_later(NodeRef name) const {
  const grammar::SyntaxTree& tree = name.tree();
  for (NodeRef item : tree.root().children()) {
    if (item.span().end < name.span().begin || !declares(item.kind())) continue;
    const NodeRef declared = ast::item_of(item).name;
    if (declared && declared.text() == name.text()) return declared.span();
  }
  return std::nullopt;
}

void Evaluator::unknown_name(NodeRef name, Scope& scope) {
  const std::string_view word = name.text();
  if (find_builtin(word) != nullptr || word == "select") {
    session_.error(Diagnostic(DiagnosticKind::name_without_value, name.span(),
                              fmt::format("`{}` is a function, not a value", printable(word)))
                       .hint(fmt::format("call it: `{}(...)`", printable(word))));
    return;
  }
  if (++unknown_names_ > max_searched_names) {
    session_.error(DiagnosticKind::unknown_name, name.span(),
                   fmt::format("there is no `{}` here", printable(word)));
    return;
  }
  if (const auto later = declared_later(name)) {
    const bool inside = later->begin < name.span().begin;
    session_.error(
        Diagnostic(DiagnosticKind::used_before_declaration, name.span(),
                   inside ? fmt::format("`{}` is used in its own declaration", printable(word))
                          : fmt::format("`{}` is used before it is declared", printable(word)))
            .note("declared here", *later));
    return;
  }
  std::vector<std::string_view> names = scope.visible_names(name.span());
  names.insert(names.end(), constant_names().begin(), constant_names().end());
  session_.report(unknown_word(DiagnosticKind::unknown_name, name.span(),
                               fmt::format("there is no `{}` here", printable(word)), word, names,
                               "names in scope"));
}

Scope::Found Evaluator::resolve(NodeRef name, Scope& scope) {
  const Scope::Found found = scope.find(name.text(), name.span());
  if (found.binding == nullptr) {
    unknown_name(name, scope);
  } else {
    found.binding->used = true;
  }
  return found;
}

std::optional<Scope*> Evaluator::name_space(NodeRef name, Scope& scope) {
  const Scope::Found found = scope.find(name.text(), name.span());
  if (found.binding == nullptr || found.binding->kind != BindingKind::name_space)
    return std::nullopt;
  found.binding->used = true;
  return found.scope->name_space(found.binding->name).get();
}

Scope::Found Evaluator::resolve_in(Scope& space, NodeRef space_name, NodeRef name) {
  Binding* const binding = space.find_here(name.text());
  if (binding != nullptr && binding->kind != BindingKind::name_space) return {binding, &space};
  std::vector<std::string_view> names;
  for (const Binding& candidate : space.bindings()) {
    if (candidate.kind != BindingKind::name_space) names.push_back(candidate.name);
  }
  session_.report(unknown_word(
      DiagnosticKind::unknown_namespace_member, name.span(),
      fmt::format("`{}` declares no `{}`", printable(space_name.text()), printable(name.text())),
      name.text(), names, "it declares"));
  return {};
}

Value Evaluator::binding_value(Binding& binding, NodeRef node) {
  switch (binding.kind) {
    case BindingKind::function:
    case BindingKind::macro:
    case BindingKind::name_space: {
      Diagnostic diagnostic(
          DiagnosticKind::name_without_value, node.span(),
          fmt::format("`{}` is a {}, not a value", printable(binding.name), text_of(binding.kind)));
      if (binding.kind == BindingKind::function)
        diagnostic.hints.push_back(fmt::format("call it: `{}(...)`", printable(binding.name)));
      if (binding.kind == BindingKind::name_space)
        diagnostic.hints.push_back(
            fmt::format("its declarations are `{}.name`", printable(binding.name)));
      diagnostic.notes.push_back({"declared here", binding.span});
      return session_.error(std::move(diagnostic));
    }
    default:
      return session_.checking_only() ? type_of(binding.value) : binding.value;
  }
}

Value Evaluator::name_value(NodeRef node, Scope& scope) {
  const Scope::Found found = scope.find(node.text(), node.span());
  if (found.binding == nullptr) {
    if (auto constant = find_constant(node.text()))
      return session_.checking_only() ? type_of(*constant) : std::move(*constant);
    unknown_name(node, scope);
    return {};
  }
  found.binding->used = true;
  return binding_value(*found.binding, node);
}

// Members, indices and calls may follow each other without end, so they are unwound, not recursed.
Value Evaluator::postfix(NodeRef node, Scope& scope) {
  InlineList<NodeRef, 8> outer_first;
  NodeRef base = node;
  while (base &&
         (base.is(SyntaxKind::member) || base.is(SyntaxKind::index) || base.is(SyntaxKind::call))) {
    outer_first.push_back(base);
    base = ast::expression_of(base);
  }
  if (!base) return {};
  std::size_t left = outer_first.size();
  Value value;
  const NodeRef first = outer_first[left - 1];
  if (base.is(SyntaxKind::name_ref) && first.is(SyntaxKind::call)) {
    value = call(first, base, scope);
    --left;
  } else if (const auto space = base.is(SyntaxKind::name_ref) && first.is(SyntaxKind::member)
                                    ? name_space(base, scope)
                                    : std::nullopt) {
    const NodeRef name = first.find_child(SyntaxKind::name);
    if (!name || *space == nullptr) return {};
    const Scope::Found found = resolve_in(**space, base, name);
    if (found.binding == nullptr) return {};
    found.binding->used = true;
    --left;
    if (left > 0 && outer_first[left - 1].is(SyntaxKind::call)) {
      value = call_binding(outer_first[left - 1], name, found, scope);
      --left;
    } else {
      value = binding_value(*found.binding, first);
    }
  } else {
    value = evaluate(base, scope);
  }
  for (; left > 0 && !value.poisoned(); --left) {
    const NodeRef step = outer_first[left - 1];
    if (!session_.spend(1, step.span())) return {};
    if (step.is(SyntaxKind::member)) {
      value = member(value, step);
    } else if (step.is(SyntaxKind::index)) {
      value = index(value, step, scope);
    } else {
      return session_.error(DiagnosticKind::unknown_function, step.span(),
                            fmt::format("{} cannot be called", described(value)));
    }
  }
  return value;
}

namespace {

constexpr std::array<std::string_view, 3> vector_members{"x", "y", "z"};
constexpr std::array<std::string_view, 3> color_members{"r", "g", "b"};

std::span<const std::string_view> members_of(const Value& value) {
  if (value.is(Type::vec2)) return std::span(vector_members).first(2);
  if (value.is(Type::vec3)) return vector_members;
  if (value.is(Type::color)) return color_members;
  if (value.is(Type::texture)) return ir::EnumNames<ir::Channel>::names;
  return {};
}

}  // namespace

Value Evaluator::member(const Value& value, NodeRef node) {
  const NodeRef name = node.find_child(SyntaxKind::name);
  if (!name || may_be_vector(value)) return {};
  const auto members = members_of(value);
  const auto place = std::find(members.begin(), members.end(), name.text());
  if (place == members.end()) {
    session_.report(
        unknown_word(DiagnosticKind::unknown_member, name.span(),
                     fmt::format("{} has no member `{}`", described(value), printable(name.text())),
                     name.text(), members, "members"));
    return {};
  }
  const auto i = static_cast<std::size_t>(place - members.begin());
  if (value.is(Type::color)) {
    Value component = make_number(value.n[i]);
    component.known = value.known;
    return component;
  }
  if (!value.is(Type::texture)) return element_of(value, i);
  if (!value.known) {
    Value channel = make_unknown(Type::texture);
    channel.grey = true;
    return channel;
  }
  const ir::ChannelTexture channel{value.id<ir::TextureNode>(), static_cast<ir::Channel>(i)};
  return make_texture(session_.builder.add_texture({channel, true}), true);
}

Value Evaluator::index(const Value& value, NodeRef node, Scope& scope) {
  NodeRef place;
  for (NodeRef child : node.children()) {
    if (ast::is_expression(child.kind())) place = child;  // the last one is in the brackets
  }
  const Value at =
      coerce(session_, evaluate(place, scope), integer_type, {.subject = "[ ]", .node = place});
  if (at.poisoned()) return {};
  if (!is_listlike(value)) {
    const NodeRef list = ast::expression_of(node);
    return session_.error(DiagnosticKind::type_mismatch, list.span(),
                          fmt::format("`[ ]` needs a list; found {}", described(value)));
  }
  const std::size_t count = element_count(value);
  if (!value.known || !at.known) return count > 0 ? type_of(element_of(value, 0)) : Value{};
  if (at.integer < 0 || static_cast<std::uint64_t>(at.integer) >= count) {
    return session_.error(
        DiagnosticKind::index_out_of_range, place.span(),
        count == 0 ? fmt::format("the index is {}, the list is empty", at.integer)
                   : fmt::format("the index is {}; needs 0 to {}", at.integer, count - 1));
  }
  return element_of(value, static_cast<std::size_t>(at.integer));
}

}  // namespace scenec::frontend
