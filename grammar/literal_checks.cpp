// Reports about literals and operators that are taken as they stand; see recovery.hpp.
#include <fmt/format.h>

#include <string>

#include "base/text.hpp"
#include "base/units.hpp"
#include "grammar/recovery.hpp"
#include "grammar/scan.hpp"

namespace scenec::grammar {

namespace {

// End of the escape behind a backslash, 0 when it is none of the language's.
std::uint32_t escape_end(std::string_view text, std::uint32_t offset, std::uint32_t end) {
  const char c = scan::at(text, offset);
  if (c == '"' || c == '\\' || c == 'n' || c == 't') return offset + 1;
  if (c != 'u' || scan::at(text, offset + 1) != '{') return 0;
  std::uint32_t code = 0;
  std::uint32_t place = offset + 2;
  for (; place < end && place < offset + 8 && scan::is(text[place], scan::hex); ++place) {
    const char h = text[place];
    code = code * 16 + static_cast<std::uint32_t>(h <= '9' ? h - '0' : (h | 0x20) - 'a' + 10);
  }
  const bool scalar = code <= 0x10FFFF && (code < 0xD800 || code > 0xDFFF);
  return place > offset + 2 && scan::at(text, place) == '}' && scalar ? place + 1 : 0;
}

}  // namespace

void check_string(TreeBuilder& builder, std::uint32_t begin, std::uint32_t end) {
  const std::string_view text = builder.text();
  bool closed = false;
  for (std::uint32_t place = begin + 1; place < end;) {
    if (text[place] == '"') {
      closed = true;
      break;
    }
    if (text[place++] != '\\') continue;
    const std::uint32_t next = escape_end(text, place, end);
    if (next == 0 && place < end) {
      builder.report(place,
                     Diagnostic(DiagnosticKind::escape_unknown, builder.span(place - 1, place + 1),
                                "unknown escape in a string")
                         .hint("the escapes are `\\\"`, `\\\\`, `\\n`, `\\t` and `\\u{1F600}`"));
    }
    place = next == 0 ? (place < end ? place + 1 : end) : next;
  }
  if (closed) return;
  builder.report(
      end,
      Diagnostic(DiagnosticKind::string_unclosed, builder.span(begin, begin + 1),
                 "this string is never closed")
          .note("the line ends here", builder.span(end, end))
          .hint("a string ends on the line where it begins; write `\\n` for a line end in it"));
  builder.forgive_after(end);
}

void check_edition(TreeBuilder& builder, std::uint32_t begin, std::uint32_t end) {
  const std::string_view number = builder.text().substr(begin, end - begin);
  if (number == "1") return;
  builder.report(Diagnostic(DiagnosticKind::edition_unknown, builder.span(begin, end),
                            fmt::format("this compiler knows edition 1, not {}",
                                        scan::found(builder.text(), begin)))
                     .fix(builder.span(begin, end), "1"));
}

void report_bare_fraction(TreeBuilder& builder, std::uint32_t begin, std::uint32_t end) {
  builder.report(begin, Diagnostic(DiagnosticKind::leading_digit_missing, builder.span(begin, end),
                                   "a number needs a digit before its point")
                            .fix(builder.span(begin, begin), "0"));
  builder.error_node(begin, end);
}

void report_bad_color(TreeBuilder& builder, std::uint32_t begin, std::uint32_t end) {
  builder.report(
      begin,
      Diagnostic(DiagnosticKind::color_malformed, builder.span(begin, end),
                 fmt::format("{} is no colour: expected `#rgb` or `#rrggbb` in hexadecimal digits",
                             scan::found(builder.text(), begin))));
  builder.error_node(begin, end);
}

void report_colon_for_equals(TreeBuilder& builder, std::uint32_t colon) {
  const SyntaxNode name = builder.last_token();
  builder.report(
      colon, Diagnostic(DiagnosticKind::colon_for_equals, builder.span(colon, colon + 1),
                        fmt::format("use `=` to set {}", scan::found(builder.text(), name.begin)))
                 .fix(builder.span(colon, colon + 1), " ="));
}

void report_touching_percent(TreeBuilder& builder, std::uint32_t percent) {
  const SyntaxNode number = builder.last_token();
  if (number.kind != SyntaxKind::number || number.end != percent) return;
  builder.report(
      percent,
      Diagnostic(DiagnosticKind::percent_touches_number, builder.span(percent, percent + 1),
                 "a `%` that touches a number is its unit; for the remainder write blanks round it")
          .fix(builder.span(percent, percent + 1), " % "));
}

void report_chained_comparison(TreeBuilder& builder, std::uint32_t begin, std::uint32_t end) {
  if (builder.last_kind() != SyntaxKind::comparison) return;  // once a chain
  builder.report(begin, Diagnostic(DiagnosticKind::comparison_chained, builder.span(begin, end),
                                   "comparisons do not chain")
                            .hint("write `a < b && b < c`"));
}

bool is_detached_unit(TreeBuilder& builder, std::uint32_t offset) {
  const std::string_view text = builder.text();
  const SyntaxNode number = builder.last_token();
  const char last = text[number.end - 1];
  if (number.kind != SyntaxKind::number || number.end == offset || !scan::is(last, scan::digit))
    return false;
  if (text.substr(number.end, offset - number.end).find_first_not_of(" \t") !=
      std::string_view::npos)
    return false;
  const std::size_t end = scan::name_end(text, offset);
  if (!find_unit(text.substr(offset, end - offset))) return false;
  const char next = scan::at(text, scan::skip_trivia(text, end));
  return next != '=' && next != '{' && next != '(' && next != ':' && next != '.';
}

void report_detached_unit(TreeBuilder& builder, std::uint32_t begin, std::uint32_t end) {
  const SyntaxNode number = builder.last_token();
  const std::string_view text = builder.text();
  builder.report(
      begin,
      Diagnostic(DiagnosticKind::unit_detached, builder.span(number.end, end),
                 fmt::format("a unit is glued to its number: `{}{}`",
                             printable(text.substr(number.begin, number.end - number.begin), 40),
                             text.substr(begin, end - begin)))
          .fix(builder.span(number.end, begin), ""));
  builder.error_node(begin, end);
}

}  // namespace scenec::grammar
