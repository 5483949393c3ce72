// Groups, transforms and the running material.
#include "frontend/course/objects.hpp"

#include <cmath>

#include <fmt/format.h>

#include "base/text.hpp"
#include "frontend/course/counts.hpp"
#include "frontend/course/native_text.hpp"

namespace scenec::frontend::course {

Text transform_text(const Operations& operations) {
  Text text("[");
  for (std::size_t i = 0; i < operations.size(); ++i) {
    if (i > 0) text.put(", ");
    text.put(operations[i]);
  }
  text.put("]");
  return text;
}

void Objects::write_scene(const Entry& group, Text& out) {
  const Operations none;
  write_members(group, {out, 0, none});
}

void Objects::write_emitter(const Entry& object, const std::string& material, Text& out) {
  const Operations none;
  emitter_ = material;
  write_object(object, {out, 0, none});
  emitter_.clear();
}

void Objects::write_members(const Entry& group, const Target& target) {
  BlockReader reader(context_, group.block, Place::group);
  Count count;
  bool from_file = false;
  bool phong = true;
  while (const auto entry = reader.next()) {
    switch (entry->role()) {
      case Role::count:
        count.state(*entry);
        break;
      case Role::material_index:
        set_material(*entry);
        break;
      case Role::obj_material_type:
        phong = entry->numbers.front().value == 0;
        break;
      case Role::obj_file:
        from_file = true;
        write_obj_file(*entry, phong, target);
        break;
      default:
        ++count.found;
        write_object(*entry, target);
    }
  }
  if (!from_file) count.check(context_, "numObjects", "object", reader, group.word_span);
}

void Objects::set_material(const Entry& entry) {
  const double index = entry.numbers.front().value;
  material_stated_ = true;
  material_.reset();
  material_span_ = entry.numbers.front().span;
  if (index == -1) return;
  const auto count = static_cast<double>(materials_.size());
  if (index >= 0 && index < count && index == std::floor(index)) {
    material_ = static_cast<std::size_t>(index);
    return;
  }
  context_.error(DiagnosticKind::course_material_index, material_span_,
                 materials_.size() == 0
                     ? std::string("there is no `Materials` block before this group")
                     : fmt::format("there is no material {}; the last one is {}, counted from 0",
                                   short_number_text(index), materials_.size() - 1));
}

void Objects::write_object(const Entry& entry, const Target& target) {
  switch (entry.role()) {
    case Role::group:
      return write_group(entry, target);
    case Role::transform:
      return write_transform(entry, target);
    case Role::sphere:
      return write_sphere(entry, target);
    case Role::moving_sphere:
      return write_sphere(entry, target);
    case Role::plane:
      return write_plane(entry, target);
    case Role::triangle:
      return write_triangle(entry, target);
    case Role::mesh:
      return write_mesh(entry, target);
    case Role::tiny_obj:
      return write_tiny_obj(entry, target);
    case Role::rectangle:
      return write_rectangle(entry, target);
    case Role::corners:
      return write_corners(entry, target);
    case Role::disc:
      return write_disc(entry, target);
    case Role::revolve:
      return write_revolve(entry, target);
    case Role::cage:
      return write_cage(entry, target);
    case Role::curve:
      return skip_curve(entry);
    default:
      return;
  }
}

void Objects::write_group(const Entry& entry, const Target& target) {
  static const Operations none;
  const std::size_t begin = target.out.size();
  write_indent(target.out, target.indent);
  target.out.put("group", entry.word_span).put(" {\n");
  if (!target.outer.empty()) {
    write_indent(target.out, target.indent + 1);
    target.out.put("transform = ").put(transform_text(target.outer)).put(";\n");
  }
  write_members(entry, {target.out, target.indent + 1, none});
  write_indent(target.out, target.indent);
  target.out.put("}");
  target.out.cover(begin, join(entry.word_span, entry.block.span()));
  target.out.put("\n");
}

// M starts as identity and every operation multiplies on the right (M = M T), so the first listed
// is applied last; a Matrix4f multiplies on the left (M = T M) and so comes after all of them.
void Objects::write_transform(const Entry& entry, const Target& target) {
  BlockReader reader(context_, entry.block, Place::transform);
  Operations reversed;
  Operations matrices;
  std::optional<Entry> object;
  std::size_t objects = 0;
  while (auto member = reader.next()) {
    if (member->role() == Role::ignored) continue;
    if (member->word->place == Place::group) {
      if (++objects == 1) object = std::move(member);
      continue;
    }
    (member->role() == Role::matrix ? matrices : reversed).push_back(operation_of(*member));
  }
  if (objects != 1) {
    if (objects != 0 || !reader.had_mistakes()) {
      context_.error(DiagnosticKind::course_one_object, entry.word_span,
                     fmt::format("`Transform` holds {} objects; it needs exactly one", objects));
    }
    if (objects == 0) return;
  }
  Operations all(reversed.rbegin(), reversed.rend());
  all.insert(all.end(), matrices.begin(), matrices.end());
  all.insert(all.end(), target.outer.begin(), target.outer.end());
  write_object(*object, {target.out, target.indent, all});
}

Text Objects::operation_of(const Entry& entry) {
  const std::vector<Number>& n = entry.numbers;
  Text text;
  switch (entry.role()) {
    case Role::scale:
      text.put("scale(").put(list_of(n));
      break;
    case Role::uniform_scale:
      text.put("scale(").put(text_of(n[0]));
      break;
    case Role::translate:
      text.put("move(").put(list_of(n));
      break;
    case Role::rotate_x:
      text.put("rotate_x(").put(degrees_of(n[0]));
      break;
    case Role::rotate_y:
      text.put("rotate_y(").put(degrees_of(n[0]));
      break;
    case Role::rotate_z:
      text.put("rotate_z(").put(degrees_of(n[0]));
      break;
    case Role::rotate:
      text.put("rotate(").put(list_of(std::span(n).first(3))).put(", ").put(degrees_of(n[3]));
      break;
    default: {  // column by column to row by row
      std::vector<Number> rows;
      for (std::size_t row = 0; row < 4; ++row) {
        for (std::size_t column = 0; column < 4; ++column) rows.push_back(n[column * 4 + row]);
      }
      text.put("matrix([");
      for (std::size_t i = 0; i < rows.size(); ++i) {
        if (i > 0) text.put(", ");
        text.put(text_of(rows[i]));
      }
      text.put("]");
    }
  }
  text.put(")");
  text.cover(0, entry.span);
  return text;
}

void Objects::add_material(Item& item, const Entry& entry, NeedsMaterial needs) {
  if (!emitter_.empty()) {
    item.add("material", Text(emitter_));
  } else if (!variant_.empty()) {
    item.add("material", Text(variant_));
    variant_.clear();
  } else if (material_) {
    item.add("material", Text(materials_.use(*material_), material_span_));
  } else if (needs == NeedsMaterial::yes && !material_stated_) {
    context_.error(DiagnosticKind::course_no_material, entry.word_span,
                   fmt::format("`{}` stands before the first `MaterialIndex`", entry.word->text));
    material_stated_ = true;  // said once
  }
}

void Objects::finish(Item& item, const Entry& entry, const Operations& own, const Target& target,
                     NeedsMaterial needs) {
  item.origin = join(entry.word_span, entry.block ? entry.block.span() : entry.span);
  add_material(item, entry, needs);
  if (!own.empty() || !target.outer.empty()) {
    Operations all = own;
    all.insert(all.end(), target.outer.begin(), target.outer.end());
    item.add("transform", transform_text(all));
  }
  write_item(target.out, item, target.indent);
}

}  // namespace scenec::frontend::course
