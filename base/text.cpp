#include "base/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <system_error>

#include "base/assert.hpp"
#include "base/utf8.hpp"

namespace scenec {

// ---- numbers ------------------------------------------------------------------------------------

std::string number_text(double value) {
  SCENEC_ASSERT(std::isfinite(value));
  std::array<char, 32> buffer;  // the shortest form of a double needs at most 24 characters
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  SCENEC_ASSERT(error == std::errc{});
  std::string text(buffer.data(), end);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string short_number_text(double value) {
  constexpr double largest_in_full = 1e12;
  const bool is_whole = std::abs(value) < largest_in_full && std::trunc(value) == value;
  return is_whole ? fmt::format("{:.0f}", value == 0 ? 0.0 : value) : fmt::format("{:.6g}", value);
}

namespace {

// The decimal exponent of the first digit that is not 0 of a well-formed number that is not 0.
std::int64_t leading_exponent(std::string_view number) {
  constexpr std::int64_t beyond_every_text = std::int64_t{1} << 40;
  const std::size_t e = number.find_first_of("eE");
  const std::string_view digits = number.substr(0, e);
  const std::size_t point = std::min(digits.find('.'), digits.size());
  const std::size_t first = digits.find_first_of("123456789");
  const auto place = static_cast<std::int64_t>(point) - static_cast<std::int64_t>(first);
  if (e == std::string_view::npos) return place;
  std::string_view written = number.substr(e + 1);
  if (written.starts_with('+')) written.remove_prefix(1);
  const std::int64_t saturated = written.starts_with('-') ? -beyond_every_text : beyond_every_text;
  return place + parse_int(written).value_or(saturated);
}

}  // namespace

namespace {

// Plain decimals of few digits: the digits as an integer and the power of ten are both exact
// doubles, so their quotient is correctly rounded (Clinger 1990). nullopt: any other text.
std::optional<double> short_decimal(std::string_view text) {
  constexpr std::size_t most_digits = 15;  // 10^15 < 2^53
  static constexpr std::array<double, most_digits + 1> powers_of_ten = {
      1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
  if (text.size() > most_digits + 1) return std::nullopt;
  std::uint64_t digits = 0;
  std::size_t point = text.size();
  for (std::size_t i = 0; i < text.size(); ++i) {
    const unsigned digit = static_cast<unsigned char>(text[i]) - unsigned{'0'};
    if (digit <= 9) {
      digits = 10 * digits + digit;
    } else if (text[i] == '.' && point == text.size() && i > 0 && i + 1 < text.size()) {
      point = i;
    } else {
      return std::nullopt;
    }
  }
  const std::size_t decimals = point == text.size() ? 0 : text.size() - point - 1;
  if (text.empty() || text.size() - (decimals == 0 ? 0 : 1) > most_digits) return std::nullopt;
  return static_cast<double>(digits) / powers_of_ten[decimals];
}

}  // namespace

std::optional<double> parse_double(std::string_view text) {
  if (const auto value = short_decimal(text)) return value;
  const char* const end = text.data() + text.size();
  double value = 0;
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (rest != end || text.empty()) return std::nullopt;
  if (error == std::errc::result_out_of_range) {
    // Too large and too small are reported alike; what is too small rounds to zero.
    if (leading_exponent(text) > 0) return std::nullopt;
    return text.front() == '-' ? -0.0 : 0.0;
  }
  if (error != std::errc{} || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<std::int64_t> parse_int(std::string_view text) {
  const char* const end = text.data() + text.size();
  std::int64_t value = 0;
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (rest != end || error != std::errc{} || text.empty()) return std::nullopt;
  return value;
}

// ---- names --------------------------------------------------------------------------------------

namespace {

constexpr std::size_t longest_compared_name = 64;  // longer words are no typing mistakes

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

// Optimal string alignment distance: insert, delete, replace and swap of neighbours cost one each.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  using Row = std::array<std::size_t, longest_compared_name + 1>;
  std::array<Row, 3> rows;  // of a's prefixes of length i - 2, i - 1 and i, by i % 3
  for (std::size_t j = 0; j <= b.size(); ++j) rows[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    Row& row = rows[i % 3];
    const Row& above = rows[(i + 2) % 3];
    const Row& two_above = rows[(i + 1) % 3];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = lower(a[i - 1]) == lower(b[j - 1]) ? 0 : 1;
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + change});
      const bool swapped = i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) &&
                           lower(a[i - 2]) == lower(b[j - 1]);
      if (swapped) row[j] = std::min(row[j], two_above[j - 2] + 1);
    }
  }
  return rows[a.size() % 3][b.size()];
}

}  // namespace

std::optional<std::string_view> nearest_name(std::string_view word,
                                             std::span<const std::string_view> candidates) {
  if (word.empty() || word.size() > longest_compared_name) return std::nullopt;
  std::optional<std::string_view> nearest;
  // A third of the letters may be wrong; below three letters, one.
  std::size_t bound = std::max<std::size_t>(word.size(), 3) / 3 + 1;
  for (const std::string_view candidate : candidates) {
    const std::size_t shorter = std::min(word.size(), candidate.size());
    const std::size_t longer = std::max(word.size(), candidate.size());
    if (longer > longest_compared_name || longer - shorter >= bound) continue;
    const std::size_t distance = edit_distance(word, candidate);
    // Something must be in common: `x` is not near `y`.
    if (distance >= bound || (distance != 0 && distance >= shorter)) continue;
    nearest = candidate;
    bound = distance;
  }
  return nearest;
}

std::string quoted_list(std::span<const std::string_view> names, std::size_t limit) {
  std::string text;
  const std::size_t shown = std::min(limit, names.size());
  for (std::size_t i = 0; i < shown; ++i) {
    if (i > 0) text += ", ";
    text += '`' + printable(names[i]) + '`';
  }
  if (shown < names.size()) {
    if (shown > 0) text += ' ';
    text += fmt::format("and {} more", names.size() - shown);
  }
  return text;
}

// ---- escapes ------------------------------------------------------------------------------------

std::string printable(std::string_view text, std::size_t limit) {
  std::string out;
  for (std::size_t at = 0, count = 0; at < text.size(); ++count) {
    if (count == limit) return out + "…";
    const utf8::CodePoint point = utf8::decode(text, at);
    utf8::append_visible(out, text.substr(at, point.size), point);
    at += point.size;
  }
  return out;
}

std::string quoted_string(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (c == '\n') {
      out += "\\n";
    } else if (c == '\t') {
      out += "\\t";
    } else if (byte < 0x20 || byte == 0x7f) {
      out += fmt::format("\\u{{{:x}}}", byte);
    } else {
      out += c;
    }
  }
  return out + '"';
}

// ---- UTF-8 --------------------------------------------------------------------------------------

namespace {

constexpr std::uint64_t every_byte(std::uint64_t byte) {
  return byte * 0x0101010101010101U;
}

std::uint64_t eight_bytes(const char* data) {
  std::uint64_t word = 0;
  std::memcpy(&word, data, sizeof word);
  return word;
}

}  // namespace

std::optional<std::size_t> find_invalid_utf8(std::string_view text) {
  std::size_t at = 0;
  while (at < text.size()) {
    if (text.size() - at >= 8 && (eight_bytes(text.data() + at) & every_byte(0x80)) == 0) {
      at += 8;
      continue;
    }
    const utf8::CodePoint point = utf8::decode(text, at);
    if (!point.valid) return at;
    at += point.size;
  }
  return std::nullopt;
}

std::size_t count_code_points(std::string_view text) {
  // Counts the bytes that do not continue a code point (10xxxxxx), eight at a time.
  std::size_t continuations = 0;
  std::size_t at = 0;
  for (; text.size() - at >= 8; at += 8) {
    const std::uint64_t word = eight_bytes(text.data() + at);
    const std::uint64_t marks = (word >> 7) & ~(word >> 6) & every_byte(1);
    continuations += (marks * every_byte(1)) >> 56;
  }
  for (; at < text.size(); ++at) {
    if ((static_cast<unsigned char>(text[at]) & 0xc0) == 0x80) ++continuations;
  }
  return text.size() - continuations;
}

}  // namespace scenec
