// Putting values into a list: they must agree in type, plain numbers take the dimension of their
// siblings, and two or three numbers become a vector.
#pragma once

#include <span>

#include "frontend/eval/value.hpp"
#include "frontend/session.hpp"
#include "grammar/syntax_tree.hpp"

namespace scenec::frontend {

// `nodes` are the elements' expressions, for messages; may be empty.
[[nodiscard]] Value checked_list(Session& session, ValueList elements, grammar::NodeRef list,
                                 std::span<const grammar::NodeRef> nodes);

}  // namespace scenec::frontend
