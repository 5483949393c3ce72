// Lights without an extent, and what all lights share.
#include "frontend/course/lights.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "base/text.hpp"
#include "frontend/course/counts.hpp"
#include "frontend/course/native_text.hpp"

namespace scenec::frontend::course {

namespace {

// Words that say the same thing in another light: what a message names as missing.
std::string_view word_of_light(Role role) {
  for (const Word& word : all_words()) {
    if (word.place == Place::light && word.role == role) return word.text;
  }
  return "";
}

}  // namespace

void Lights::read(const Entry& block, Place place) {
  BlockReader reader(context_, block.block, place);
  Count count;
  while (const auto entry = reader.next()) {
    if (entry->role() == Role::count) {
      count.state(*entry);
    } else if (entry->role() == Role::skybox) {
      ++count.found;
      lights_.push_back({*entry, Fields()});
    } else if (entry->role() != Role::ignored) {
      ++count.found;
      lights_.push_back({*entry, Fields(context_, *entry, Place::light, {})});
    }
  }
  count.check(context_, place == Place::lights ? "numLights" : "numDiskLights", "light", reader,
              block.word_span);
}

void Lights::write(Text& out, bool inverse_pi) {
  inverse_pi_ = inverse_pi;
  for (const Light& light : lights_) write_one(light, out);
}

void Lights::write_one(const Light& light, Text& out) {
  switch (light.block.role()) {
    case Role::point_light:
      return write_point(light, out);
    case Role::directional_light:
      return write_directional(light, out);
    case Role::sphere_light:
      return write_sphere(light, out);
    case Role::disk_light:
      return write_disk(light, out);
    case Role::spot_light:
      return write_spot(light, out);
    case Role::axis_disk_light:
      return write_axis_disk(light, out);
    case Role::axis_rect_light:
      return write_axis_rect(light, out);
    case Role::rect_light:
      return write_rect(light, out);
    case Role::area_light:
      return write_area(light, out);
    case Role::skybox:
      return write_skybox(light, out);
    default:
      return;
  }
}

bool Lights::require(const Light& light, std::initializer_list<Role> roles) {
  std::vector<std::string_view> missing;
  for (const Role role : roles) {
    const Entry* const entry = light.fields.find(role);
    // `power` in three numbers is a colour.
    const Entry* const power = light.fields.find(Role::power);
    if (entry == nullptr && role == Role::color && power != nullptr && power->numbers.size() == 3)
      continue;
    if (entry == nullptr && role == Role::color && light.fields.find(Role::radiance) != nullptr)
      continue;
    if (entry == nullptr) missing.push_back(word_of_light(role));
  }
  // What had wrong values was reported where it stands.
  if (!missing.empty() && !light.fields.had_mistakes()) {
    context_.error(DiagnosticKind::course_missing_word, light.block.word_span,
                   fmt::format("`{}` lacks {}", light.block.word->text, quoted_list(missing)));
  }
  if (!missing.empty()) return false;
  const Entry* const position = light.fields.find(Role::position);
  const bool on_axis =
      light.block.role() == Role::axis_disk_light || light.block.role() == Role::axis_rect_light;
  if (position != nullptr && (position->numbers.size() == 1) != on_axis) {
    context_.error(DiagnosticKind::course_wrong_values, position->values_span(),
                   fmt::format("`position` of `{}` takes {}", light.block.word->text,
                               on_axis ? "a number" : "3 numbers"));
    return false;
  }
  return true;
}

Text Lights::color_of_light(const Light& light) const {
  const Entry* color = light.fields.find(Role::radiance);
  if (color == nullptr) color = light.fields.find(Role::color);
  const Entry* const power = light.fields.find(Role::power);
  if (color == nullptr && power != nullptr) color = power;
  if (color == nullptr) return "white";
  const double scale = light.fields.value(Role::scale, 1);
  if (scale == 1) return color_of(color->numbers);
  std::vector<double> values;
  values.reserve(color->numbers.size());
  for (const Number& number : color->numbers) values.push_back(number.value * scale);
  return color_of_values(values, color->values_span());
}

void Lights::add_strength(Item& item, const Light& light) const {
  const Entry* const power = light.fields.find(Role::power);
  if (power != nullptr) {
    item.add("power", power->numbers.size() == 1 ? text_of(power->numbers[0]) : Text("1"),
             power->span);
  } else {
    item.add("radiance", "1");
  }
  item.add("color", color_of_light(light));
}

void Lights::finish(Item& item, const Light& light, Text& out) const {
  item.origin = join(light.block.word_span, light.block.block.span());
  write_item(out, item, 0);
}

void Lights::write_point(const Light& light, Text& out) {
  if (!require(light, {Role::position, Role::color})) return;
  const Entry& position = light.fields[Role::position];
  const Entry* const power = light.fields.find(Role::power);
  const Entry* const radius = light.fields.find(Role::radius);
  Item item;
  if (power != nullptr && radius != nullptr) {
    item.head.put("light: sphere", light.block.word_span);
    item.add("center", list_of(position.numbers), position.span);
    item.add("radius", text_of(radius->numbers[0]), radius->span);
    add_strength(item, light);
    return finish(item, light, out);
  }
  item.head.put("light: point", light.block.word_span);
  item.add("position", list_of(position.numbers), position.span);
  const Entry* const falloff = light.fields.find(Role::falloff);
  if (power == nullptr && falloff != nullptr && falloff->numbers[0].value > 0) {
    Text intensity(inverse_pi_ ? "pi / " : "1 / ");
    item.add("intensity", intensity.put(text_of(falloff->numbers[0])), falloff->span);
  } else {
    add_power_or_unit(item, power);
  }
  item.add("color", color_of_light(light));
  finish(item, light, out);
}

void Lights::add_list(Item& item, std::string_view key, const Light& light, Role role) {
  item.add(key, list_of(light.fields[role].numbers), light.fields[role].span);
}

void Lights::add_number(Item& item, std::string_view key, const Light& light, Role role) {
  item.add(key, text_of(light.fields[role].numbers[0]), light.fields[role].span);
}

void Lights::add_power_or_unit(Item& item, const Entry* power) const {
  if (power != nullptr) {
    item.add("power", power->numbers.size() == 1 ? text_of(power->numbers[0]) : Text("1"),
             power->span);
  } else {
    item.add("intensity", inverse_pi_ ? "pi" : "1");
    item.add("decay", ".none");
  }
}

void Lights::write_directional(const Light& light, Text& out) {
  if (!require(light, {Role::direction, Role::color})) return;
  const Entry& direction = light.fields[Role::direction];
  if (const Entry* const position = light.fields.find(Role::position)) {
    context_.warn_once(DiagnosticKind::course_ignored_word, "beam", position->word_span,
                       "the position, extent and power of a `DirectionalLight` have no effect: it "
                       "is parallel light everywhere");
  }
  Item item;
  item.head.put("light: directional", light.block.word_span);
  item.add("direction", list_of(direction.numbers), direction.span);
  item.add("irradiance", inverse_pi_ ? "pi" : "1");
  item.add("color", color_of_light(light));
  finish(item, light, out);
}

void Lights::write_spot(const Light& light, Text& out) {
  if (!require(light, {Role::position, Role::direction, Role::angle, Role::color})) return;
  const Entry& angle = light.fields[Role::angle];
  Item item;
  item.head.put("light: spot", light.block.word_span);
  add_list(item, "position", light, Role::position);
  add_list(item, "direction", light, Role::direction);
  item.add("angle", degrees_of(angle.numbers[0]), angle.span);
  add_power_or_unit(item, light.fields.find(Role::power));
  item.add("color", color_of_light(light));
  finish(item, light, out);
}

// `Skybox { FILE R radius }`: like `TinyObj` it holds a bare file name.
void Lights::write_skybox(const Light& light, Text& out) {
  grammar::NodeRef file;
  for (const grammar::NodeRef child : light.block.block.children()) {
    if (child.is(grammar::SyntaxKind::course_word) && !file) file = child;
  }
  if (!file) {
    context_.error(DiagnosticKind::course_missing_word, light.block.word_span,
                   "`Skybox` lacks the name of its image");
    return;
  }
  const std::string path = find_asset(context_, file.text(), file.span());
  Item item;
  item.head.put("light: environment", light.block.word_span);
  item.add("image", image_text(context_, {path, file.span(), {}}));
  finish(item, light, out);
}

}  // namespace scenec::frontend::course
