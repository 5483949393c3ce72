// Shared vocabulary of both grammars: what a rule makes of what it matched, how a required part is
// written, and the native tokens. Rules only; what happens on a match stands in tree_actions.hpp.
#pragma once

#include <tao/pegtl.hpp>
#include <tao/pegtl/contrib/analyze_traits.hpp>

#include "grammar/scan.hpp"
#include "grammar/tree_builder.hpp"

namespace scenec::grammar {

namespace peg = tao::pegtl;

// A rule derives from one of these to say what becomes of its match.
template <SyntaxKind kind>
struct makes_token {
  static constexpr SyntaxKind token_kind = kind;
};
template <SyntaxKind kind>
struct makes_node {
  static constexpr SyntaxKind node_kind = kind;
};
// A node that takes the node before it as its first child (`a` in `a + b`, `a.b`, `a[i]`).
template <SyntaxKind kind>
struct wraps_node {
  static constexpr SyntaxKind wrapping_kind = kind;
};
struct opens {};           // a token that opens a level of nesting
struct closes {};          // a token that closes one
struct deepens {};         // on success one level deeper until the operand or item ends
struct restores_depth {};  // ends the levels that were opened inside it by `deepens`
struct recovers {};        // an item: mistakes inside it end here

// What stands for a required part that is not there: reports and repairs, or gives the item up.
template <class Rule>
struct missing : peg::success {};
template <class Rule>
struct expect : peg::sor<Rule, missing<Rule>> {};

// Blanks and comments.
struct trivia {
  using rule_t = trivia;
  using subs_t = peg::type_list<>;

  template <peg::apply_mode, peg::rewind_mode, template <class...> class, template <class...> class,
            class Input, class... States>
  [[nodiscard]] static bool match(Input& in, TreeBuilder& builder, States&&...) {
    const std::string_view text = builder.text();
    std::uint32_t place = builder.offset_of(in.current());
    for (;; ++place) {
      const char c = scan::at(text, place);
      if (scan::is(c, scan::blank)) continue;
      const bool comment =
          c == '/' && (scan::at(text, place + 1) == '/' || scan::at(text, place + 1) == '*');
      if (!comment) break;
      place = builder.comment(place) - 1;
    }
    in.bump(place - builder.offset_of(in.current()));
    return true;
  }
};

// A word that is not reserved.
struct plain_name {
  using rule_t = plain_name;
  using subs_t = peg::type_list<>;

  template <class Input>
  [[nodiscard]] static bool match(Input& in) {
    const std::string_view rest(in.current(), in.size());
    if (rest.empty() || !scan::is(rest.front(), scan::name_first)) return false;
    const std::size_t end = scan::name_end(rest, 0);
    if (scan::is_reserved(rest.substr(0, end))) return false;
    in.bump(end);
    return true;
  }
};

namespace lex {

template <char... c>
struct mark_text : peg::one<c...>, makes_token<SyntaxKind::punctuation> {};
template <char... c>
struct mark : peg::seq<mark_text<c...>, trivia> {};
template <char c>
struct opener_text : peg::one<c>, makes_token<SyntaxKind::punctuation>, opens {};
template <char c>
struct opener : peg::seq<opener_text<c>, trivia> {};
template <char c>
struct closer_text : peg::one<c>, makes_token<SyntaxKind::punctuation>, closes {};
template <char c>
struct closer : peg::seq<closer_text<c>, trivia> {};

template <char... c>
struct keyword_text : peg::keyword<c...>, makes_token<SyntaxKind::keyword> {};
template <char... c>
struct keyword : peg::seq<keyword_text<c...>, trivia> {};

struct name_text : plain_name, makes_token<SyntaxKind::name> {};
struct name : peg::seq<name_text, trivia> {};
// Also a reserved word, where it stands as a key, a type or an argument's name.
struct any_name_text : peg::identifier, makes_token<SyntaxKind::name> {};
struct any_name : peg::seq<any_name_text, trivia> {};

// digits [. digits] [e [sign] digits] suffix; `0..n` leaves the dots alone. A `%` that touches what
// follows is left for the operator, which complains about it.
struct digits : peg::plus<peg::digit> {};
struct fraction : peg::seq<peg::one<'.'>, digits> {};
struct exponent : peg::seq<peg::one<'e'>, peg::opt<peg::one<'+', '-'>>, digits> {};
struct percent
    : peg::seq<peg::one<'%'>, peg::not_at<peg::sor<peg::identifier_other, peg::one<'('>>>> {};
struct suffix : peg::sor<percent, peg::star<peg::identifier_other>> {};
struct number_text : peg::seq<digits, peg::opt<fraction>, peg::opt<exponent>, suffix>,
                     makes_token<SyntaxKind::number> {};

struct color_text
    : peg::seq<peg::one<'#'>, peg::rep<3, peg::xdigit>, peg::opt<peg::rep<3, peg::xdigit>>,
               peg::not_at<peg::identifier_other>>,
      makes_token<SyntaxKind::color> {};
struct enum_text : peg::seq<peg::one<'.'>, peg::identifier>, makes_token<SyntaxKind::enum_value> {};

// Up to the closing quote; up to the end of the line when there is none (reported by its action).
struct escape : peg::seq<peg::one<'\\'>, peg::not_one<'\r', '\n'>> {};
struct string_part
    : peg::sor<peg::plus<peg::not_one<'"', '\\', '\r', '\n'>>, escape, peg::one<'\\'>> {};
struct string_text : peg::seq<peg::one<'"'>, peg::star<string_part>, peg::opt<peg::one<'"'>>>,
                     makes_token<SyntaxKind::string> {};
struct string : peg::seq<string_text, trivia> {};

}  // namespace lex
}  // namespace scenec::grammar

namespace tao::pegtl {
template <class Name>
struct analyze_traits<Name, scenec::grammar::trivia> : analyze_opt_traits<> {};
template <class Name>
struct analyze_traits<Name, scenec::grammar::plain_name> : analyze_any_traits<> {};
}  // namespace tao::pegtl
