#include "frontend/ast/sdl_ast.hpp"

namespace scenec::frontend::ast {

NodeRef expression_of(NodeRef node) {
  for (NodeRef child : node.children()) {
    if (is_expression(child.kind())) return child;
  }
  return {};
}

NodeRef second_expression_of(NodeRef node) {
  const NodeRef first = expression_of(node);
  for (NodeRef child : node.children()) {
    if (is_expression(child.kind()) && child != first) return child;
  }
  return {};
}

Field field_of(NodeRef node) {
  Field field;
  for (NodeRef child : node.children()) {
    if (child.is(SyntaxKind::name) && !field.name) field.name = child;
    if (is_expression(child.kind())) {
      field.expression = child;
      break;
    }
  }
  return field;
}

Item item_of(NodeRef node) {
  Item item;
  const bool kind_first = node.is(SyntaxKind::shape);
  bool behind_colon = false;
  for (NodeRef child : node.children()) {
    switch (child.kind()) {
      case SyntaxKind::annotation:
        item.annotated = true;
        break;
      case SyntaxKind::name:
        if (behind_colon || (kind_first && !item.kind)) {
          item.kind = child;
        } else {
          item.name = child;
        }
        break;
      case SyntaxKind::punctuation:
        behind_colon = child.text() == ":";
        break;
      case SyntaxKind::type:
        item.type = child;
        break;
      case SyntaxKind::range:
        item.range = child;
        break;
      case SyntaxKind::parameters:
        item.parameters = child;
        break;
      case SyntaxKind::block:
        item.block = child;
        break;
      default:
        if (is_expression(child.kind()) && !item.expression) item.expression = child;
    }
  }
  return item;
}

Loop loop_of(NodeRef node) {
  Loop loop;
  for (NodeRef child : node.children()) {
    if (child.is(SyntaxKind::name)) {
      (loop.first ? loop.second : loop.first) = child;
    } else if (child.is(SyntaxKind::range)) {
      loop.range = child;
    } else if (child.is(SyntaxKind::block)) {
      loop.body = child;
    } else if (is_expression(child.kind())) {
      // Behind a range the only expression is the body; else the list comes first.
      (loop.range || loop.list ? loop.body : loop.list) = child;
    }
  }
  return loop;
}

Range range_of(NodeRef node) {
  Range range;
  for (NodeRef child : node.children()) {
    if (is_expression(child.kind())) (range.low ? range.high : range.low) = child;
    if (child.is(SyntaxKind::punctuation)) range.closed = child.text() == "..";
  }
  return range;
}

Arguments arguments_of(NodeRef arguments) {
  Arguments list;
  if (!arguments) return list;
  for (NodeRef child : arguments.children()) {
    if (child.is(SyntaxKind::argument))
      list.push_back({child.find_child(SyntaxKind::name), expression_of(child)});
  }
  return list;
}

std::string_view item_words(SyntaxKind kind) {
  switch (kind) {
    case SyntaxKind::include:
      return "`include`";
    case SyntaxKind::param:
      return "`param`";
    case SyntaxKind::let:
      return "`let`";
    case SyntaxKind::fn:
      return "`fn`";
    case SyntaxKind::macro:
      return "`macro`";
    case SyntaxKind::proto:
      return "`proto`";
    case SyntaxKind::material:
      return "a material";
    case SyntaxKind::light:
      return "a light";
    case SyntaxKind::camera:
      return "a camera";
    case SyntaxKind::render:
      return "`render`";
    case SyntaxKind::group:
      return "a group";
    case SyntaxKind::instance:
      return "an instance";
    case SyntaxKind::shape:
      return "a shape";
    case SyntaxKind::call_item:
      return "a macro call";
    case SyntaxKind::for_item:
      return "`for`";
    case SyntaxKind::if_item:
      return "`if`";
    case SyntaxKind::assert_item:
      return "`assert`";
    case SyntaxKind::field:
      return "a key";
    default:
      return "this";
  }
}

}  // namespace scenec::frontend::ast
