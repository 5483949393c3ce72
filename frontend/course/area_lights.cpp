// Lights with an extent: spheres, disks, parallelograms, triangles, meshes.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/elementary.hpp"
#include "base/text.hpp"
#include "frontend/course/lights.hpp"
#include "frontend/course/native_text.hpp"

namespace scenec::frontend::course {

namespace {

using Vector = std::array<double, 3>;

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double length(const Vector& v) {
  return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

Vector scaled_to(const Vector& v, double wanted) {
  const double own = length(v);
  if (!(own > 0)) return v;
  return {v[0] * wanted / own, v[1] * wanted / own, v[2] * wanted / own};
}

constexpr std::array<Role, 3> axis_roles{Role::axis_x, Role::axis_y, Role::axis_z};
constexpr std::array<std::string_view, 3> axis_words{"X", "Y", "Z"};

}  // namespace

// A direction across an axis: `Z-` is axis 2, sign -1.
struct Lights::Axis {
  std::size_t index = 0;
  double sign = 1;
};

std::optional<Lights::Axis> Lights::axis_of_normal(const Light& light) {
  const Entry& normal = light.fields[Role::direction];
  const std::string_view word = normal.name;
  if (word.size() == 2 && word[0] >= 'X' && word[0] <= 'Z' && (word[1] == '+' || word[1] == '-'))
    return Axis{static_cast<std::size_t>(word[0] - 'X'), word[1] == '+' ? 1.0 : -1.0};
  context_.error(DiagnosticKind::course_wrong_values, normal.span,
                 "`normal` takes one of `X+`, `X-`, `Y+`, `Y-`, `Z+`, `Z-` here");
  return std::nullopt;
}

void Lights::write_sphere(const Light& light, Text& out) {
  if (!require(light, {Role::position, Role::radius, Role::color})) return;
  const Entry& position = light.fields[Role::position];
  const Entry& radius = light.fields[Role::radius];
  const Vector center = vector_of(position);
  const auto& spheres = objects_.emissive_spheres();
  const bool twice = std::any_of(spheres.begin(), spheres.end(), [&](const EmissiveSphere& sphere) {
    return sphere.center == center && sphere.radius == radius.numbers[0].value;
  });
  if (twice) return;  // the glowing sphere of the group is this light
  Item item;
  item.head.put("light: sphere", light.block.word_span);
  item.add("center", list_of(position.numbers), position.span);
  item.add("radius", text_of(radius.numbers[0]), radius.span);
  add_strength(item, light);
  finish(item, light, out);
}

void Lights::write_disk(const Light& light, Text& out) {
  if (!require(light, {Role::position, Role::direction, Role::radius, Role::color})) return;
  Item item;
  item.head.put("light: disk", light.block.word_span);
  add_list(item, "center", light, Role::position);
  add_list(item, "normal", light, Role::direction);
  add_number(item, "radius", light, Role::radius);
  add_strength(item, light);
  finish(item, light, out);
}

void Lights::write_axis_disk(const Light& light, Text& out) {
  if (!require(light, {Role::position, Role::direction, Role::radius, Role::color})) return;
  const Entry& normal = light.fields[Role::direction];
  const auto axis = axis_of_normal(light);
  if (!axis) return;
  Vector center{};
  Vector direction{};
  center[axis->index] = light.fields.value(Role::position, 0);
  direction[axis->index] = axis->sign;
  for (std::size_t i = 0; i < 3; ++i) {
    if (i != axis->index) center[i] = light.fields.value(axis_roles[i], 0);
  }
  Item item;
  item.head.put("light: disk", light.block.word_span);
  item.add("center", list_of_values(center, light.fields[Role::position].values_span()));
  item.add("normal", list_of_values(direction, normal.name_span), normal.span);
  add_number(item, "radius", light, Role::radius);
  add_strength(item, light);
  finish(item, light, out);
}

void Lights::write_axis_rect(const Light& light, Text& out) {
  if (!require(light, {Role::position, Role::direction, Role::color})) return;
  const auto axis = axis_of_normal(light);
  if (!axis) return;
  Vector corner{};
  corner[axis->index] = light.fields.value(Role::position, 0);
  std::array<Vector, 2> edges{};
  for (std::size_t k = 0; k < 2; ++k) {
    const std::size_t i = (axis->index + 1 + k) % 3;
    const Entry* const range = light.fields.find(axis_roles[i]);
    if (range == nullptr || range->numbers.size() != 2) {
      context_.error(DiagnosticKind::course_missing_word,
                     range == nullptr ? light.block.word_span : range->span,
                     fmt::format("`RectLight` needs `{}` with 2 numbers", axis_words[i]));
      return;
    }
    corner[i] = range->numbers[0].value;
    edges[k][i] = range->numbers[1].value - range->numbers[0].value;
  }
  if (axis->sign < 0) std::swap(edges[0], edges[1]);  // shines along edge_u x edge_v
  const Span span = light.fields[Role::position].values_span();
  Item item;
  item.head.put("light: quad", light.block.word_span);
  item.add("corner", list_of_values(corner, span));
  item.add("edge_u", list_of_values(edges[0], span));
  item.add("edge_v", list_of_values(edges[1], span));
  add_strength(item, light);
  finish(item, light, out);
}

// Centred at `position`, dy along `up`, facing `direction`.
void Lights::write_rect(const Light& light, Text& out) {
  if (!require(light, {Role::position, Role::direction, Role::up, Role::size_x, Role::size_y,
                       Role::color}))
    return;
  const Vector position = vector_of(light.fields[Role::position]);
  const Vector direction = vector_of(light.fields[Role::direction]);
  const Vector across = cross(vector_of(light.fields[Role::up]), direction);
  const Vector along = cross(direction, across);
  const Vector u = scaled_to(across, light.fields.value(Role::size_x, 1));
  const Vector v = scaled_to(along, light.fields.value(Role::size_y, 1));
  Vector corner{};
  for (std::size_t i = 0; i < 3; ++i) corner[i] = position[i] - (u[i] + v[i]) / 2;
  const Span span = light.fields[Role::position].values_span();
  Item item;
  item.head.put("light: quad", light.block.word_span);
  item.add("corner", list_of_values(corner, span));
  item.add("edge_u", list_of_values(u, light.fields[Role::size_x].values_span()));
  item.add("edge_v", list_of_values(v, light.fields[Role::size_y].values_span()));
  add_strength(item, light);
  finish(item, light, out);
}

// `AreaLight` is six different things; its words tell which.
void Lights::write_area(const Light& light, Text& out) {
  if (light.fields.find(Role::vertex0) != nullptr) return write_triangle(light, out);
  if (light.fields.find(Role::edge_u) != nullptr) return write_parallelogram(light, out);
  if (light.fields.find(Role::file) != nullptr) return write_mesh(light, out);
  if (light.fields.find(Role::object) != nullptr) return write_object(light, out);
  if (light.fields.find(Role::area) != nullptr) return write_disk_of_area(light, out);
  if (light.fields.find(Role::radius) != nullptr) return write_disk(light, out);
  context_.error(DiagnosticKind::course_missing_word, light.block.word_span,
                 "`AreaLight` lacks its shape: `vertex0` .. `vertex2`, `axis1` and `axis2`, `dirX` "
                 "and `dirY`, `area`, `mesh` or an object");
}

void Lights::write_parallelogram(const Light& light, Text& out) {
  if (!require(light, {Role::position, Role::edge_u, Role::edge_v, Role::color})) return;
  Item item;
  item.head.put("light: quad", light.block.word_span);
  add_list(item, "corner", light, Role::position);
  add_list(item, "edge_u", light, Role::edge_u);
  add_list(item, "edge_v", light, Role::edge_v);
  add_strength(item, light);
  finish(item, light, out);
}

void Lights::write_disk_of_area(const Light& light, Text& out) {
  if (!require(light, {Role::position, Role::direction, Role::color})) return;
  const Entry& area = light.fields[Role::area];
  Item item;
  item.head.put("light: disk", light.block.word_span);
  add_list(item, "center", light, Role::position);
  add_list(item, "normal", light, Role::direction);
  item.add("radius",
           text_of_value(std::sqrt(std::max(area.numbers[0].value, 0.0) / pi), area.values_span()),
           area.span);
  add_strength(item, light);
  finish(item, light, out);
}

void Lights::write_triangle(const Light& light, Text& out) {
  if (!require(light, {Role::vertex0, Role::vertex1, Role::vertex2, Role::color})) return;
  const EmissiveTriangle corners{vector_of(light.fields[Role::vertex0]),
                                 vector_of(light.fields[Role::vertex1]),
                                 vector_of(light.fields[Role::vertex2])};
  const auto& triangles = objects_.emissive_triangles();
  if (std::find(triangles.begin(), triangles.end(), corners) != triangles.end()) return;
  const std::string material = materials_.add_emitter(color_of_light(light), light.block.word_span);
  Item item;
  item.head.put("triangle", light.block.word_span);
  Text vertices("[");
  for (const Role role : {Role::vertex0, Role::vertex1, Role::vertex2}) {
    vertices.put(role == Role::vertex0 ? "" : ", ").put(list_of(light.fields[role].numbers));
  }
  item.add("vertices", vertices.put("]"));
  item.add("material", Text(material));
  finish(item, light, out);
}

void Lights::write_mesh(const Light& light, Text& out) {
  if (!require(light, {Role::position, Role::right, Role::up, Role::color})) return;
  const Entry& file = light.fields[Role::file];
  const std::string path = find_asset(context_, file.name, file.name_span);
  const Entry* const size = light.fields.find(Role::size);
  const Vector x =
      scaled_to(vector_of(light.fields[Role::right]), size == nullptr ? 1 : size->numbers[0].value);
  const Vector y = scaled_to(vector_of(light.fields[Role::up]), 1);
  const Vector z = scaled_to(cross(x, y), size == nullptr ? 1 : size->numbers[1].value);
  const Vector position = vector_of(light.fields[Role::position]);
  std::vector<double> matrix;
  for (std::size_t row = 0; row < 3; ++row) {
    for (const double value : {x[row], y[row], z[row], position[row]}) matrix.push_back(value);
  }
  for (const double value : {0.0, 0.0, 0.0, 1.0}) matrix.push_back(value);
  const std::string material = materials_.add_emitter(color_of_light(light), light.block.word_span);
  Item item;
  item.head.put("mesh", light.block.word_span);
  item.add("file", path_text(context_, path, file.name_span), file.span);
  item.add("material", Text(material));
  item.add("transform",
           Text("matrix(").put(list_of_values(matrix, light.block.word_span)).put(")"));
  finish(item, light, out);
}

void Lights::write_object(const Light& light, Text& out) {
  if (!require(light, {Role::color})) return;
  const Entry& held = light.fields[Role::object];
  Entry object = held;
  object.word = find_word(Place::group, held.word->text);
  const std::string material = materials_.add_emitter(color_of_light(light), light.block.word_span);
  objects_.write_emitter(object, material, out);
}

}  // namespace scenec::frontend::course
