// Lights, cameras and the `render` block.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/text.hpp"
#include "frontend/check/check_shape.hpp"
#include "frontend/check/key_name.hpp"
#include "frontend/lower/lowering_access.hpp"

namespace scenec::frontend {

using grammar::SyntaxKind;

// ---- lights

template <class T>
void Lowering::read_light(const ast::Item& parts, NodeRef node, Scope& scope,
                          const Surroundings& around) {
  const Span head = parts.kind.span();
  T light{};
  const bool sound = read_block(
      parts.block, head, scope,
      [&](const BlockChecker& checker) { check_light(session_, light, checker, head); }, light);
  if (session_.checking_only()) return;
  notes_.light = true;
  if (!session_.count_item(head)) return;
  if (!notes_.first_placed.valid()) notes_.first_placed = head;
  ir::LightKind kind = std::move(light);
  if (!sound || !bake(session_, around.transform, kind, head)) return;
  const ir::NameId name = parts.name ? session_.builder.add_name(parts.name.text()) : ir::NameId{};
  static_cast<void>(
      session_.builder.add_light({std::move(kind)}, {name, session_.add_origin(node.span())}));
}

void Lowering::light(NodeRef node, Scope& scope, const Surroundings& around) {
  if (around.in_proto) {
    session_.error(DiagnosticKind::light_in_proto, node.span(), "a proto cannot hold a light");
    return;
  }
  const ast::Item parts = ast::item_of(node);
  if (!parts.kind || !parts.block) return;
  const bool known = KindDispatch<ir::LightKind>::call(
      parts.kind.text(), [&]<class T>() { read_light<T>(parts, node, scope, around); });
  if (known) return;
  notes_.light = true;
  if (!notes_.first_placed.valid()) notes_.first_placed = parts.kind.span();
  report_unknown_kind(session_, parts.kind, "light", KindDispatch<ir::LightKind>::names());
}

// ---- cameras

template <class T>
void Lowering::read_camera(const ast::Item& parts, NodeRef node, Scope& scope,
                           const Surroundings& around) {
  const Span head = parts.kind.span();
  T camera{};
  const bool sound = read_block(
      parts.block, head, scope,
      [&](const BlockChecker& checker) { check_camera(session_, camera, checker, head); }, camera);
  if (session_.checking_only()) return;
  ir::CameraKind kind = std::move(camera);
  if (!sound || !bake(session_, around.transform, kind, head)) return;
  const ir::NameId name = parts.name ? session_.builder.add_name(parts.name.text()) : ir::NameId{};
  for (const ir::Declared& other : session_.builder.scene().camera_names) {
    if (!name.valid() || other.name != name) continue;
    session_.error(
        Diagnostic(DiagnosticKind::duplicate_camera, parts.name.span(),
                   fmt::format("there are two cameras `{}`", printable(parts.name.text())))
            .note("the first is declared here",
                  session_.builder.scene().origins[other.origin].span));
    return;
  }
  static_cast<void>(
      session_.builder.add_camera({std::move(kind)}, {name, session_.add_origin(node.span())}));
}

void Lowering::camera(NodeRef node, Scope& scope, const Surroundings& around) {
  if (around.in_proto) {
    session_.error(DiagnosticKind::light_in_proto, node.span(), "a proto cannot hold a camera");
    return;
  }
  const ast::Item parts = ast::item_of(node);
  if (!session_.checking_only()) {
    if (!notes_.first_camera.valid()) {
      notes_.first_camera = node.span();
    } else if (!notes_.second_camera.valid()) {
      notes_.second_camera = parts.name ? parts.name.span() : node.span();
    }
  }
  if (!parts.kind || !parts.block) return;
  const bool known = KindDispatch<ir::CameraKind>::call(
      parts.kind.text(), [&]<class T>() { read_camera<T>(parts, node, scope, around); });
  if (!known)
    report_unknown_kind(session_, parts.kind, "camera", KindDispatch<ir::CameraKind>::names());
}

// ---- render

void Lowering::render_block(NodeRef node, Scope& scope) {
  const NodeRef keyword = node.find_child(SyntaxKind::keyword);
  const NodeRef block = node.find_child(SyntaxKind::block);
  if (!block) return;
  const Span head = keyword ? keyword.span() : node.span();
  const bool again = notes_.render.valid();
  if (again) {
    session_.error(
        Diagnostic(DiagnosticKind::duplicate_render, head, "there are two `render` blocks")
            .note("the first is here", notes_.render));
  }
  ir::RenderSettings settings;
  const auto key = [](auto member) { return key_name<ir::RenderSettings>(member); };
  const auto checked = [&](const BlockChecker& checker) {
    if (again) return;
    check_render(session_, settings, checker);
    settings.background_written = checker.written(key(&ir::RenderSettings::background)) != nullptr;
    if (const Field* field = checker.written(key(&ir::RenderSettings::camera)))
      notes_.camera_key = field->expression;
  };
  static_cast<void>(read_block(block, head, scope, checked, settings));
  if (session_.checking_only() || again) return;
  notes_.render = head;
  render_ = std::move(settings);
  render_origin_ = session_.add_origin(node.span());
}

}  // namespace scenec::frontend
