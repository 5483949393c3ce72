// What the native grammar expects where, in words for people, and how each lack is repaired. The
// message is always "expected WHAT after X, found Y"; recovery.cpp knows the friendlier cases.
#pragma once

#include "grammar/recovery.hpp"
#include "grammar/sdl.hpp"

namespace scenec::grammar {

#define SCENEC_EXPECTS(rule, what, repair)                    \
  template <>                                                 \
  struct expectation<sdl::rule> {                             \
    static constexpr Expectation value{what, Repair::repair}; \
  }

SCENEC_EXPECTS(edition_line, "`sdl 1;`", edition);
SCENEC_EXPECTS(edition_number, "the number of the edition", give_up);
SCENEC_EXPECTS(item_body, "an item", item);
SCENEC_EXPECTS(semicolon, "`;`", semicolon);
SCENEC_EXPECTS(close_brace, "`}`", closer);
SCENEC_EXPECTS(close_bracket, "`]`", closer);
SCENEC_EXPECTS(close_paren, "`)`", closer);
SCENEC_EXPECTS(close_list, "`]`", list_closer);
SCENEC_EXPECTS(close_arguments, "`)`", list_closer);
SCENEC_EXPECTS(block, "`{`", block);
SCENEC_EXPECTS(else_branch, "`{` or `if`", block);
SCENEC_EXPECTS(parameters, "`(` and parameters", give_up);
SCENEC_EXPECTS(declared_name, "a name", name);
SCENEC_EXPECTS(member_name, "the name of a member", name);
SCENEC_EXPECTS(kind_name, "the kind", name);
SCENEC_EXPECTS(colon, "`:` and a type", colon);
SCENEC_EXPECTS(body_colon, "`:` and the value of each element", colon);
SCENEC_EXPECTS(kind_colon, "`:` and the kind", colon);
SCENEC_EXPECTS(type, "a type", type);
SCENEC_EXPECTS(assign, "`=`", assign);
SCENEC_EXPECTS(path, "the path of a file in double quotes", give_up);
SCENEC_EXPECTS(word_as, "`as` and a name", give_up);
SCENEC_EXPECTS(word_in, "`in`", give_up);
SCENEC_EXPECTS(range_mark, "`..` or `..<`", give_up);
SCENEC_EXPECTS(parameter_range, "a range", give_up);
SCENEC_EXPECTS(expression, "a value", value);
SCENEC_EXPECTS(conjunction, "a value", value);
SCENEC_EXPECTS(relation, "a value", value);
SCENEC_EXPECTS(sum, "a value", value);
SCENEC_EXPECTS(term, "a value", value);
SCENEC_EXPECTS(factor, "a value", value);
SCENEC_EXPECTS(operand, "a value", value);

#undef SCENEC_EXPECTS

}  // namespace scenec::grammar
