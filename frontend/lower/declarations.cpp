// Declarations: what gives a name to a value, a function, a material, a proto or an included file.
#include <fmt/format.h>

#include <algorithm>

#include "base/text.hpp"
#include "frontend/frontend_cache.hpp"
#include "frontend/lower/lowering_access.hpp"
#include "frontend/lower/modules.hpp"

namespace scenec::frontend {

using grammar::NodeRef;
using grammar::SyntaxKind;

void Lowering::declare(Scope& scope, NodeRef name, BindingKind kind, Value value, NodeRef node) {
  const std::string_view word = name.text();
  if (const Binding* first = scope.find_here(word)) {
    session_.error(Diagnostic(DiagnosticKind::duplicate_name, name.span(),
                              fmt::format("`{}` is declared twice", printable(word)))
                       .note("first declared here", first->span));
    return;
  }
  evaluator_.lint_hiding(name, scope);
  // Of the others nothing is looked up again, so that their tree may go (part_reader.hpp).
  const bool looked_up =
      kind == BindingKind::function || kind == BindingKind::macro || kind == BindingKind::param;
  Binding binding{.name = word,
                  .span = name.span(),
                  .kind = kind,
                  .value = std::move(value),
                  .node = looked_up ? node : NodeRef{}};
  binding.lint_unused = !session_.is_allowed(DiagnosticKind::unused_declaration);
  scope.add(std::move(binding));
}

void Lowering::close(Scope& scope) {
  if (session_.running()) return;
  for (const Binding& binding : scope.bindings()) {
    if (binding.used || !binding.lint_unused) continue;
    unused_.emplace_back(
        DiagnosticKind::unused_declaration, binding.span,
        fmt::format("the {} `{}` is never used", text_of(binding.kind), printable(binding.name)));
  }
}

void Lowering::declare_let(NodeRef node, Scope& scope) {
  const ast::Item parts = ast::item_of(node);
  const Value found = evaluator_.evaluate(parts.expression, scope);
  if (!parts.name) return;
  Value value;
  if (parts.expression) {
    const Need need{.subject = parts.name.text(), .function = {}, .node = parts.expression};
    const auto type = parts.type ? read_type(session_, parts.type) : std::nullopt;
    if (type) {
      value = coerce(session_, found, *type, need);
    } else if (!parts.type) {
      value = coerce_named(session_, found, need);
    }
  }
  value.literal_zero = false;
  declare(scope, parts.name, BindingKind::let, std::move(value), node);
}

// ---- parameters

std::optional<Value> Lowering::param_setting(std::string_view name, const TypeRef& type) {
  const auto& settings = session_.options.params;
  const auto setting = std::find_if(settings.rbegin(), settings.rend(),
                                    [&](const ParamSetting& s) { return s.name == name; });
  if (setting == settings.rend()) return std::nullopt;
  const bool of_strings = type.type == Type::string;
  if (of_strings && type.list_depth == 0 && setting->is_text)
    return make_string(setting->value, main_file_);
  const bool quoted = of_strings && !setting->quoted.empty();
  const NodeRef expression =
      modules_->parse_setting(*setting, quoted ? setting->quoted : setting->value);
  if (!expression) return Value{};
  Scope nothing;
  const Need need{.subject = name, .function = {}, .node = expression};
  return coerce(session_, evaluator_.evaluate(expression, nothing), type, need);
}

namespace {

// What a page with sliders is told of a param.
std::optional<ParamInfo> param_info(NodeRef node, const TypeRef& type, const Value& value,
                                    Scope& scope, Session& session, Evaluator& evaluator) {
  const ast::Item parts = ast::item_of(node);
  if (!parts.expression || value.poisoned() || !value.known) return std::nullopt;
  using Kind = ParamInfo::Kind;
  ParamInfo info{.name = std::string(parts.name.text()),
                 .type = text_of(type),
                 .documentation = node.tree().documentation_of(node),
                 .text = std::string(parts.expression.text()),
                 .span = parts.expression.span()};
  if (type.list_depth == 0 && (value.is_number() || value.is(Type::boolean))) {
    info.kind = value.is(Type::number)    ? Kind::number
                : value.is(Type::integer) ? Kind::integer
                                          : Kind::boolean;
    info.dimension = value.dimension;
    info.value[0] = value.is(Type::boolean) ? (value.boolean() ? 1 : 0) : value.real();
  } else if (type.list_depth == 0 && value.is(Type::color)) {
    info.kind = Kind::color;
    info.value = value.n;
  } else if (type.list_depth == 0 && value.is(Type::string)) {
    info.kind = Kind::string;
    info.string_value = value.text();
  }
  const auto end_of = [&](NodeRef end) -> std::optional<double> {
    if (!end) return std::nullopt;
    const Value found = evaluator.evaluate(end, scope);
    return found.is_number() && found.known ? std::optional(found.real()) : std::nullopt;
  };
  if (parts.range) {
    const ast::Range range = ast::range_of(parts.range);
    info.low = end_of(range.low);
    info.high = end_of(range.high);
  }
  const auto& settings = session.options.params;
  info.is_set = std::any_of(settings.begin(), settings.end(),
                            [&](const ParamSetting& s) { return s.name == info.name; });
  return info;
}

}  // namespace

void Lowering::declare_param(NodeRef node, Scope& scope) {
  if (scope.parent() != nullptr) return misplaced(node, "inside a block");
  const ast::Item parts = ast::item_of(node);
  if (!parts.name) return;
  const auto type = read_type(session_, parts.type);
  Value value = evaluator_.evaluate(parts.expression, scope);
  if (parts.expression && type) {
    value = coerce(session_, value, *type,
                   {.subject = parts.name.text(), .function = {}, .node = parts.expression});
    value =
        evaluator_.in_range(value, parts.range, scope, parts.name.text(), parts.expression.span());
  }
  const bool settable = main_file_ == node.span().file && !session_.checking_only();
  const Value written = value;
  if (type && settable) {
    if (auto now = clock_setting(node, scope)) {
      value = *std::move(now);
    } else if (auto given = param_setting(parts.name.text(), *type)) {
      const NodeRef setting = modules_->setting_expression(parts.name.text());
      value = evaluator_.in_range(*given, parts.range, scope, parts.name.text(),
                                  setting ? setting.span() : parts.name.span());
    }
    // One that was refused is shown as it is written: another value may mend it.
    if (FrontendCache* const kept = session_.options.cache) {
      auto info =
          param_info(node, *type, value.poisoned() ? written : value, scope, session_, evaluator_);
      if (info) kept->note_param(*std::move(info));
    }
  }
  declare(scope, parts.name, BindingKind::param, std::move(value), node);
}

void Lowering::report_unknown_settings(Scope& scope) {
  std::vector<std::string_view> names;
  for (const Binding& binding : scope.bindings()) {
    if (binding.kind == BindingKind::param) names.push_back(binding.name);
  }
  for (const ParamSetting& setting : session_.options.params) {
    if (std::find(names.begin(), names.end(), setting.name) != names.end()) continue;
    session_.report(
        unknown_word(DiagnosticKind::unknown_param, setting.span,
                     fmt::format("the scene has no param `{}`", printable(setting.name)),
                     setting.name, names, "params"));
  }
}

// ---- functions, macros, protos, included files

void Lowering::declare_function(NodeRef node, Scope& scope, BindingKind kind) {
  const ast::Item parts = ast::item_of(node);
  if (!parts.name) return;
  declare(scope, parts.name, kind, {}, node);
  if (session_.running()) return;
  if (kind == BindingKind::function) {
    Value result = evaluator_.check_function(node, scope);
    Binding* const binding = scope.find_here(parts.name.text());
    if (binding == nullptr || binding->node != node) return;  // declared twice
    binding->value = std::move(result);
    binding->checked = true;
    return;
  }
  if (!parts.block) return;
  evaluator_.check_defaults(parts.parameters, scope);
  const Session::CheckOnly check(session_);
  const Evaluator::Activating activating(evaluator_, node);
  Scope inside(&scope);
  evaluator_.bind_unknown_parameters(parts.parameters, inside);
  body(parts.block, inside, {});
}

void Lowering::declare_proto(NodeRef node, Scope& scope, const Surroundings& around) {
  const ast::Item parts = ast::item_of(node);
  if (!parts.name) return;
  if (around.in_proto) return misplaced(node, "in a proto");
  ir::Proto proto;
  if (parts.block) {
    Scope inside(&scope);
    proto_gaps_.begin();
    items(parts.block, inside,
          {.transform = {}, .material = {}, .items = &proto.items, .in_proto = true});
    close(inside);
  }
  Value value = make_unknown(Type::proto);
  if (!session_.checking_only()) {
    const ir::NameId name = session_.builder.add_name(parts.name.text());
    const ir::ProtoId id =
        session_.builder.add_proto(std::move(proto), {name, session_.add_origin(node.span())});
    proto_gaps_.finish(id);
    value = make_proto(id);
  }
  declare(scope, parts.name, BindingKind::proto, std::move(value), node);
}

void Lowering::include(NodeRef node, Scope& scope) {
  if (scope.parent() != nullptr) return misplaced(node, "inside a block");
  const NodeRef name = ast::item_of(node).name;
  const NodeRef path = node.find_child(SyntaxKind::string);
  if (!name || !path) return;
  auto declared = modules_->load(decoded_string(path.text()), path);
  declare(scope, name, BindingKind::name_space, {}, node);
  // A file that cannot be read declares nothing; the namespace is then poison to whoever uses it.
  scope.add_name_space(name.text(), std::move(declared));
}

}  // namespace scenec::frontend
