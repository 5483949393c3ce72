// Small text services: exact number printing and parsing, nearest name, UTF-8.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace scenec {

// The shortest text that reads back to the same double, as a language numeral: always with a `.`
// or an exponent ("1.0", "0.1", "1e-07"), never inf or nan (precondition: finite).
[[nodiscard]] std::string number_text(double value);
// For people: six significant digits, no trailing zeros; whole numbers below 1e12 in full.
[[nodiscard]] std::string short_number_text(double value);
// Correctly rounded, locale-free; subnormals accepted, overflow and rest text give nullopt.
[[nodiscard]] std::optional<double> parse_double(std::string_view text);
[[nodiscard]] std::optional<std::int64_t> parse_int(std::string_view text);

// The candidate nearest to `word` by edit distance (case-insensitive, transpositions count one), or
// nullopt when none is near enough to be a plausible typing mistake.
[[nodiscard]] std::optional<std::string_view> nearest_name(
    std::string_view word, std::span<const std::string_view> candidates);
// "a, b, c" with back quotes round each; at most `limit` names, then "and 7 more".
[[nodiscard]] std::string quoted_list(std::span<const std::string_view> names,
                                      std::size_t limit = 24);
// `text` with control characters escaped and cut to `limit` code points (…): safe in a message.
[[nodiscard]] std::string printable(std::string_view text, std::size_t limit = 80);
// The string in double quotes with the language's escapes.
[[nodiscard]] std::string quoted_string(std::string_view text);

// Offset of the first byte that is not valid UTF-8 (surrogates, overlong forms and values above
// U+10FFFF are not), or nullopt.
[[nodiscard]] std::optional<std::size_t> find_invalid_utf8(std::string_view text);
[[nodiscard]] std::size_t count_code_points(std::string_view text);

}  // namespace scenec
