// The grammar of the course dialect: words, numbers, blocks and brackets. Which words take which
// numbers is meaning, and known to the translation alone. The original reader wants blanks round
// braces and brackets; here they also split (`20}`, `Material{`, `[1`), and `#` and `//` at the
// start of a word begin a comment: extensions that no existing file contradicts.
#pragma once

#include "grammar/lexical.hpp"
#include "grammar/text_checks.hpp"

namespace scenec::grammar::course {

using Kind = SyntaxKind;

struct space {
  using rule_t = space;
  using subs_t = peg::type_list<>;

  template <peg::apply_mode, peg::rewind_mode, template <class...> class, template <class...> class,
            class Input, class... States>
  [[nodiscard]] static bool match(Input& in, TreeBuilder& builder, States&&...) {
    const std::uint32_t offset = builder.offset_of(in.current());
    in.bump(skip_course_trivia(builder.text(), offset) - offset);
    return true;
  }
};

struct delimiter : peg::one<' ', '\t', '\n', '\v', '\f', '\r', '{', '}', '[', ']'> {};
struct word_end : peg::at<peg::sor<delimiter, peg::eof>> {};

struct open_brace : lex::opener_text<'{'> {};
struct close_brace : lex::closer_text<'}'> {};
struct open_bracket : lex::opener_text<'['> {};
struct close_bracket : lex::closer_text<']'> {};

// What C's "%f" reads, and a word only as a whole: `200.0`, `.16`, `1.`, `1e-05`, `+1`, `-0`.
struct digits : peg::plus<peg::digit> {};
struct mantissa : peg::sor<peg::seq<digits, peg::opt<peg::one<'.'>, peg::star<peg::digit>>>,
                           peg::seq<peg::one<'.'>, digits>> {};
struct exponent : peg::seq<peg::one<'e', 'E'>, peg::opt<peg::one<'+', '-'>>, digits> {};
struct number_text : peg::seq<peg::opt<peg::one<'+', '-'>>, mantissa, peg::opt<exponent>, word_end>,
                     makes_token<Kind::number> {};
struct number : peg::seq<number_text>, makes_node<Kind::course_number> {};

struct word_text : peg::plus<peg::seq<peg::not_at<delimiter>, peg::any>>,
                   makes_token<Kind::name> {};
struct word : peg::seq<word_text>, makes_node<Kind::course_word> {};

struct element;
struct stray_closer : peg::one<'}', ']'> {};
struct stray_bracket : peg::one<']'> {};  // inside a block
struct block : peg::seq<open_brace, space, peg::star<peg::sor<element, stray_bracket>, space>,
                        expect<close_brace>>,
               makes_node<Kind::course_block> {};
struct bracket : peg::seq<open_bracket, space, peg::star<element, space>, expect<close_bracket>>,
                 makes_node<Kind::course_bracket> {};
struct element : peg::sor<number, word, block, bracket> {};
struct outermost : peg::seq<element> {};
struct file : peg::seq<space, peg::star<peg::sor<outermost, stray_closer>, space>, peg::eof>,
              makes_node<Kind::course_file> {};

}  // namespace scenec::grammar::course

namespace tao::pegtl {
template <class Name>
struct analyze_traits<Name, scenec::grammar::course::space> : analyze_opt_traits<> {};
}  // namespace tao::pegtl
