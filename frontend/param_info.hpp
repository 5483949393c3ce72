// What an author may set from outside: the params of a scene, as a page with sliders needs them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "base/span.hpp"
#include "base/units.hpp"

namespace scenec::frontend {

struct ParamInfo {
  enum class Kind : std::uint8_t { number, integer, boolean, color, string, other };
  std::string name;
  std::string type;           // as written: `length`
  std::string documentation;  // of the `///` comment
  std::string text;           // of the default, as written
  Span span{};                // of that text
  Kind kind = Kind::other;
  Dimension dimension{};          // of numbers
  std::array<double, 3> value{};  // now: a number in SI, 0 or 1, or linear red, green, blue
  std::string string_value{};     // of strings
  std::optional<double> low{};    // in SI
  std::optional<double> high{};
  bool is_set = false;  // from outside: `value` is not the default
};

}  // namespace scenec::frontend
