// Decoding UTF-8 one code point at a time, and showing it in a terminal. Invalid bytes are decoded
// one by one and marked, never skipped and never thrown at.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace scenec::utf8 {

struct CodePoint {
  std::uint32_t value = 0;  // of an invalid byte: the byte
  std::uint32_t size = 1;   // in bytes
  bool valid = false;
};

// The code point that starts at `at` (precondition: at < text.size()). Surrogates, overlong forms
// and values above U+10FFFF are invalid.
[[nodiscard]] CodePoint decode(std::string_view text, std::size_t at);

// Columns a terminal gives the code point: 0 (combining), 1 or 2 (East Asian wide, emoji).
[[nodiscard]] std::size_t display_width(std::uint32_t code_point);

// Appends `bytes` (which decode to `point`) as they are, or escaped when they could confuse a
// terminal or a reader: controls, bidirectional overrides, invisible marks, invalid bytes.
void append_visible(std::string& out, std::string_view bytes, CodePoint point);
// Whether append_visible() escapes it.
[[nodiscard]] bool needs_escape(CodePoint point);

}  // namespace scenec::utf8
