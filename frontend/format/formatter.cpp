#include "frontend/format/formatter.hpp"

#include "frontend/format/layout.hpp"
#include "frontend/format/plan.hpp"

namespace scenec::frontend {

std::string format(const grammar::SyntaxTree& tree) {
  const bool is_course = tree.root().is(grammar::SyntaxKind::course_file);
  return layout::text_of(is_course ? layout::plan_course(tree) : layout::plan_sdl(tree));
}

}  // namespace scenec::frontend
