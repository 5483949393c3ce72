// The canonical layout of a source file, native or course, over its lossless tree.
//
// Promises: the tokens keep their texts and their order, except that a broken list of elements gets
// a comma behind the last one and a list on one line has none; every comment stays between the
// tokens it stood between, except that a `,`, `;` or `:` on the line below `a // x` goes before the
// comment. Formatting a formatted text changes nothing. Time is linear in the text, stack space is
// constant.
#pragma once

#include <string>

#include "grammar/syntax_tree.hpp"

namespace scenec::frontend {

// Precondition: the text was parsed without errors.
[[nodiscard]] std::string format(const grammar::SyntaxTree& tree);

}  // namespace scenec::frontend
