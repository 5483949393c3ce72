#include "base/units.hpp"

#include "base/elementary.hpp"

namespace scenec {

namespace {

struct BaseDimension {
  std::int8_t Dimension::* exponent;
  std::string_view name;
  std::string_view unit;
};
constexpr std::array<BaseDimension, 5> base_dimensions{{
    {&Dimension::length, "length", "m"},
    {&Dimension::angle, "angle", "rad"},
    {&Dimension::time, "time", "s"},
    {&Dimension::power, "power", "W"},
    {&Dimension::temperature, "temperature", "K"},
}};

constexpr std::array<Unit, 11> units{{
    {"m", dimension::length, 1, 1},
    {"cm", dimension::length, 1, 100},
    {"mm", dimension::length, 1, 1000},
    {"km", dimension::length, 1000, 1},
    {"deg", dimension::angle, pi, 180},
    {"rad", dimension::angle, 1, 1},
    {"s", dimension::time, 1, 1},
    {"ms", dimension::time, 1, 1000},
    {"W", dimension::power, 1, 1},
    {"K", dimension::temperature, 1, 1},
    {"%", dimension::none, 1, 100},
}};

std::string product_text(Dimension dimension, std::string_view BaseDimension::* word) {
  std::string text;
  for (const BaseDimension& base : base_dimensions) {
    const int exponent = dimension.*base.exponent;
    if (exponent == 0) continue;
    if (!text.empty()) text += ' ';
    text += base.*word;
    if (exponent != 1) text += '^' + std::to_string(exponent);
  }
  return text;
}

}  // namespace

std::string name_of(Dimension dimension) {
  if (dimension.none()) return "number";
  return product_text(dimension, &BaseDimension::name);
}

std::string si_unit_of(Dimension dimension) {
  return product_text(dimension, &BaseDimension::unit);
}

std::optional<Unit> find_unit(std::string_view suffix) {
  for (const Unit& unit : units) {
    if (unit.suffix == suffix) return unit;
  }
  return std::nullopt;
}

const std::array<Unit, 11>& all_units() {
  return units;
}

}  // namespace scenec
