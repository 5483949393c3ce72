#include "grammar/text_checks.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "base/text.hpp"
#include "grammar/scan.hpp"

namespace scenec::grammar {

namespace {

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

bool is_bidi_control(std::string_view text, std::size_t offset) {
  const std::string_view three = text.substr(offset, 3);
  if (three.starts_with("\xD8\x9C")) return true;  // U+061C
  if (three.size() < 3 || three[0] != '\xE2') return false;
  const unsigned second = static_cast<unsigned char>(three[1]);
  const unsigned third = static_cast<unsigned char>(three[2]);
  const bool marks = second == 0x80 && (third == 0x8E || third == 0x8F);     // U+200E, U+200F
  const bool embeddings = second == 0x80 && third >= 0xAA && third <= 0xAE;  // U+202A .. U+202E
  const bool isolates = second == 0x81 && third >= 0xA6 && third <= 0xA9;    // U+2066 .. U+2069
  return marks || embeddings || isolates;
}

// Eight bytes are all printable ASCII: no byte below 0x20, none with the high bit, none 0x7F.
bool all_plain(std::uint64_t bytes) {
  constexpr std::uint64_t high = 0x8080808080808080u;
  constexpr std::uint64_t ones = 0x0101010101010101u;
  const std::uint64_t below_blank = (bytes - ones * 0x20u) & ~bytes;
  const std::uint64_t deleted = ((bytes ^ (ones * 0x7Fu)) - ones) & ~(bytes ^ (ones * 0x7Fu));
  return ((bytes | below_blank | deleted) & high) == 0;
}

}  // namespace

CharacterFaults character_faults(std::string_view text, Dialect dialect) {
  CharacterFaults faults;
  bool ascii = true;
  for (std::size_t i = 0; i < text.size();) {
    if (i + 8 <= text.size()) {
      std::uint64_t bytes = 0;
      std::memcpy(&bytes, text.data() + i, 8);
      if (all_plain(bytes)) {
        i += 8;
        continue;
      }
    }
    const unsigned char c = static_cast<unsigned char>(text[i]);
    if (c >= 0x80) {
      ascii = false;
      if ((c == 0xE2 || c == 0xD8) && is_bidi_control(text, i)) faults.bidi_controls.push_back(i);
    } else if ((c < 0x20 && c != '\t' && c != '\n' && c != '\r') || c == 0x7F) {
      const bool blank = dialect == Dialect::course && (c == '\v' || c == '\f');
      if (!blank && faults.first_control == CharacterFaults::none) faults.first_control = i;
    }
    ++i;
  }
  if (!ascii) faults.first_invalid = find_invalid_utf8(text).value_or(CharacterFaults::none);
  return faults;
}

std::size_t skip_course_trivia(std::string_view text, std::size_t offset) {
  if (offset == 0 && text.starts_with(byte_order_mark)) offset = byte_order_mark.size();
  while (offset < text.size()) {
    if (is_course_blank(text[offset])) {
      ++offset;
    } else if (text[offset] == '#' || (text[offset] == '/' && scan::at(text, offset + 1) == '/')) {
      const std::size_t line_end = text.find_first_of("\r\n", offset);
      offset = std::min(line_end, text.size());
    } else {
      break;
    }
  }
  return offset;
}

Dialect dialect_of(std::string_view path, std::string_view text) {
  const std::size_t dot = path.rfind('.');
  const std::string_view extension =
      dot == std::string_view::npos ? std::string_view{} : path.substr(dot);
  const auto same = [](char a, char b) { return (a | 0x20) == b; };
  if (extension.size() == 4 && std::equal(extension.begin() + 1, extension.end(), "sdl", same))
    return Dialect::sdl;
  std::size_t place = text.starts_with(byte_order_mark) ? byte_order_mark.size() : 0;
  place = scan::skip_trivia(text, place);
  if (text.substr(place, scan::token_end(text, place) - place) != "sdl") return Dialect::course;
  place = scan::skip_trivia(text, place + 3);
  if (!scan::is(scan::at(text, place), scan::digit)) return Dialect::course;
  place = scan::skip_trivia(text, scan::token_end(text, place));
  return scan::at(text, place) == ';' ? Dialect::sdl : Dialect::course;
}

}  // namespace scenec::grammar
