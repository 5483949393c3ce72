// The native grammar. Two tokens decide every alternative, so nothing is parsed twice: an
// alternative that has matched its first token is never left again, it is repaired instead.
// `expect<X>` is an X that must come; what happens when it does not stands in sdl_messages.hpp.
#pragma once

#include "grammar/lexical.hpp"

namespace scenec::grammar {

namespace sdl {
struct item_body;
}
// Where no item begins the item is given up, and skipping always moves on: for the analysis of
// loops this one consumes.
template <>
struct missing<sdl::item_body> {
  using rule_t = missing;
  using subs_t = peg::type_list<>;

  template <class Input>
  [[nodiscard]] static bool match(Input&) {
    return true;
  }
};

}  // namespace scenec::grammar

namespace scenec::grammar::sdl {

using Kind = SyntaxKind;

// ---- marks and words
struct semicolon : lex::mark<';'> {};
struct comma : lex::mark<','> {};
struct assign_text : peg::seq<peg::one<'='>, peg::not_at<peg::one<'='>>>,
                     makes_token<Kind::punctuation> {};
struct assign : peg::seq<assign_text, trivia> {};
struct colon : lex::mark<':'> {};
struct kind_colon : lex::mark<':'> {};
struct body_colon : lex::mark<':'> {};  // of a comprehension
struct open_brace : lex::opener<'{'> {};
struct close_brace : lex::closer<'}'> {};
struct open_bracket : lex::opener<'['> {};
struct close_bracket : lex::closer<']'> {};
struct open_paren : lex::opener<'('> {};
struct close_paren : lex::closer<')'> {};
struct close_list : lex::closer<']'> {};
struct close_arguments : lex::closer<')'> {};
struct dot_text : peg::seq<peg::one<'.'>, peg::not_at<peg::one<'.'>>>,
                  makes_token<Kind::punctuation> {};
struct dot : peg::seq<dot_text, trivia> {};
struct range_text : peg::seq<peg::two<'.'>, peg::opt<peg::one<'<'>>>,
                    makes_token<Kind::punctuation> {};
struct range_mark : peg::seq<range_text, trivia> {};

struct declared_name : lex::name {};  // the name a declaration gives
struct kind_name : lex::name {};      // the kind of a material, light or camera
struct member_name : lex::name {};
struct type_name : lex::any_name {};
struct path : lex::string {};
struct word_in : lex::keyword<'i', 'n'> {};
struct word_as : lex::keyword<'a', 's'> {};
using word_for = lex::keyword<'f', 'o', 'r'>;
using word_if = lex::keyword<'i', 'f'>;

// ---- expressions, from the loosest operator to the tightest
struct expression;
struct operand;
template <class First, class... Rest>
struct op_text : peg::sor<First, Rest...>, makes_token<Kind::operator_token> {};
template <class... Texts>
struct op : peg::seq<op_text<Texts...>, trivia> {};

struct list_separator : peg::seq<peg::not_at<peg::one<','>, trivia, peg::one<')', ']'>>, comma> {};

struct number_word : peg::seq<lex::number_text, trivia> {};
// `1 m`: a unit after a blank; an error with its place in the tree.
struct detached_unit;
struct number_literal : peg::seq<number_word, peg::opt<detached_unit>>,
                        makes_node<Kind::number_literal> {};
struct string_literal : peg::seq<lex::string_text, trivia>, makes_node<Kind::string_literal> {};
struct color_literal : peg::seq<lex::color_text, trivia>, makes_node<Kind::color_literal> {};
struct enum_literal : peg::seq<lex::enum_text, trivia>, makes_node<Kind::enum_literal> {};
struct bool_literal
    : peg::sor<lex::keyword<'t', 'r', 'u', 'e'>, lex::keyword<'f', 'a', 'l', 's', 'e'>>,
      makes_node<Kind::bool_literal> {};
struct name_ref : lex::name, makes_node<Kind::name_ref> {};
struct paren : peg::seq<open_paren, expect<expression>, expect<close_paren>>,
               makes_node<Kind::paren> {};

struct range_tail : peg::seq<range_mark, expect<expression>>, wraps_node<Kind::range> {};
struct loop_head : peg::seq<expect<declared_name>, peg::opt<comma, expect<declared_name>>,
                            expect<word_in>, expect<expression>, peg::opt<range_tail>> {};

struct comprehension
    : peg::seq<peg::at<peg::one<'['>, trivia, peg::keyword<'f', 'o', 'r'>>, open_bracket, word_for,
               loop_head, expect<body_colon>, expect<expression>, expect<close_bracket>>,
      makes_node<Kind::comprehension> {};
struct list_elements
    : peg::seq<expect<expression>, peg::star<list_separator, expect<expression>>, peg::opt<comma>> {
};
struct list : peg::seq<open_bracket, peg::opt<peg::not_at<peg::one<']'>>, list_elements>,
                       expect<close_list>>,
              makes_node<Kind::list> {};

struct argument_name
    : peg::seq<peg::at<peg::identifier, trivia, peg::one<'='>, peg::not_at<peg::one<'='>>>,
               lex::any_name, assign> {};
struct argument : peg::seq<peg::opt<argument_name>, expect<expression>>,
                  makes_node<Kind::argument> {};
struct argument_list : peg::seq<argument, peg::star<list_separator, argument>, peg::opt<comma>> {};
struct arguments : peg::seq<open_paren, peg::opt<peg::not_at<peg::one<')'>>, argument_list>,
                            expect<close_arguments>>,
                   makes_node<Kind::arguments> {};

// Malformed literals that deserve their own words.
struct bare_fraction;  // `.5`
struct bad_color;      // `#12`

struct primary : peg::sor<number_literal, name_ref, comprehension, list, paren, string_literal,
                          color_literal, enum_literal, bool_literal, bare_fraction, bad_color> {};
struct callable;  // true behind a name or a member: what a call can call
struct member : peg::seq<dot, expect<member_name>>, wraps_node<Kind::member>, deepens {};
struct index : peg::seq<open_bracket, expect<expression>, expect<close_bracket>>,
               wraps_node<Kind::index>,
               deepens {};
struct call : peg::seq<peg::at<peg::one<'('>>, callable, arguments>,
              wraps_node<Kind::call>,
              deepens {};
struct postfix : peg::seq<primary, peg::star<peg::sor<member, index, call>>>, restores_depth {};

using sign = op<peg::one<'-'>, peg::seq<peg::one<'!'>, peg::not_at<peg::one<'='>>>>;
struct unary : peg::seq<sign, peg::star<sign>, expect<operand>>, makes_node<Kind::unary> {};
struct operand : postfix {};
struct factor : peg::sor<unary, operand> {};

struct modulo_text : peg::one<'%'>, makes_token<Kind::operator_token> {};
struct multiply_sign : peg::sor<op<peg::one<'*', '/'>>, peg::seq<modulo_text, trivia>> {};
struct multiply_tail : peg::plus<multiply_sign, expect<factor>>,
                       wraps_node<Kind::multiply_chain> {};
struct term : peg::seq<factor, peg::opt<multiply_tail>> {};

struct add_tail : peg::plus<op<peg::one<'+', '-'>>, expect<term>>, wraps_node<Kind::add_chain> {};
struct sum : peg::seq<term, peg::opt<add_tail>> {};

struct comparison_mark
    : peg::sor<peg::seq<peg::one<'=', '!', '<', '>'>, peg::one<'='>>, peg::one<'<', '>'>> {};
struct comparison_tail : peg::seq<op<comparison_mark>, expect<sum>>,
                         wraps_node<Kind::comparison> {};
struct chained_text : comparison_mark, makes_token<Kind::operator_token> {};  // `a < b < c`
struct chained_tail : peg::plus<chained_text, trivia, expect<sum>>, wraps_node<Kind::error> {};
struct relation : peg::seq<sum, peg::opt<comparison_tail, peg::opt<chained_tail>>> {};

struct and_tail : peg::plus<op<peg::two<'&'>>, expect<relation>>, wraps_node<Kind::and_chain> {};
struct conjunction : peg::seq<relation, peg::opt<and_tail>> {};
struct or_tail : peg::plus<op<peg::two<'|'>>, expect<conjunction>>, wraps_node<Kind::or_chain> {};
struct expression : peg::seq<conjunction, peg::opt<or_tail>> {};

// ---- items
struct item;
struct item_list : peg::star<peg::not_at<peg::sor<peg::one<'}'>, peg::eof>>, item> {};
struct block : peg::seq<open_brace, item_list, expect<close_brace>>, makes_node<Kind::block> {};

struct type;
struct list_type : peg::seq<open_bracket, expect<type>, expect<close_bracket>> {};
struct type : peg::sor<type_name, list_type>, makes_node<Kind::type> {};
struct result_type : peg::opt<colon, expect<type>> {};
struct value : peg::seq<expect<assign>, expect<expression>> {};
struct parameter_range : peg::seq<expression, expect<range_mark>, expect<expression>>,
                         makes_node<Kind::range> {};
struct range_limit : peg::opt<word_in, expect<parameter_range>> {};

struct parameter : peg::seq<expect<declared_name>, expect<colon>, expect<type>,
                            peg::opt<assign, expect<expression>>, range_limit>,
                   makes_node<Kind::parameter> {};
struct parameter_list : peg::seq<parameter, peg::star<list_separator, parameter>, peg::opt<comma>> {
};
struct parameters : peg::seq<open_paren, peg::opt<peg::not_at<peg::one<')'>>, parameter_list>,
                             expect<close_arguments>>,
                    makes_node<Kind::parameters> {};
struct annotation : peg::seq<lex::mark<'@'>, expect<declared_name>, peg::opt<arguments>>,
                    makes_node<Kind::annotation> {};

struct include : peg::seq<lex::keyword<'i', 'n', 'c', 'l', 'u', 'd', 'e'>, expect<path>,
                          expect<word_as>, expect<declared_name>, expect<semicolon>>,
                 makes_node<Kind::include> {};
struct param : peg::seq<lex::keyword<'p', 'a', 'r', 'a', 'm'>, expect<declared_name>, expect<colon>,
                        expect<type>, value, range_limit, expect<semicolon>>,
               makes_node<Kind::param> {};
struct let : peg::seq<lex::keyword<'l', 'e', 't'>, expect<declared_name>, result_type, value,
                      expect<semicolon>>,
             makes_node<Kind::let> {};
struct fn : peg::seq<lex::keyword<'f', 'n'>, expect<declared_name>, expect<parameters>, result_type,
                     value, expect<semicolon>>,
            makes_node<Kind::fn> {};
struct macro : peg::seq<lex::keyword<'m', 'a', 'c', 'r', 'o'>, expect<declared_name>,
                        expect<parameters>, expect<block>>,
               makes_node<Kind::macro> {};
struct proto
    : peg::seq<lex::keyword<'p', 'r', 'o', 't', 'o'>, expect<declared_name>, expect<block>>,
      makes_node<Kind::proto> {};
struct model : peg::seq<expect<kind_colon>, expect<kind_name>, expect<block>> {};
struct material
    : peg::seq<lex::keyword<'m', 'a', 't', 'e', 'r', 'i', 'a', 'l'>, expect<declared_name>, model>,
      makes_node<Kind::material> {};
struct light : peg::seq<lex::keyword<'l', 'i', 'g', 'h', 't'>, peg::opt<lex::name>, model>,
               makes_node<Kind::light> {};
struct camera : peg::seq<lex::keyword<'c', 'a', 'm', 'e', 'r', 'a'>, peg::opt<lex::name>, model>,
                makes_node<Kind::camera> {};
struct render : peg::seq<lex::keyword<'r', 'e', 'n', 'd', 'e', 'r'>, expect<block>>,
                makes_node<Kind::render> {};
struct group : peg::seq<lex::keyword<'g', 'r', 'o', 'u', 'p'>, peg::opt<lex::name>, expect<block>>,
               makes_node<Kind::group> {};
struct instance : peg::seq<lex::keyword<'i', 'n', 's', 't', 'a', 'n', 'c', 'e'>,
                           peg::opt<lex::name>, expect<block>>,
                  makes_node<Kind::instance> {};
struct for_item : peg::seq<word_for, loop_head, expect<block>>, makes_node<Kind::for_item> {};

struct if_item;
struct else_word_text : peg::keyword<'e', 'l', 's', 'e'>, makes_token<Kind::keyword>, deepens {};
struct else_branch : peg::sor<if_item, block> {};
struct if_item : peg::seq<word_if, expect<expression>, expect<block>,
                          peg::opt<else_word_text, trivia, expect<else_branch>>>,
                 makes_node<Kind::if_item> {};
struct assert_item : peg::seq<lex::keyword<'a', 's', 's', 'e', 'r', 't'>, expect<expression>,
                              peg::opt<comma, expect<expression>>, expect<semicolon>>,
                     makes_node<Kind::assert_item> {};

struct is_assign : peg::seq<peg::one<'='>, peg::not_at<peg::one<'='>>> {};
struct field : peg::seq<peg::at<peg::identifier, trivia, is_assign>, lex::any_name, assign,
                        expect<expression>, expect<semicolon>>,
               makes_node<Kind::field> {};
struct shape : peg::seq<peg::at<plain_name, trivia, peg::opt<plain_name, trivia>, peg::one<'{'>>,
                        lex::name, peg::opt<lex::name>, block>,
               makes_node<Kind::shape> {};
struct qualified_name : peg::seq<lex::name, peg::opt<dot, lex::name>>,
                        makes_node<Kind::qualified_name> {};
struct call_item
    : peg::seq<peg::at<plain_name, trivia, peg::opt<peg::one<'.'>, trivia, plain_name, trivia>,
                       peg::one<'('>>,
               qualified_name, arguments, expect<semicolon>>,
      makes_node<Kind::call_item> {};
// `radius: 2;` is read as the field that was meant.
struct wrong_colon_text : peg::one<':'>, makes_token<Kind::punctuation> {};
struct colon_field
    : peg::seq<
          peg::at<plain_name, trivia, peg::one<':'>, trivia,
                  peg::not_at<plain_name, trivia, peg::opt<plain_name, trivia>, peg::one<'{'>>>,
          lex::name, wrong_colon_text, trivia, expect<expression>, expect<semicolon>>,
      makes_node<Kind::field> {};

struct item_body
    : peg::sor<field, shape, call_item, let, material, light, group, instance, for_item, if_item,
               param, fn, macro, proto, camera, render, include, assert_item, colon_field> {};
struct item : peg::seq<peg::star<annotation>, expect<item_body>>, recovers {};

struct edition_number : number_word {};
struct edition : peg::seq<lex::keyword<'s', 'd', 'l'>, expect<edition_number>, expect<semicolon>>,
                 makes_node<Kind::edition> {};
struct edition_line : peg::seq<edition>, recovers {};
struct file_item : peg::seq<peg::not_at<peg::eof>, item> {};
struct file : peg::seq<peg::opt<peg::utf8::bom>, trivia, expect<edition_line>, peg::star<file_item>,
                       peg::eof>,
              makes_node<Kind::file> {};
// What is left of a file behind the end of an item.
struct file_part : peg::seq<trivia, peg::star<file_item>, peg::eof>, makes_node<Kind::file> {};

// ---- rules whose matching needs more than characters; their actions report
struct detached_unit : peg::seq<peg::identifier, trivia> {};
struct bare_fraction : peg::seq<peg::at<peg::one<'.'>, peg::digit>, peg::one<'.'>,
                                peg::plus<peg::identifier_other>, trivia> {};
struct bad_color : peg::seq<peg::one<'#'>, peg::star<peg::identifier_other>, trivia> {};
struct callable : peg::success {};

}  // namespace scenec::grammar::sdl

namespace tao::pegtl {
template <class Name>
struct analyze_traits<Name, scenec::grammar::missing<scenec::grammar::sdl::item_body>>
    : analyze_any_traits<> {};
}  // namespace tao::pegtl
