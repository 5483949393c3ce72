// Shapes, instances, groups and materials.
#include <fmt/format.h>

#include <algorithm>

#include "base/text.hpp"
#include "frontend/check/check_shape.hpp"
#include "frontend/check/invertible.hpp"
#include "frontend/check/key_name.hpp"
#include "frontend/check/lint_material.hpp"
#include "frontend/lower/lowering_access.hpp"

namespace scenec::frontend {

using grammar::SyntaxKind;

namespace {

// Shapes an author writes by their kind: all but the instance, which has a keyword.
std::vector<std::string_view> shape_names() {
  auto names = KindDispatch<ir::ShapeTypes>::names();
  std::erase(names, ir::Schema<ir::Instance>::name);
  return names;
}

}  // namespace

ir::TransformId Lowering::transform_for(const std::optional<ir::Transform>& own,
                                        const Surroundings& around, Span span) {
  if (!own) return session_.builder.add_transform(around.transform);
  if (around.transform.is_identity()) return session_.builder.add_transform(*own);
  ir::Transform product = ir::multiply(around.transform, *own);
  for (double& entry : product.m) entry += 0.0;
  if (!check_invertible(session_, product, span)) return {};
  return session_.builder.add_transform(product);
}

void Lowering::note_gap(const Surroundings& around, Span lint) {
  if (around.in_proto) {
    proto_gaps_.add(around.items->size(), lint);
  } else if (lint.valid()) {
    if (notes_.bare_count++ == 0) notes_.first_bare = lint;
  }
}

template <class T>
void Lowering::fill_material(T& shape, ir::Item& item, const Surroundings& around, Span span) {
  const bool allowed = session_.is_allowed(DiagnosticKind::default_material);
  if constexpr (std::same_as<T, ir::Instance>) {
    // An instance keeps the materials of its proto; only gaps are filled.
    if (!proto_gaps_.any(shape.of)) return;
    if (around.material.valid()) {
      shape.of = proto_gaps_.filled(shape.of, around.material);
    } else {
      note_gap(around, allowed ? Span{} : proto_gaps_.lint(shape.of));
    }
  } else {
    item.material = around.material;
    if (item.material.valid()) return;
    note_gap(around, allowed ? Span{} : span);
    item.material = default_material();
  }
}

ir::MaterialId Lowering::default_material() {
  if (!default_material_.valid()) {
    const ir::Diffuse grey{.color = {{0.5, 0.5, 0.5}, {}}};
    default_material_ = session_.builder.add_material({.kind = grey, .common = {}}, {});
  }
  return default_material_;
}

template <class T>
void Lowering::place(const ast::Item& parts, NodeRef node, Scope& scope,
                     const Surroundings& around) {
  const Span head = parts.kind ? parts.kind.span() : parts.block.span();
  T shape{};
  ir::Placing placing;
  // Where a key is wrong the material may be the one: nothing is said of its absence.
  bool material_written = true;
  const auto checked = [&](const BlockChecker& checker) {
    check_shape(session_, shape, checker, head);
    material_written = checker.written(key_name<ir::Placing>(&ir::Placing::material)) != nullptr;
  };
  static_cast<void>(read_block(parts.block, head, scope, checked, shape, placing));
  if (session_.checking_only() || !session_.count_item(head)) return;
  if (!around.in_proto && !notes_.first_placed.valid()) notes_.first_placed = head;
  ir::Item item;
  item.transform = transform_for(placing.transform, around, head);
  item.material = placing.material;
  if (!item.material.valid() && !material_written) fill_material(shape, item, around, head);
  item.shape = session_.builder.add_shape(std::move(shape));
  item.origin = session_.add_origin(node.span());
  if (parts.name) item.name = session_.builder.add_name(parts.name.text());
  if (around.items != nullptr) {
    around.items->push_back(item);
  } else {
    session_.builder.place(item);
  }
}

void Lowering::shape(NodeRef node, Scope& scope, const Surroundings& around) {
  const ast::Item parts = ast::item_of(node);
  if (!parts.kind || !parts.block) return;
  const bool known = KindDispatch<ir::ShapeTypes>::call(
      parts.kind.text(), [&]<class T>() { place<T>(parts, node, scope, around); });
  if (!known) report_unknown_kind(session_, parts.kind, "shape", shape_names());
}

void Lowering::instance(NodeRef node, Scope& scope, const Surroundings& around) {
  ast::Item parts = ast::item_of(node);
  parts.kind = node.find_child(SyntaxKind::keyword);
  if (parts.block) place<ir::Instance>(parts, node, scope, around);
}

void Lowering::group(NodeRef node, Scope& scope, const Surroundings& around) {
  const ast::Item parts = ast::item_of(node);
  if (!parts.block) return;
  const NodeRef keyword = node.find_child(SyntaxKind::keyword);
  const Span head = keyword ? keyword.span() : node.span();
  Scope inside(&scope);
  Surroundings inner = around;
  ir::Placing placing;
  // Keys may stand anywhere among the items, so names and keys are read before anything is placed.
  items(parts.block, inside, around, Pass::declarations);
  {
    const FieldsLease lease(*this);
    for (NodeRef child : parts.block.children()) {
      if (!child.is(SyntaxKind::field)) continue;
      const ast::Field field = ast::field_of(child);
      if (field.name)
        lease.fields->add(session_, {.name = field.name.text(),
                                     .name_node = field.name,
                                     .expression = field.expression,
                                     .block = {}});
    }
    BlockChecker checker(session_, evaluator_, *this, inside, *lease.fields, "group", head);
    checker.read(placing);
    checker.finish<ir::Placing>();
  }
  if (placing.material.valid()) inner.material = placing.material;
  if (placing.transform) {
    inner.transform = ir::multiply(around.transform, *placing.transform);
    for (double& entry : inner.transform.m) entry += 0.0;
    if (!check_invertible(session_, inner.transform, head)) inner.transform = {};
  }
  items(parts.block, inside, inner, Pass::placements);
  close(inside);
}

// ---- materials

template <class T>
void Lowering::read_material(const ast::Item& parts, NodeRef node, Scope& scope, Value& value) {
  T kind{};
  ir::MaterialCommon common;
  const Span head = parts.kind.span();
  static_cast<void>(read_block(
      parts.block, head, scope,
      [&](const BlockChecker& checker) { lint_material(session_, kind, checker, head); }, kind,
      common));
  if (session_.checking_only()) return;
  if (common.emission.texture.valid() || common.emission.value != ir::black) notes_.emission = true;
  const ir::NameId name = session_.builder.add_name(parts.name.text());
  value = make_material(session_.builder.add_material({std::move(kind), std::move(common)},
                                                      {name, session_.add_origin(node.span())}));
}

void Lowering::declare_material(NodeRef node, Scope& scope) {
  const ast::Item parts = ast::item_of(node);
  if (!parts.name) return;
  Value value = make_unknown(Type::material);
  if (parts.kind && parts.block) {
    const bool known = KindDispatch<ir::MaterialKind>::call(
        parts.kind.text(), [&]<class T>() { read_material<T>(parts, node, scope, value); });
    if (!known)
      report_unknown_kind(session_, parts.kind, "material",
                          KindDispatch<ir::MaterialKind>::names());
  }
  declare(scope, parts.name, BindingKind::material, std::move(value), node);
}

}  // namespace scenec::frontend
