#include "base/utf8.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace scenec::utf8 {

namespace {

struct Range {
  std::uint32_t first;
  std::uint32_t last;
};

// The blocks of Unicode's East_Asian_Width=W/F and the emoji, merged coarsely: a caret that is off
// by one column under a rare sign is the worst that can happen.
constexpr std::array wide_ranges = {
    Range{0x1100, 0x115f},   Range{0x231a, 0x231b},   Range{0x2329, 0x232a},
    Range{0x23e9, 0x23ec},   Range{0x25fd, 0x25fe},   Range{0x2614, 0x2615},
    Range{0x2648, 0x2653},   Range{0x26a1, 0x26a1},   Range{0x26bd, 0x26be},
    Range{0x2705, 0x2705},   Range{0x2728, 0x2728},   Range{0x274c, 0x274c},
    Range{0x2753, 0x2755},   Range{0x2795, 0x2797},   Range{0x2b1b, 0x2b1c},
    Range{0x2b50, 0x2b50},   Range{0x2e80, 0x303e},   Range{0x3041, 0xa4cf},
    Range{0xa960, 0xa97f},   Range{0xac00, 0xd7a3},   Range{0xf900, 0xfaff},
    Range{0xfe30, 0xfe6f},   Range{0xff00, 0xff60},   Range{0xffe0, 0xffe6},
    Range{0x1f004, 0x1f004}, Range{0x1f0cf, 0x1f0cf}, Range{0x1f18e, 0x1f18e},
    Range{0x1f191, 0x1f19a}, Range{0x1f200, 0x1f320}, Range{0x1f32d, 0x1f64f},
    Range{0x1f680, 0x1f6ff}, Range{0x1f7e0, 0x1f7eb}, Range{0x1f90c, 0x1f9ff},
    Range{0x1fa70, 0x1faff}, Range{0x20000, 0x3fffd}};

constexpr std::array combining_ranges = {
    Range{0x0300, 0x036f}, Range{0x0483, 0x0489}, Range{0x0591, 0x05bd},   Range{0x0610, 0x061a},
    Range{0x064b, 0x065f}, Range{0x1ab0, 0x1aff}, Range{0x1dc0, 0x1dff},   Range{0x20d0, 0x20ff},
    Range{0xfe00, 0xfe0f}, Range{0xfe20, 0xfe2f}, Range{0x1f3fb, 0x1f3ff}, Range{0xe0100, 0xe01ef}};

// Signs that are not seen or change how their neighbours are seen.
constexpr std::array hidden_ranges = {
    Range{0x00ad, 0x00ad}, Range{0x061c, 0x061c}, Range{0x180e, 0x180e},
    Range{0x200b, 0x200f}, Range{0x2028, 0x202e}, Range{0x2060, 0x206f},
    Range{0xfeff, 0xfeff}, Range{0xfff9, 0xfffb}, Range{0xe0000, 0xe007f}};

template <std::size_t N>
bool holds(const std::array<Range, N>& ranges, std::uint32_t value) {
  const auto after = std::upper_bound(ranges.begin(), ranges.end(), value,
                                      [](std::uint32_t v, const Range& r) { return v < r.first; });
  return after != ranges.begin() && value <= std::prev(after)->last;
}

// The least value a sequence of 2, 3, 4 bytes may stand for; less is an overlong form.
constexpr std::array<std::uint32_t, 5> least_value = {0, 0, 0x80, 0x800, 0x10000};

std::uint32_t sequence_size(unsigned char lead) {
  if (lead < 0x80) return 1;
  if (lead >= 0xc2 && lead <= 0xdf) return 2;
  if (lead >= 0xe0 && lead <= 0xef) return 3;
  if (lead >= 0xf0 && lead <= 0xf4) return 4;
  return 0;
}

}  // namespace

CodePoint decode(std::string_view text, std::size_t at) {
  const auto byte_at = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte_at(at);
  if (lead < 0x80) return {lead, 1, true};
  const CodePoint invalid{lead, 1, false};
  const std::uint32_t size = sequence_size(lead);
  if (size == 0 || text.size() - at < size) return invalid;
  std::uint32_t value = lead & (0x7fU >> size);
  for (std::size_t i = 1; i < size; ++i) {
    const unsigned char next = byte_at(at + i);
    if ((next & 0xc0) != 0x80) return invalid;
    value = value << 6 | (next & 0x3fU);
  }
  const bool surrogate = value >= 0xd800 && value <= 0xdfff;
  if (value < least_value[size] || value > 0x10ffff || surrogate) return invalid;
  return {value, size, true};
}

std::size_t display_width(std::uint32_t code_point) {
  if (code_point < 0x300) return 1;
  if (holds(combining_ranges, code_point)) return 0;
  return holds(wide_ranges, code_point) ? 2 : 1;
}

bool needs_escape(CodePoint point) {
  if (!point.valid) return true;
  if (point.value < 0x20 || (point.value >= 0x7f && point.value < 0xa0)) return true;
  return point.value >= 0xa0 && holds(hidden_ranges, point.value);
}

void append_visible(std::string& out, std::string_view bytes, CodePoint point) {
  if (!needs_escape(point)) {
    out += bytes;
  } else if (!point.valid) {
    out += fmt::format("\\x{:02x}", point.value);
  } else if (point.value == '\n') {
    out += "\\n";
  } else if (point.value == '\t') {
    out += "\\t";
  } else {
    out += fmt::format("\\u{{{:x}}}", point.value);
  }
}

}  // namespace scenec::utf8
