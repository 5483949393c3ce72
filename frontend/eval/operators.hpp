// The operators of expressions on values: types, dimensions, overflow. What does not fit is
// reported and gives the poison value.
#pragma once

#include <string_view>

#include "frontend/eval/value.hpp"
#include "frontend/session.hpp"
#include "grammar/syntax_tree.hpp"

namespace scenec::frontend {

struct Operation {
  std::string_view op;    // as written
  Span span;              // of the operation so far
  grammar::NodeRef left;  // may be empty: the result of earlier operations of a chain
  grammar::NodeRef right;
};

[[nodiscard]] Value arithmetic(Session& session, const Value& a, const Value& b,
                               const Operation& where);
[[nodiscard]] Value comparison(Session& session, const Value& a, const Value& b,
                               const Operation& where);
[[nodiscard]] Value negated(Session& session, const Value& value, Span span);
// The truth of a condition; poison (reported) when it is none.
[[nodiscard]] Value condition(Session& session, const Value& value, std::string_view subject,
                              grammar::NodeRef node);

// A finite number, or an error that says the result of `what` is not.
[[nodiscard]] Value finite_number(Session& session, double value, Dimension dimension, Span span,
                                  std::string_view what);
// The product a * b as a texture, at least one of which is one.
[[nodiscard]] Value texture_product(Session& session, const Value& a, const Value& b);
// A colour, number or texture as the input of a texture node.
[[nodiscard]] ir::ColorInput color_input(const Value& value);
[[nodiscard]] ir::NumberInput number_input(const Value& value);
[[nodiscard]] bool is_grey(const Value& value);

}  // namespace scenec::frontend
