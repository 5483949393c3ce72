// Plain scanning of native text, without the grammar: blanks and comments, raw tokens, reserved
// words, and the question "does an item begin here?". Recovery and lookahead stand on it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace scenec::grammar::scan {

enum CharClass : std::uint8_t { blank = 1, name_first = 2, name_rest = 4, digit = 8, hex = 16 };

inline constexpr std::array<std::uint8_t, 256> char_classes = [] {
  std::array<std::uint8_t, 256> table{};
  for (char c : {' ', '\t', '\n', '\r'}) table[static_cast<unsigned char>(c)] = blank;
  for (unsigned c = 'a'; c <= 'z'; ++c) table[c] = table[c - 'a' + 'A'] = name_first | name_rest;
  table['_'] = name_first | name_rest;
  for (unsigned c = '0'; c <= '9'; ++c) table[c] = digit | hex | name_rest;
  for (unsigned c = 'a'; c <= 'f'; ++c) {
    table[c] |= hex;
    table[c - 'a' + 'A'] |= hex;
  }
  return table;
}();
[[nodiscard]] constexpr bool is(char c, unsigned classes) {
  return (char_classes[static_cast<unsigned char>(c)] & classes) != 0;
}
[[nodiscard]] constexpr bool is_line_end(char c) {
  return c == '\n' || c == '\r';
}
// The character at an offset; NUL behind the end.
[[nodiscard]] constexpr char at(std::string_view text, std::size_t offset) {
  return offset < text.size() ? text[offset] : '\0';
}

// True for the reserved words of the language.
[[nodiscard]] bool is_reserved(std::string_view word);
// True for the reserved words that begin an item.
[[nodiscard]] bool is_item_keyword(std::string_view word);

[[nodiscard]] constexpr std::size_t name_end(std::string_view text, std::size_t offset) {
  while (offset < text.size() && is(text[offset], name_rest)) ++offset;
  return offset;
}
// End of the comment that starts at `offset`; npos for a block comment that is never closed.
[[nodiscard]] std::size_t comment_end(std::string_view text, std::size_t offset);
// First offset that is neither blank nor in a comment (an unclosed comment reaches to the end).
[[nodiscard]] std::size_t skip_trivia(std::string_view text, std::size_t offset);
// End of the raw token at `offset`: a word, a numeral, a string (at most to the end of its line), a
// mark, or one code point of anything else. Always beyond `offset` unless that is the end.
[[nodiscard]] std::size_t token_end(std::string_view text, std::size_t offset);
// Only blanks stand between the start of the line and `offset`.
[[nodiscard]] bool begins_line(std::string_view text, std::size_t offset);

enum class ItemStart : std::uint8_t {
  none,
  weak,    // `name =`, `name (`, `name :`: could also be part of an argument list
  strong,  // a keyword of an item, `name {`, `name name {`, `@`
};
[[nodiscard]] ItemStart item_start(std::string_view text, std::size_t offset);

// How messages call what stands at `offset`: "`radius`", "a string", "the end of the file".
[[nodiscard]] std::string found(std::string_view text, std::size_t offset);

}  // namespace scenec::grammar::scan
