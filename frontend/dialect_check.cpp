#include "frontend/dialect_check.hpp"

#include "frontend/course/words.hpp"
#include "grammar/scan.hpp"
#include "ir/describe.hpp"

namespace scenec::frontend {

namespace {

namespace scan = grammar::scan;

struct Opening {
  std::uint32_t begin = 0;
  std::string_view word;
  char next = '\0';  // what follows it
};

// Comments are those of native text: `#` ones, which only course files have, end the search.
Opening opening_of(std::string_view text) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  const std::size_t start = text.starts_with(byte_order_mark) ? byte_order_mark.size() : 0;
  const std::size_t begin = scan::skip_trivia(text, start);
  if (!scan::is(scan::at(text, begin), scan::name_first)) return {};
  const std::size_t end = scan::name_end(text, begin);
  return {static_cast<std::uint32_t>(begin), text.substr(begin, end - begin),
          scan::at(text, scan::skip_trivia(text, end))};
}

bool begins_native(const Opening& opening) {
  if (scan::is_item_keyword(opening.word)) return true;
  for (const std::string_view shape : ir::kind_names("shape")) {
    if (opening.word == shape) return opening.next == '{';
  }
  return false;
}

}  // namespace

std::optional<Diagnostic> find_wrong_dialect(FileId file, std::string_view text,
                                             grammar::Dialect dialect) {
  const Opening opening = opening_of(text);
  if (opening.word.empty()) return std::nullopt;
  const Span span{file, opening.begin,
                  opening.begin + static_cast<std::uint32_t>(opening.word.size())};
  const bool is_course = course::find_word(course::Place::file, opening.word) != nullptr;
  if (dialect == grammar::Dialect::sdl && is_course && opening.next == '{') {
    return Diagnostic(DiagnosticKind::edition_missing, span,
                      "this is a scene in the course format, in a file read as `sdl`")
        .hint("`--dialect course` reads it, and so does a name that ends in `.txt`");
  }
  if (dialect == grammar::Dialect::course && !is_course && begins_native(opening)) {
    return Diagnostic(DiagnosticKind::edition_missing, span,
                      "this is a scene in the native language, in a file read as course format")
        .hint("begin it with `sdl 1;`, or give it a name that ends in `.sdl`");
  }
  return std::nullopt;
}

}  // namespace scenec::frontend
