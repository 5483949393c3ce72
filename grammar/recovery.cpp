#include "grammar/recovery.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "base/text.hpp"
#include "grammar/scan.hpp"

namespace scenec::grammar {

namespace {

using scan::ItemStart;

// The place where reading failed, seen from both sides.
struct Place {
  TreeBuilder& builder;
  std::string_view text;
  std::uint32_t offset;  // of the token that does not fit
  std::uint32_t end;     // of that token
  std::uint32_t before;  // end of the token before it

  Place(TreeBuilder& of, std::uint32_t where)
      : builder(of),
        text(of.text()),
        offset(where),
        end(static_cast<std::uint32_t>(scan::token_end(of.text(), where))),
        before(of.last_end()) {}

  [[nodiscard]] char next() const { return scan::at(text, offset); }
  [[nodiscard]] bool at_end() const { return offset >= text.size(); }
  [[nodiscard]] std::string_view word() const { return text.substr(offset, end - offset); }
  [[nodiscard]] Span span() const { return builder.span(offset, end); }
  [[nodiscard]] bool is_any_of(std::string_view marks) const {
    return !at_end() && marks.find(next()) != std::string_view::npos && end == offset + 1;
  }
  [[nodiscard]] bool begins_line() const { return scan::begins_line(text, offset); }
  [[nodiscard]] bool begins_operand() const {
    return scan::is(next(), scan::name_first | scan::digit) || is_any_of("\"([#") || next() == '"';
  }
};

std::string after(TreeBuilder& builder) {
  const SyntaxNode last = builder.last_token();
  if (last.next == 0) return {};
  const std::string_view token = builder.text().substr(last.begin, last.end - last.begin);
  return token.starts_with('"') ? " after a string" : " after `" + printable(token, 40) + "`";
}

bool is_unknown_character(const Place& place) {
  if (place.at_end()) return false;
  const unsigned char c = static_cast<unsigned char>(place.next());
  return c >= 0x80 ||
         std::string_view("$&'?\\^`|~").find(static_cast<char>(c)) != std::string_view::npos;
}

bool is_bidi_or_mark(const Place& place) {
  const std::string_view word = place.word();
  return word.starts_with("\xE2\x80") || word.starts_with("\xE2\x81") || word == "\xD8\x9C";
}

Diagnostic unexpected(const Place& place, std::string_view what) {
  return Diagnostic(DiagnosticKind::unexpected_text, place.span(),
                    fmt::format("expected {}{}, found {}", what, after(place.builder),
                                scan::found(place.text, place.offset)));
}

[[noreturn]] void give_up(const Place& place, Diagnostic diagnostic) {
  const bool single_mark =
      place.end - place.offset == 1 || static_cast<unsigned char>(place.next()) >= 0x80;
  if (is_unknown_character(place) && single_mark) {
    // Direction marks were reported with the other characters before parsing began.
    if (!is_bidi_or_mark(place)) {
      place.builder.report(
          place.offset,
          Diagnostic(DiagnosticKind::unknown_character, place.span(),
                     fmt::format("unknown character {}", scan::found(place.text, place.offset))));
    }
  } else if (place.is_any_of(")]")) {
    place.builder.report(
        place.offset,
        Diagnostic(DiagnosticKind::closer_stray, place.span(),
                   fmt::format("{} closes nothing", scan::found(place.text, place.offset))));
  } else {
    place.builder.report(place.offset, std::move(diagnostic));
  }
  throw BrokenStatement{place.offset};
}
[[noreturn]] void give_up(const Place& place, std::string_view what) {
  give_up(place, unexpected(place, what));
}

// Takes the token that does not fit for the one that was meant.
std::uint32_t take_for(const Place& place, SyntaxKind kind) {
  place.builder.token(kind, place.offset, place.end);
  return place.builder.skip_trivia(place.end);
}
std::uint32_t take_as_error(const Place& place) {
  place.builder.error_node(place.offset, place.end);
  return place.builder.skip_trivia(place.end);
}

std::uint32_t missing_semicolon(const Place& place) {
  TreeBuilder& builder = place.builder;
  if (builder.is_forgiven(place.before)) return place.offset;
  const bool ends = place.at_end() || place.next() == '}' ||
                    scan::item_start(place.text, place.offset) != ItemStart::none;
  // The end of the file inside a block: the brace that is not closed is the mistake to tell.
  if (place.at_end() && !builder.openers().empty()) return place.offset;
  if (ends || (place.begins_line() && !is_unknown_character(place) && !place.is_any_of(")]"))) {
    const Span where = builder.span(place.before, place.before);
    Diagnostic diagnostic = Diagnostic(DiagnosticKind::semicolon_missing, where,
                                       fmt::format("expected `;`{}, found {}", after(builder),
                                                   scan::found(place.text, place.offset)))
                                .fix(where, ";");
    // A `}` without a block is a mistake of its own.
    if (place.next() == '}' && builder.openers().empty()) {
      builder.report(std::move(diagnostic));
    } else {
      builder.report(place.offset, std::move(diagnostic));
    }
    return place.offset;
  }
  Diagnostic diagnostic = unexpected(place, "`;`");
  if (scan::at(place.text, place.before - 1) == '%') {
    diagnostic.hints.push_back(
        "a `%` that touches a number is its unit; write blanks round it for the remainder");
  }
  give_up(place, std::move(diagnostic));
}

// The rest of the line ends a statement without closing a `(` that was opened before it.
bool line_ends_statement(std::string_view text, std::uint32_t offset) {
  std::uint32_t depth = 0;
  for (std::size_t place = offset; place < text.size() && !scan::is_line_end(text[place]);
       place = scan::token_end(text, place)) {
    if (text[place] == ';') return true;
    if (text[place] == '(') ++depth;
    if (text[place] == ')' && depth-- == 0) return false;
  }
  return false;
}

// The bracket is still open although its statement is over.
bool statement_is_over(const Place& place, char opener) {
  if (place.at_end() || place.is_any_of(";{}")) return true;
  if (!place.begins_line()) return false;
  const ItemStart start = scan::item_start(place.text, place.offset);
  if (start == ItemStart::weak)
    return opener == '[' || line_ends_statement(place.text, place.offset);
  return start == ItemStart::strong;
}

void report_unclosed(const Place& place) {
  TreeBuilder& builder = place.builder;
  const std::uint32_t opener = builder.openers().back();
  const std::string mark = fmt::format("`{}`", place.text[opener]);
  const char closer = place.text[opener] == '(' ? ')' : place.text[opener] == '[' ? ']' : '}';
  Diagnostic diagnostic(DiagnosticKind::bracket_unclosed, builder.span(opener, opener + 1),
                        fmt::format("{} is never closed: expected `{}` before {}", mark, closer,
                                    scan::found(place.text, place.offset)));
  diagnostic.notes.push_back(
      {place.at_end() ? "the file ends here" : "the statement ends here",
       place.at_end() ? builder.span(place.offset, place.offset) : place.span()});
  if (place.at_end() && builder.openers().size() > 1) {
    diagnostic.notes.push_back(
        {fmt::format("{} more round it not closed either", builder.openers().size() - 1), {}});
  }
  builder.report(place.offset, std::move(diagnostic));
}

std::uint32_t missing_closer(const Place& place, std::string_view what, bool of_list) {
  TreeBuilder& builder = place.builder;
  const std::vector<std::uint32_t>& openers = builder.openers();
  const char opener = place.text[openers.back()];
  if (builder.is_forgiven(place.before)) {
    builder.close();
    return place.offset;
  }
  if (place.is_any_of(")]}") && opener != '{') {
    const char wanted = place.next() == ')' ? '(' : place.next() == ']' ? '[' : '{';
    const bool closes_outer =
        openers.size() > 1 && place.text[openers[openers.size() - 2]] == wanted;
    if (!closes_outer) {
      builder.report(place.offset,
                     Diagnostic(DiagnosticKind::closer_mismatched, place.span(),
                                fmt::format("expected {}, found {}", what,
                                            scan::found(place.text, place.offset)))
                         .label(builder.span(openers.back(), openers.back() + 1), "opened here")
                         .fix(place.span(), opener == '(' ? ")" : "]"));
      builder.close();
      return take_as_error(place);
    }
    report_unclosed(place);
    builder.close();
    return place.offset;
  }
  if (statement_is_over(place, opener)) {
    report_unclosed(place);
    builder.close();
    return place.offset;
  }
  Diagnostic diagnostic =
      unexpected(place, of_list ? fmt::format("`,` or {}", what) : std::string(what));
  if (!of_list && place.is_any_of(","))
    diagnostic.hints.push_back("a list is written in brackets: `[1, 2]`");
  if (of_list && place.begins_operand())
    diagnostic.fixits.push_back({builder.span(place.before, place.before), ","});
  give_up(place, std::move(diagnostic));
}

Diagnostic reserved_word(const Place& place, std::string_view what) {
  return Diagnostic(DiagnosticKind::reserved_word_as_name, place.span(),
                    fmt::format("`{}` is a reserved word; expected {}{}", place.word(), what,
                                after(place.builder)));
}

bool begins_item_line(const Place& place) {
  return place.begins_line() && scan::item_start(place.text, place.offset) != ItemStart::none;
}

std::uint32_t missing_value(const Place& place, std::string_view what) {
  TreeBuilder& builder = place.builder;
  const bool nothing = place.at_end() || place.is_any_of(";)]},{") || begins_item_line(place);
  if (nothing) {
    const Span where = place.at_end() || begins_item_line(place)
                           ? builder.span(place.before, place.before)
                           : place.span();
    builder.report(place.offset,
                   Diagnostic(DiagnosticKind::value_missing, where,
                              fmt::format("expected {}{}, found {}", what, after(builder),
                                          scan::found(place.text, place.offset))));
    builder.error_node(place.offset, place.offset);
    return place.offset;
  }
  if (scan::is_reserved(place.word())) {
    builder.report(place.offset, reserved_word(place, what));
    return take_as_error(place);
  }
  give_up(place, what);
}

std::uint32_t missing_name(const Place& place, std::string_view what) {
  TreeBuilder& builder = place.builder;
  if (scan::is_reserved(place.word()) && !begins_item_line(place)) {
    builder.report(place.offset, reserved_word(place, what));
    return take_for(place, SyntaxKind::name);
  }
  Diagnostic diagnostic(DiagnosticKind::name_missing, place.span(),
                        fmt::format("expected {}{}, found {}", what, after(builder),
                                    scan::found(place.text, place.offset)));
  const SyntaxNode last = builder.last_token();
  if (scan::at(place.text, last.begin) == '.' && last.begin > 0 &&
      scan::is(place.text[last.begin - 1], scan::digit)) {
    diagnostic.kind = DiagnosticKind::fraction_missing;
    diagnostic.span = builder.span(last.begin, last.end);
    diagnostic.message = "a number needs digits behind its point";
    diagnostic.fixits.push_back({builder.span(last.end, last.end), "0"});
  }
  if (place.at_end() || place.is_any_of("=:({;,)]}") || begins_item_line(place)) {
    builder.report(place.offset, std::move(diagnostic));
    return place.offset;
  }
  give_up(place, std::move(diagnostic));
}

std::uint32_t missing_type(const Place& place, std::string_view what) {
  if (place.at_end() || place.is_any_of("=,);")) {
    place.builder.report(place.offset, unexpected(place, what));
    place.builder.error_node(place.offset, place.offset);
    return place.offset;
  }
  Diagnostic diagnostic = unexpected(place, what);
  diagnostic.hints.push_back("`:` introduces a type; a value follows `=`");
  give_up(place, std::move(diagnostic));
}

std::uint32_t missing_colon(const Place& place, std::string_view what) {
  TreeBuilder& builder = place.builder;
  const bool names_follow = scan::is(place.next(), scan::name_first);
  if (place.is_any_of("=")) {
    const std::uint32_t next = static_cast<std::uint32_t>(scan::skip_trivia(place.text, place.end));
    if (scan::is(scan::at(place.text, next), scan::name_first) && what != "`:` and a type") {
      builder.report(place.offset, Diagnostic(DiagnosticKind::equals_for_colon, place.span(),
                                              fmt::format("use {}{}", what, after(builder)))
                                       .fix(place.span(), ":"));
      return take_for(place, SyntaxKind::punctuation);
    }
  }
  if (place.at_end() || names_follow || place.is_any_of("=,);")) {
    const Span where = builder.span(place.before, place.before);
    Diagnostic diagnostic = unexpected(place, what);
    diagnostic.span = names_follow ? where : place.span();
    if (names_follow) diagnostic.fixits.push_back({where, ":"});
    builder.report(place.offset, std::move(diagnostic));
    return place.offset;
  }
  give_up(place, what);
}

std::uint32_t missing_assign(const Place& place, std::string_view what) {
  TreeBuilder& builder = place.builder;
  if (place.is_any_of(":")) {
    report_colon_for_equals(builder, place.offset);
    return take_for(place, SyntaxKind::punctuation);
  }
  if (place.at_end() || place.begins_operand() || place.is_any_of(";}")) {
    const Span where = builder.span(place.before, place.before);
    builder.report(place.offset, std::move(unexpected(place, what)).fix(where, " ="));
    return place.offset;
  }
  give_up(place, what);
}

[[noreturn]] void missing_block(const Place& place, std::string_view what) {
  Diagnostic diagnostic = unexpected(place, what);
  if (place.is_any_of("=")) diagnostic.hints.push_back("`==` compares");
  // Without a `{` the author's `}` is still to come, unless the item is over at once.
  if (!place.at_end() && !place.is_any_of(";}")) place.builder.owe_closer();
  give_up(place, std::move(diagnostic));
}

[[noreturn]] void no_item(const Place& place, std::string_view what) {
  TreeBuilder& builder = place.builder;
  const auto report = [&](DiagnosticKind kind, std::string message) {
    builder.report(place.offset, Diagnostic(kind, place.span(), std::move(message)));
    throw BrokenStatement{place.offset};
  };
  if (place.next() == '}') {
    if (builder.take_owed_closer()) throw BrokenStatement{place.offset};
    report(DiagnosticKind::closer_stray, "`}` closes nothing");
  }
  if (place.is_any_of(";")) {
    builder.report(place.offset,
                   Diagnostic(DiagnosticKind::stray_semicolon, place.span(),
                              "`;` ends nothing: none follows `}`, and none stands alone")
                       .fix(place.span(), ""));
    throw BrokenStatement{place.offset};
  }
  const std::string_view word = place.word();
  if (word == "else") report(DiagnosticKind::else_without_if, "`else` without an `if` before it");
  if (word == "sdl")
    report(DiagnosticKind::edition_misplaced, "`sdl` must be the first statement of the file");
  if (!scan::is(place.next(), scan::name_first)) give_up(place, what);
  if (scan::is_reserved(word)) give_up(place, what);
  // A name, and then nothing that makes an item of it: the token behind it does not fit.
  builder.token(SyntaxKind::name, place.offset, place.end);
  const Place behind(builder, builder.skip_trivia(place.end));
  if (behind.is_any_of(":")) {
    give_up(behind,
            Diagnostic(DiagnosticKind::unexpected_text, place.span(),
                       fmt::format("expected `material`, `light` or `camera` before `{}`", word)));
  }
  if (scan::is(behind.next(), scan::name_first)) {
    const Place third(builder, builder.skip_trivia(behind.end));
    if (third.is_any_of("=")) builder.owe_closer();  // `sphere radius = 1; }`
  }
  give_up(behind, "`=`, `{` or `(`");
}

std::uint32_t missing_edition(const Place& place) {
  const Span where = place.builder.span(place.offset, place.offset);
  place.builder.report(place.offset, Diagnostic(DiagnosticKind::edition_missing, where,
                                                "the first statement must be `sdl 1;`")
                                         .fix(where, "sdl 1;\n"));
  return place.offset;
}

}  // namespace

std::uint32_t repair_missing(TreeBuilder& builder, const Expectation& expected,
                             std::uint32_t offset) {
  const Place place(builder, offset);
  switch (expected.repair) {
    case Repair::give_up:
      give_up(place, expected.what);
    case Repair::semicolon:
      return missing_semicolon(place);
    case Repair::closer:
      return missing_closer(place, expected.what, false);
    case Repair::list_closer:
      return missing_closer(place, expected.what, true);
    case Repair::value:
      return missing_value(place, expected.what);
    case Repair::name:
      return missing_name(place, expected.what);
    case Repair::type:
      return missing_type(place, expected.what);
    case Repair::colon:
      return missing_colon(place, expected.what);
    case Repair::assign:
      return missing_assign(place, expected.what);
    case Repair::block:
      missing_block(place, expected.what);
    case Repair::item:
      no_item(place, expected.what);
    case Repair::edition:
      return missing_edition(place);
  }
  give_up(place, expected.what);
}

}  // namespace scenec::grammar
