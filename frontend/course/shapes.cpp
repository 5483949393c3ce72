// Spheres, planes, triangles, meshes and the shapes students added.
#include <cmath>

#include <fmt/format.h>

#include "base/text.hpp"
#include "frontend/course/native_text.hpp"
#include "frontend/course/objects.hpp"

namespace scenec::frontend::course {

namespace {

// Normals such as 0.6 0.8 0 have the length 1 up to the rounding of three products, their sum and
// the root; what is farther off was not written as a unit vector.
constexpr double unit_length_slack = 0x1p-50;

bool is_zero(const std::array<double, 3>& v) {
  return v[0] == 0 && v[1] == 0 && v[2] == 0;
}

}  // namespace

void Objects::write_sphere(const Entry& entry, const Target& target) {
  const Place place = entry.role() == Role::sphere ? Place::sphere : Place::moving_sphere;
  const Fields fields(context_, entry, place, {Role::position, Role::radius});
  if (!fields.complete()) return;
  const Entry& center = fields[Role::position];
  const Entry& radius = fields[Role::radius];
  if (target.outer.empty() && material_ && emitter_.empty() && materials_.is_emissive(*material_)) {
    emissive_spheres_.push_back({vector_of(center), radius.numbers[0].value});
  }
  Item item;
  item.head.put("sphere", entry.word_span);
  Operations own;
  if (const Entry* const theta = fields.find(Role::theta)) {
    Text angle = text_of_value(-theta->numbers[0].value, theta->values_span());
    own.push_back(Text("rotate_y(").put(angle).put("rad)"));
    if (!is_zero(vector_of(center)))
      own.push_back(Text("move(").put(list_of(center.numbers)).put(")"));
  } else {
    item.add("center", list_of(center.numbers), center.span);
  }
  item.add("radius", text_of(radius.numbers[0]), radius.span);
  finish(item, entry, own, target, NeedsMaterial::yes);
}

void Objects::write_plane(const Entry& entry, const Target& target) {
  const Fields fields(context_, entry, Place::plane, {Role::direction, Role::offset});
  if (!fields.complete()) return;
  const Entry& normal = fields[Role::direction];
  const Entry& offset = fields[Role::offset];
  Item item;
  item.head.put("plane", entry.word_span);
  item.add("normal", list_of(normal.numbers), normal.span);
  const auto [x, y, z] = vector_of(normal);
  const double length = std::sqrt(x * x + y * y + z * z);
  const double raw = offset.numbers[0].value;
  if (!(length > 0) || std::abs(length - 1) <= unit_length_slack || raw == 0) {
    item.add("offset", text_of(offset.numbers[0]), offset.span);
  } else {
    item.add("offset", text_of_value(raw / length, offset.values_span()), offset.span);
    context_.error(DiagnosticKind::course_plane_normal, normal.values_span(),
                   fmt::format("the normal has the length {}; the plane lies {} from the origin",
                               short_number_text(length), short_number_text(raw / length)));
  }
  if (const Entry* const texture = fields.find(Role::texture); texture != nullptr && material_) {
    if (auto use = materials_.read_texture(*texture))
      variant_ = materials_.add_variant(*material_, std::move(*use));
  }
  finish(item, entry, {}, target, NeedsMaterial::yes);
}

void Objects::write_triangle(const Entry& entry, const Target& target) {
  const Fields fields(context_, entry, Place::triangle,
                      {Role::vertex0, Role::vertex1, Role::vertex2});
  if (!fields.complete()) return;
  const std::array corners{&fields[Role::vertex0], &fields[Role::vertex1], &fields[Role::vertex2]};
  if (target.outer.empty() && material_ && emitter_.empty() && materials_.is_emissive(*material_)) {
    emissive_triangles_.push_back(
        {vector_of(*corners[0]), vector_of(*corners[1]), vector_of(*corners[2])});
  }
  Item item;
  item.head.put("triangle", entry.word_span);
  Text vertices("[");
  for (std::size_t i = 0; i < corners.size(); ++i)
    vertices.put(i == 0 ? "" : ", ").put(list_of(corners[i]->numbers));
  item.add("vertices", vertices.put("]"));
  finish(item, entry, {}, target, NeedsMaterial::yes);
}

void Objects::write_mesh(const Entry& entry, const Target& target) {
  const Fields fields(context_, entry, Place::mesh, {Role::file});
  if (!fields.complete()) return;
  const Entry& file = fields[Role::file];
  const std::string path = find_asset(context_, file.name, file.name_span);
  if (!file.numbers.empty() && file.numbers.size() != 4) {
    context_.error(DiagnosticKind::course_wrong_values, file.values_span(),
                   fmt::format("`obj_file` is followed by {} numbers; it takes none or 4",
                               file.numbers.size()));
    return;
  }
  Item item;
  item.head.put("mesh", entry.word_span);
  item.add("file", path_text(context_, path, file.name_span), file.span);
  item.add("normals", fields.find(Role::smooth) != nullptr ? ".smooth" : ".flat");
  Operations own;
  if (file.numbers.size() == 4) {
    own.push_back(Text("scale(").put(text_of(file.numbers[0])).put(")"));
    own.push_back(Text("move(").put(list_of(std::span(file.numbers).subspan(1))).put(")"));
  }
  if (const Entry* const scale = fields.find(Role::scale)) {
    own.push_back(Text("scale(").put(text_of(scale->numbers[0])).put(")"));
  }
  if (const Entry* const offset = fields.find(Role::offset)) {
    own.push_back(Text("move(").put(list_of(offset->numbers)).put(")"));
  }
  finish(item, entry, own, target, NeedsMaterial::no);
}

// `TinyObj { [Smooth] FILE }`: the only block that holds a bare file name.
void Objects::write_tiny_obj(const Entry& entry, const Target& target) {
  bool smooth = false;
  grammar::NodeRef file;
  for (const grammar::NodeRef child : entry.block.children()) {
    if (!child.is(grammar::SyntaxKind::course_word)) continue;
    if (child.text() == "Smooth") {
      smooth = true;
    } else {
      file = child;
    }
  }
  if (!file) {
    context_.error(DiagnosticKind::course_missing_word, entry.word_span,
                   "`TinyObj` lacks the name of its file");
    return;
  }
  const std::string path = find_asset(context_, file.text(), file.span());
  Item item;
  item.head.put("mesh", entry.word_span);
  item.add("file", path_text(context_, path, file.span()), file.span());
  item.add("normals", smooth ? ".smooth" : ".auto");
  finish(item, entry, {}, target, NeedsMaterial::no);
}

void Objects::write_obj_file(const Entry& file, bool phong, const Target& target) {
  const std::string path = find_asset(context_, file.name, file.name_span);
  if (!phong) context_.vocabulary = Vocabulary::path;
  // One item for each material; they share the file.
  const std::vector<ObjPart> parts = read_obj_parts(context_, path, file.name_span);
  for (std::size_t i = 0; i < std::max<std::size_t>(parts.size(), 1); ++i) {
    Item item;
    item.head.put("mesh", file.word_span);
    item.add("file", path_text(context_, path, file.name_span), file.span);
    if (parts.size() > 1) item.add("part", Text(quoted_string(parts[i].name), file.name_span));
    item.add("normals", ".auto");
    if (!parts.empty() && parts[i].material && parts[i].material->glows())
      context_.vocabulary = Vocabulary::path;
    if (!parts.empty() && parts[i].material)
      variant_ = materials_.add_obj_material(*parts[i].material, phong, file.span);
    finish(item, file, {}, target, NeedsMaterial::no);
  }
}

void Objects::write_rectangle(const Entry& entry, const Target& target) {
  const Fields fields(context_, entry, Place::rectangle,
                      {Role::position, Role::edge_u, Role::edge_v});
  if (!fields.complete()) return;
  Item item;
  item.head.put("quad", entry.word_span);
  item.add("corner", list_of(fields[Role::position].numbers), fields[Role::position].span);
  item.add("edge_u", list_of(fields[Role::edge_u].numbers), fields[Role::edge_u].span);
  item.add("edge_v", list_of(fields[Role::edge_v].numbers), fields[Role::edge_v].span);
  finish(item, entry, {}, target, NeedsMaterial::yes);
}

// Between two corners: a box, or a rectangle where they agree in one coordinate.
void Objects::write_corners(const Entry& entry, const Target& target) {
  const Fields fields(context_, entry, Place::corners, {Role::minimum, Role::maximum});
  if (!fields.complete()) return;
  const Entry& low = fields[Role::minimum];
  const Entry& high = fields[Role::maximum];
  const auto a = vector_of(low);
  const auto b = vector_of(high);
  Item item;
  std::size_t flat = 3;
  for (std::size_t i = 0; i < 3; ++i) {
    if (a[i] == b[i]) flat = i;
  }
  if (flat == 3) {
    item.head.put("box", entry.word_span);
    item.add("min", list_of(low.numbers), low.span);
    item.add("max", list_of(high.numbers), high.span);
  } else {
    std::array<double, 3> u{};
    std::array<double, 3> v{};
    const std::size_t first = (flat + 1) % 3;
    const std::size_t second = (flat + 2) % 3;
    u[first] = b[first] - a[first];
    v[second] = b[second] - a[second];
    item.head.put("quad", entry.word_span);
    item.add("corner", list_of(low.numbers), low.span);
    item.add("edge_u", list_of_values(u, high.values_span()), high.span);
    item.add("edge_v", list_of_values(v, high.values_span()), high.span);
  }
  finish(item, entry, {}, target, NeedsMaterial::yes);
}

void Objects::write_disc(const Entry& entry, const Target& target) {
  const Fields fields(context_, entry, Place::disc,
                      {Role::position, Role::direction, Role::radius});
  if (!fields.complete()) return;
  Item item;
  item.head.put("disk", entry.word_span);
  item.add("center", list_of(fields[Role::position].numbers), fields[Role::position].span);
  item.add("normal", list_of(fields[Role::direction].numbers), fields[Role::direction].span);
  item.add("radius", text_of(fields[Role::radius].numbers[0]), fields[Role::radius].span);
  finish(item, entry, {}, target, NeedsMaterial::yes);
}

void Objects::write_cage(const Entry& entry, const Target& target) {
  const Fields fields(context_, entry, Place::cage, {Role::profile});
  if (!fields.complete()) return;
  Entry object = fields[Role::profile];
  const Word* const word = find_word(Place::transform, object.name);
  if (word == nullptr || word->place != Place::group) {
    context_.error(DiagnosticKind::course_unknown_word, object.name_span,
                   fmt::format("`{}` has no reading as an object", printable(object.name)));
    return;
  }
  object.word = word;
  object.name = {};
  write_object(object, target);
}

}  // namespace scenec::frontend::course
