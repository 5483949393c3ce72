#include "runtime/option_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <vector>

#include "base/text.hpp"
#include "ir/verify.hpp"

namespace scenec::runtime {

namespace {

constexpr std::int64_t largest_side = 65535;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

std::optional<std::int64_t> find_whole_number(std::string_view text) {
  if (text.empty() || !std::all_of(text.begin(), text.end(), is_digit)) return std::nullopt;
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t at = text.find(separator);
    parts.push_back(text.substr(0, at));
    if (at == std::string_view::npos) return parts;
    text.remove_prefix(at + 1);
  }
}

struct DurationUnit {
  std::string_view suffix;
  double seconds;
};
// Longest suffix first: `ms` must not be read as `s`.
constexpr std::array duration_units{DurationUnit{"min", 60}, DurationUnit{"ms", 1e-3},
                                    DurationUnit{"s", 1}, DurationUnit{"h", 3600}};

}  // namespace

Parsed<std::int64_t> parse_whole_number(std::string_view text, std::int64_t low,
                                        std::int64_t high) {
  const std::optional<std::int64_t> value = find_whole_number(text);
  if (value && *value >= low && *value <= high) return *value;
  return Failure{fmt::format("a whole number from {} to {}, written in plain digits", low, high)};
}

Parsed<ir::ImageSize> parse_size(std::string_view text) {
  const std::string expected =
      fmt::format("WIDTHxHEIGHT such as `640x480`, each side from 1 to {}", largest_side);
  const std::vector<std::string_view> sides = split(text, 'x');
  if (sides.size() != 2) return Failure{expected};
  const std::optional<std::int64_t> width = find_whole_number(sides[0]);
  const std::optional<std::int64_t> height = find_whole_number(sides[1]);
  const auto is_side = [](const std::optional<std::int64_t>& side) {
    return side && *side >= 1 && *side <= largest_side;
  };
  if (!is_side(width) || !is_side(height)) return Failure{expected};
  if (*width * *height > ir::largest_pixel_count) {
    return Failure{fmt::format("at most {} pixels in all", ir::largest_pixel_count)};
  }
  return ir::ImageSize{*width, *height};
}

Parsed<ir::Region> parse_region(std::string_view text) {
  const std::string expected =
      "x0,y0,x1,y1 in pixels from the top left, with x0 < x1 and y0 < y1, such as `0,0,320,240`";
  const std::vector<std::string_view> parts = split(text, ',');
  if (parts.size() != 4) return Failure{expected};
  std::array<std::int64_t, 4> corner{};
  for (std::size_t i = 0; i < corner.size(); ++i) {
    const std::optional<std::int64_t> value = find_whole_number(parts[i]);
    if (!value || *value > largest_side) return Failure{expected};
    corner[i] = *value;
  }
  if (corner[0] >= corner[2] || corner[1] >= corner[3]) return Failure{expected};
  return ir::Region{corner[0], corner[1], corner[2], corner[3]};
}

Parsed<double> parse_share(std::string_view text) {
  const bool is_percentage = text.ends_with('%');
  if (is_percentage) text.remove_suffix(1);
  const std::optional<double> value =
      text.empty() || !is_digit(text.front()) ? std::nullopt : parse_double(text);
  if (!value || !(*value > 0)) return Failure{std::string("a number above zero: `1%` or `0.01`")};
  return is_percentage ? *value / 100 : *value;
}

Parsed<Time> parse_duration(std::string_view text) {
  const std::string expected = "a time above zero with its unit: `500ms`, `30s`, `2min` or `1.5h`";
  for (const DurationUnit& unit : duration_units) {
    if (!text.ends_with(unit.suffix)) continue;
    const std::string_view number = text.substr(0, text.size() - unit.suffix.size());
    if (number.empty() || !is_digit(number.front())) return Failure{expected};
    const std::optional<double> value = parse_double(number);
    if (!value || !(*value > 0)) return Failure{expected};
    return Time{*value * unit.seconds};
  }
  return Failure{expected};
}

Parsed<std::uint64_t> parse_byte_count(std::string_view text) {
  constexpr std::int64_t most_bytes = std::int64_t{1} << 50;
  constexpr std::pair<std::string_view, int> units[] = {
      {"KiB", 10}, {"MiB", 20}, {"GiB", 30}, {"TiB", 40}, {"B", 0}};
  for (const auto& [suffix, shift] : units) {
    if (!text.ends_with(suffix)) continue;
    const auto count =
        parse_whole_number(text.substr(0, text.size() - suffix.size()), 1, most_bytes >> shift);
    if (count) return static_cast<std::uint64_t>(count.value()) << shift;
    break;
  }
  return Failure{std::string("a number of bytes with its unit: `500MiB` or `2GiB`")};
}

Parsed<NameAndValue> parse_setting(std::string_view text) {
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == std::string_view::npos) {
    return Failure{std::string("NAME=VALUE such as `count=9`")};
  }
  return NameAndValue{std::string(text.substr(0, equals)), std::string(text.substr(equals + 1))};
}

}  // namespace scenec::runtime
