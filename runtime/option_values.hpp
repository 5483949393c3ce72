// Reading the values of command-line options. Each function gives the value or what the value would
// have had to be ("a whole number from 1 to 64"); nothing is rounded, wrapped or cut.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/result.hpp"
#include "base/units.hpp"
#include "ir/render_settings.hpp"

namespace scenec::runtime {

template <class T>
using Parsed = Result<T, std::string>;

// Plain decimal digits only: no sign, exponent, blanks or separators.
[[nodiscard]] Parsed<std::int64_t> parse_whole_number(std::string_view text, std::int64_t low,
                                                      std::int64_t high);
// `WxH`, each side from 1 to 65535, at most 2^28 pixels.
[[nodiscard]] Parsed<ir::ImageSize> parse_size(std::string_view text);
// `x0,y0,x1,y1` in pixels from the top left, x0 < x1 and y0 < y1.
[[nodiscard]] Parsed<ir::Region> parse_region(std::string_view text);
// A number above zero, `0.01`, or as a percentage, `1%`.
[[nodiscard]] Parsed<double> parse_share(std::string_view text);
// A number with its unit glued on: `500ms 30s 2min 1.5h`; above zero.
[[nodiscard]] Parsed<Time> parse_duration(std::string_view text);

// Bytes with their unit glued on: `500MiB`, `2GiB`, `64KiB`, `1048576B`; whole and above zero.
[[nodiscard]] Parsed<std::uint64_t> parse_byte_count(std::string_view text);

struct NameAndValue {
  std::string name;
  std::string value;
};
// `name=value`; the value may be empty and may hold further `=`.
[[nodiscard]] Parsed<NameAndValue> parse_setting(std::string_view text);

}  // namespace scenec::runtime
