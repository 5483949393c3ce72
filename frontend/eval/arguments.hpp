// Which argument of a call belongs to which parameter: by position first, then by name.
#pragma once

#include <cstddef>
#include <functional>
#include <string_view>

#include "base/inline_list.hpp"
#include "frontend/ast/sdl_ast.hpp"
#include "frontend/session.hpp"
#include "grammar/syntax_tree.hpp"

namespace scenec::frontend {

// The index of the parameter of each argument, in `places`. False when one has no place (reported).
using ArgumentPlaces = InlineList<std::size_t, 4>;
bool place_arguments(Session& session, std::string_view callee, const ast::Arguments& given,
                     std::size_t parameter_count,
                     const std::function<std::string_view(std::size_t)>& name_of,
                     ArgumentPlaces& places);

void report_missing_argument(Session& session, grammar::NodeRef call, std::string_view callee,
                             std::string_view parameter);

}  // namespace scenec::frontend
