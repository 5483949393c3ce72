#include "frontend/eval/arguments.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.hpp"

namespace scenec::frontend {

using grammar::NodeRef;

namespace {

bool all_by_position(const ast::Arguments& given) {
  return std::none_of(given.begin(), given.end(),
                      [](const ast::Argument& argument) { return bool(argument.name); });
}

}  // namespace

bool place_arguments(Session& session, std::string_view callee, const ast::Arguments& given,
                     std::size_t parameter_count,
                     const std::function<std::string_view(std::size_t)>& name_of,
                     ArgumentPlaces& places) {
  if (all_by_position(given) && given.size() <= parameter_count) {
    for (std::size_t i = 0; i < given.size(); ++i) places.push_back(i);
    return true;
  }
  InlineList<NodeRef, 8> taken;
  taken.grow(parameter_count);
  bool named = false;
  for (std::size_t i = 0; i < given.size(); ++i) {
    const ast::Argument& argument = given[i];
    std::size_t place = i;
    const Span span = argument.name         ? argument.name.span()
                      : argument.expression ? argument.expression.span()
                                            : Span{};
    if (argument.name) {
      named = true;
      place = 0;
      while (place < parameter_count && name_of(place) != argument.name.text()) ++place;
      if (place == parameter_count) {
        std::vector<std::string_view> names;
        for (std::size_t k = 0; k < parameter_count; ++k) names.push_back(name_of(k));
        session.report(unknown_word(DiagnosticKind::unknown_argument, span,
                                    fmt::format("`{}` has no parameter `{}`", printable(callee),
                                                printable(argument.name.text())),
                                    argument.name.text(), names, "parameters"));
        return false;
      }
    } else if (named) {
      session.error(DiagnosticKind::unknown_argument, span,
                    "an argument by position stands behind one by name");
      return false;
    } else if (place >= parameter_count) {
      session.error(DiagnosticKind::too_many_arguments, span,
                    fmt::format("`{}` takes {} argument{}; found {}", printable(callee),
                                parameter_count, parameter_count == 1 ? "" : "s", given.size()));
      return false;
    }
    if (taken[place]) {
      session.error(Diagnostic(DiagnosticKind::unknown_argument, span,
                               fmt::format("`{}` is given twice", printable(name_of(place))))
                        .note("first given here", taken[place].span()));
      return false;
    }
    taken[place] = argument.expression;
    places.push_back(place);
  }
  return true;
}

void report_missing_argument(Session& session, NodeRef call, std::string_view callee,
                             std::string_view parameter) {
  session.error(DiagnosticKind::missing_argument, call.span(),
                fmt::format("`{}` needs `{}`", printable(callee), printable(parameter)));
}

}  // namespace scenec::frontend
