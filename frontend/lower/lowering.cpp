#include "frontend/lower/lowering.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.hpp"
#include "frontend/check/check_scene.hpp"
#include "frontend/lower/lowering_access.hpp"
#include "frontend/lower/modules.hpp"

namespace scenec::frontend {

using grammar::SyntaxKind;

namespace {

bool is_declaration(SyntaxKind kind) {
  switch (kind) {
    case SyntaxKind::include:
    case SyntaxKind::param:
    case SyntaxKind::let:
    case SyntaxKind::fn:
    case SyntaxKind::macro:
    case SyntaxKind::proto:
    case SyntaxKind::material:
      return true;
    default:
      return false;
  }
}

bool is_shape_kind(std::string_view name) {
  return KindDispatch<ir::ShapeTypes>::call(name, []<class>() {});
}

bool is_item(SyntaxKind kind) {
  return kind >= SyntaxKind::include && kind <= SyntaxKind::field;
}

// `@allow(no_light)` is written with the underscores of an identifier.
bool is_called(const DiagnosticKindInfo& info, std::string_view word) {
  if (info.code == word) return true;
  return std::equal(info.name.begin(), info.name.end(), word.begin(), word.end(),
                    [](char a, char b) { return a == b || (a == '-' && b == '_'); });
}

}  // namespace

Lowering::Lowering(Session& session)
    : session_(session),
      evaluator_(session),
      item_bound_(session, evaluator_),
      proto_gaps_(session.builder),
      modules_(std::make_unique<Modules>(*this, session)) {}
Lowering::~Lowering() = default;

void report_unknown_kind(Session& session, grammar::NodeRef kind, std::string_view family,
                         std::span<const std::string_view> legal) {
  session.report(unknown_word(DiagnosticKind::unknown_kind, kind.span(),
                              fmt::format("there is no {} `{}`", family, printable(kind.text())),
                              kind.text(), legal, fmt::format("kinds of {}", family)));
}

bool Lowering::take_notes(const grammar::SyntaxTree& tree) {
  check_doc_comments(session_, tree);
  bool is_referred_to = false;
  for (NodeRef child : tree.root().children()) {
    switch (child.kind()) {
      case SyntaxKind::edition:
        edition_ = child.span();
        break;
      case SyntaxKind::fn:
      case SyntaxKind::macro:
      case SyntaxKind::param:
      case SyntaxKind::render:
        is_referred_to = true;
        [[fallthrough]];
      default:
        if (!grammar::is_token(child.kind())) notes_.is_empty = false;
    }
  }
  return is_referred_to;
}

void Lowering::lower_scene(TreeSource& trees, FileId file, FileIdentity identity) {
  main_file_ = file;
  modules_->open_scene(file, identity);
  Scope scope;
  while (const grammar::SyntaxTree* tree = trees.next()) {
    if (take_notes(*tree)) trees.keep();
    items(tree->root(), scope, {});
  }
  report_unknown_settings(scope);
  report_missing_clock(scope);
  const bool scene = notes_.first_placed.valid() || notes_.first_camera.valid();
  if (scene) close(scope);
  if (session_.sink.has_errors()) return;  // a name misspelt elsewhere is not unused
  for (Diagnostic& lint : unused_) session_.report(std::move(lint));
}

void Lowering::declare_all(const grammar::SyntaxTree& tree, Scope& scope) {
  items(tree.root(), scope, {}, Pass::declarations);
  const Session::CheckOnly check(session_);
  items(tree.root(), scope, {}, Pass::placements);
}

void Lowering::items(NodeRef block, Scope& scope, const Surroundings& around, Pass pass) {
  if (!session_.deep_enough(0, block.span())) return;
  for (NodeRef child : block.children()) {
    if (!is_item(child.kind())) continue;
    const bool declaration = is_declaration(child.kind());
    const bool placement =
        !declaration && !(pass == Pass::placements && child.is(SyntaxKind::field));
    if ((pass == Pass::declarations && !declaration) || (pass == Pass::placements && !placement))
      continue;
    item(child, scope, around);
    if (session_.out_of_steps() || session_.item_count() > session_.options.limits.items) return;
  }
}

void Lowering::item(NodeRef node, Scope& scope, const Surroundings& around) {
  // Annotations come first; a look at the first child tells the many items without.
  const auto children = node.children();
  if (children.empty() || !(*children.begin()).is(SyntaxKind::annotation))
    return item_unannotated(node, scope, around);
  const std::vector<DiagnosticKind> allowed = allowed_lints(node);
  const Session::Allowing allowing(session_, allowed);
  item_unannotated(node, scope, around);
}

void Lowering::item_unannotated(NodeRef node, Scope& scope, const Surroundings& around) {
  switch (node.kind()) {
    case SyntaxKind::shape:
      return shape(node, scope, around);
    case SyntaxKind::instance:
      return instance(node, scope, around);
    case SyntaxKind::group:
      return group(node, scope, around);
    case SyntaxKind::light:
      return light(node, scope, around);
    case SyntaxKind::camera:
      return camera(node, scope, around);
    case SyntaxKind::render:
      if (around.in_proto) return misplaced(node, "in a proto");
      return render_block(node, scope);
    case SyntaxKind::let:
      return declare_let(node, scope);
    case SyntaxKind::param:
      return declare_param(node, scope);
    case SyntaxKind::fn:
      return declare_function(node, scope, BindingKind::function);
    case SyntaxKind::macro:
      return declare_function(node, scope, BindingKind::macro);
    case SyntaxKind::proto:
      return declare_proto(node, scope, around);
    case SyntaxKind::material:
      return declare_material(node, scope);
    case SyntaxKind::include:
      return include(node, scope);
    case SyntaxKind::for_item:
      return for_loop(node, scope, around);
    case SyntaxKind::if_item:
      return if_chain(node, scope, around);
    case SyntaxKind::assert_item:
      return assertion(node, scope);
    case SyntaxKind::call_item:
      return macro_call(node, scope, around);
    case SyntaxKind::field:
      return misplaced(node, "here: it belongs into the block of an item");
    default:
      return;
  }
}

void Lowering::misplaced(NodeRef node, std::string_view where) {
  session_.error(DiagnosticKind::misplaced_item, node.span(),
                 fmt::format("{} cannot stand {}", ast::item_words(node.kind()), where));
}

// ---- annotations

std::vector<DiagnosticKind> Lowering::allowed_lints(NodeRef node) {
  std::vector<DiagnosticKind> allowed;
  for (NodeRef child : node.children()) {
    if (child.is(SyntaxKind::annotation)) check_annotation(child, node, allowed);
  }
  return allowed;
}

void Lowering::check_annotation(NodeRef annotation, NodeRef node,
                                std::vector<DiagnosticKind>& allowed) {
  constexpr std::array<std::string_view, 2> known{"allow", "clock"};
  const NodeRef name = annotation.find_child(SyntaxKind::name);
  if (!name) return;
  const auto arguments = ast::arguments_of(annotation.find_child(SyntaxKind::arguments));
  const auto wrong = [&](Span span, std::string text) {
    session_.error(DiagnosticKind::annotation_argument, span, std::move(text));
  };
  if (name.text() == known[1]) {
    const NodeRef type = ast::item_of(node).type;
    const bool fits = node.is(SyntaxKind::param) && type && type.text() == "time" &&
                      ast::item_of(node).range && arguments.empty();
    if (!fits)
      wrong(annotation.span(),
            "`@clock` stands before a `param` of type `time` with a range, and takes no arguments");
    return;
  }
  if (name.text() != known[0]) {
    session_.report(
        unknown_word(DiagnosticKind::unknown_annotation, name.span(),
                     fmt::format("there is no annotation `@{}`", printable(name.text())),
                     name.text(), known, "annotations"));
    return;
  }
  if (arguments.empty()) wrong(annotation.span(), "`@allow` needs the name or code of a lint");
  for (const ast::Argument& argument : arguments) {
    if (!argument.expression) continue;
    const std::string_view word = argument.expression.text();
    const auto kinds = all_diagnostic_kinds();
    const auto found =
        std::find_if(kinds.begin(), kinds.end(),
                     [&](const DiagnosticKindInfo& info) { return is_called(info, word); });
    if (found != kinds.end() && found->severity == Severity::warning) {
      allowed.push_back(found->kind);
    } else if (found != kinds.end()) {
      wrong(argument.expression.span(),
            fmt::format("`{}` is an error and cannot be allowed", printable(word)));
    } else {
      std::vector<std::string> names;
      for (const DiagnosticKindInfo& info : kinds) {
        if (info.severity != Severity::warning) continue;
        names.emplace_back(info.name);
        std::replace(names.back().begin(), names.back().end(), '-', '_');
      }
      const std::vector<std::string_view> legal(names.begin(), names.end());
      session_.report(unknown_word(DiagnosticKind::annotation_argument, argument.expression.span(),
                                   fmt::format("there is no lint `{}`", printable(word)), word,
                                   legal, "lints"));
    }
  }
}

// ---- blocks of keys

void Lowering::collect(NodeRef block, Scope& scope, Fields& fields) {
  for (NodeRef child : block.children()) {
    switch (child.kind()) {
      case SyntaxKind::field: {
        const ast::Field parts = ast::field_of(child);
        if (parts.name)
          fields.add(session_, {.name = parts.name.text(),
                                .name_node = parts.name,
                                .expression = parts.expression,
                                .block = {}});
        break;
      }
      case SyntaxKind::shape: {  // `stop { ... }`
        const ast::Item parts = ast::item_of(child);
        if (parts.kind && parts.block && !parts.name && !is_shape_kind(parts.kind.text())) {
          fields.add(session_, {.name = parts.kind.text(),
                                .name_node = parts.kind,
                                .expression = {},
                                .block = parts.block});
        } else {
          misplaced(child, "in a block of keys");
        }
        break;
      }
      case SyntaxKind::let:
      case SyntaxKind::assert_item:
        item(child, scope, {});
        break;
      default:
        if (is_item(child.kind())) misplaced(child, "in a block of keys");
    }
  }
}

}  // namespace scenec::frontend
