// Dimensions, quantities in SI units, and the unit suffixes an author may glue to a number.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace scenec {

// Exponents of the base dimensions of edition 1 (power and temperature count as base dimensions).
struct Dimension {
  std::int8_t length = 0;
  std::int8_t angle = 0;
  std::int8_t time = 0;
  std::int8_t power = 0;
  std::int8_t temperature = 0;

  friend constexpr auto operator<=>(const Dimension&, const Dimension&) = default;
  [[nodiscard]] constexpr bool none() const { return *this == Dimension{}; }
};

namespace dimension {
inline constexpr Dimension none{};
inline constexpr Dimension length{.length = 1};
inline constexpr Dimension angle{.angle = 1};
inline constexpr Dimension time{.time = 1};
inline constexpr Dimension power{.power = 1};
inline constexpr Dimension temperature{.temperature = 1};
}  // namespace dimension

// "length", "angle", ..., "number", or a product such as "length^2 time^-1".
[[nodiscard]] std::string name_of(Dimension dimension);
// The SI unit printed behind a value: "m", "rad", "m^2 s^-1"; empty for none.
[[nodiscard]] std::string si_unit_of(Dimension dimension);

// A number with a dimension known at compile time; `value` is in SI (metres, radians, seconds,
// watts, kelvins).
template <class Tag>
struct Quantity {
  double value = 0;
  friend constexpr auto operator<=>(const Quantity&, const Quantity&) = default;
};
struct LengthTag {
  static constexpr Dimension dimension = dimension::length;
};
struct AngleTag {
  static constexpr Dimension dimension = dimension::angle;
};
struct TimeTag {
  static constexpr Dimension dimension = dimension::time;
};
struct PowerTag {
  static constexpr Dimension dimension = dimension::power;
};
struct TemperatureTag {
  static constexpr Dimension dimension = dimension::temperature;
};
using Length = Quantity<LengthTag>;
using Angle = Quantity<AngleTag>;
using Time = Quantity<TimeTag>;
using Power = Quantity<PowerTag>;
using Temperature = Quantity<TemperatureTag>;

// A suffix an author may write. The SI value is `written * multiply / divide`, which keeps cm, mm
// and % correctly rounded (0.01 is not a double, 1/100 is one division).
struct Unit {
  std::string_view suffix;
  Dimension dimension;
  double multiply = 1;
  double divide = 1;
};
[[nodiscard]] std::optional<Unit> find_unit(std::string_view suffix);
[[nodiscard]] const std::array<Unit, 11>& all_units();  // in the order messages list them

}  // namespace scenec
