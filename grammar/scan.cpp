#include "grammar/scan.hpp"

#include <algorithm>

#include "base/text.hpp"

namespace scenec::grammar::scan {

namespace {

constexpr std::array<std::string_view, 17> item_keywords = {
    "assert", "camera", "fn",       "for",   "group", "if",     "include", "instance", "let",
    "light",  "macro",  "material", "param", "proto", "render", "sdl",     "else"};
constexpr std::array<std::string_view, 4> other_reserved = {"as", "in", "true", "false"};

// Every name of a text is asked for, so few words are looked at: those with its first letter.
constexpr auto reserved_by_letter = [] {
  std::array<std::array<std::string_view, 4>, 26> table;
  const auto add = [&](std::string_view word) {
    auto& words = table[static_cast<std::size_t>(word.front() - 'a')];
    std::size_t place = 0;
    while (!words[place].empty()) ++place;
    words[place] = word;
  };
  for (std::string_view word : item_keywords) add(word);
  for (std::string_view word : other_reserved) add(word);
  return table;
}();

template <std::size_t N>
bool contains(const std::array<std::string_view, N>& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

std::size_t string_end(std::string_view text, std::size_t offset) {
  for (std::size_t at_byte = offset + 1; at_byte < text.size(); ++at_byte) {
    if (is_line_end(text[at_byte])) return at_byte;
    if (text[at_byte] == '"') return at_byte + 1;
    if (text[at_byte] == '\\' && at_byte + 1 < text.size() && !is_line_end(text[at_byte + 1]))
      ++at_byte;
  }
  return text.size();
}

std::size_t numeral_end(std::string_view text, std::size_t offset) {
  while (is(at(text, offset), digit)) ++offset;
  if (at(text, offset) == '.' && is(at(text, offset + 1), digit)) {
    ++offset;
    while (is(at(text, offset), digit)) ++offset;
  }
  if (at(text, offset) == 'e') {
    const std::size_t sign = at(text, offset + 1) == '+' || at(text, offset + 1) == '-' ? 1 : 0;
    if (is(at(text, offset + 1 + sign), digit)) offset += 1 + sign;
  }
  return at(text, offset) == '%' ? offset + 1 : name_end(text, offset);
}

std::size_t code_point_end(std::string_view text, std::size_t offset) {
  const bool leads = static_cast<unsigned char>(text[offset++]) >= 0xC0;
  while (leads && offset < text.size() &&
         (static_cast<unsigned char>(text[offset]) & 0xC0u) == 0x80u)
    ++offset;
  return offset;
}

}  // namespace

bool is_item_keyword(std::string_view word) {
  return word != "else" && contains(item_keywords, word);
}

bool is_reserved(std::string_view word) {
  const unsigned letter =
      word.empty() ? 0u : static_cast<unsigned char>(word.front()) - unsigned{'a'};
  if (letter >= reserved_by_letter.size()) return false;
  for (std::string_view reserved : reserved_by_letter[letter]) {
    if (reserved == word && !word.empty()) return true;
  }
  return false;
}

std::size_t comment_end(std::string_view text, std::size_t offset) {
  if (at(text, offset + 1) == '*') {
    const std::size_t close = text.find("*/", offset + 2);
    return close == std::string_view::npos ? close : close + 2;
  }
  const std::size_t line_end = text.find_first_of("\r\n", offset);
  return line_end == std::string_view::npos ? text.size() : line_end;
}

std::size_t skip_trivia(std::string_view text, std::size_t offset) {
  while (offset < text.size()) {
    if (is(text[offset], blank)) {
      ++offset;
    } else if (text[offset] == '/' &&
               (at(text, offset + 1) == '/' || at(text, offset + 1) == '*')) {
      offset = std::min(comment_end(text, offset), text.size());
    } else {
      break;
    }
  }
  return offset;
}

std::size_t token_end(std::string_view text, std::size_t offset) {
  if (offset >= text.size()) return text.size();
  const char first = text[offset];
  if (is(first, name_first)) return name_end(text, offset);
  if (is(first, digit)) return numeral_end(text, offset);
  if (first == '"') return string_end(text, offset);
  if (first == '#') return name_end(text, offset + 1);
  const std::string_view three = text.substr(offset, 3);
  if (three == "..<") return offset + 3;
  const std::string_view two = three.substr(0, 2);
  for (std::string_view mark : {"..", "||", "&&", "==", "!=", "<=", ">="}) {
    if (two == mark) return offset + 2;
  }
  return code_point_end(text, offset);
}

bool begins_line(std::string_view text, std::size_t offset) {
  while (offset > 0 && (text[offset - 1] == ' ' || text[offset - 1] == '\t')) --offset;
  return offset == 0 || is_line_end(text[offset - 1]);
}

ItemStart item_start(std::string_view text, std::size_t offset) {
  if (at(text, offset) == '@') return ItemStart::strong;
  if (!is(at(text, offset), name_first)) return ItemStart::none;
  const std::size_t word_end = name_end(text, offset);
  const std::string_view word = text.substr(offset, word_end - offset);
  std::size_t next = skip_trivia(text, word_end);
  const bool assigned = at(text, next) == '=' && at(text, next + 1) != '=';
  if (assigned) return ItemStart::weak;
  if (is_reserved(word)) return is_item_keyword(word) ? ItemStart::strong : ItemStart::none;
  if (at(text, next) == '{') return ItemStart::strong;
  if (at(text, next) == '(' || at(text, next) == ':') return ItemStart::weak;
  const bool dotted = at(text, next) == '.' && at(text, next + 1) != '.';
  if (dotted) next = skip_trivia(text, next + 1);
  if (!is(at(text, next), name_first)) return ItemStart::none;
  next = skip_trivia(text, name_end(text, next));
  if (dotted) return at(text, next) == '(' ? ItemStart::weak : ItemStart::none;
  return at(text, next) == '{' ? ItemStart::strong : ItemStart::none;
}

std::string found(std::string_view text, std::size_t offset) {
  if (offset >= text.size()) return "the end of the file";
  if (text[offset] == '"') return "a string";
  return "`" + printable(text.substr(offset, token_end(text, offset) - offset), 40) + "`";
}

}  // namespace scenec::grammar::scan
