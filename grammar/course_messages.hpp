// What is wrong with the brackets of a course file, the only mistakes its grammar knows.
#pragma once

#include <string>

#include "grammar/course.hpp"
#include "grammar/tree_actions.hpp"

namespace scenec::grammar {

inline void report_course_stray(TreeBuilder& builder, std::uint32_t begin, std::uint32_t end) {
  const std::string mark(builder.text().substr(begin, end - begin));
  builder.report(begin, Diagnostic(DiagnosticKind::closer_stray, builder.span(begin, end),
                                   "`" + mark + "` closes nothing"));
  builder.error_node(begin, end);
}

// Zero width: the block or bracket ends where its parent closes, or with the file. A `}` that no
// parent waits for was meant for the bracket. Returns where reading goes on.
[[nodiscard]] inline std::uint32_t repair_course_closer(TreeBuilder& builder,
                                                        std::uint32_t offset) {
  const std::string_view text = builder.text();
  const std::uint32_t opener = builder.openers().back();
  const bool at_end = offset >= text.size();
  const std::string found = at_end ? "the end of the file" : std::string("`") + text[offset] + "`";
  const std::string closer = text[opener] == '{' ? "`}`" : "`]`";
  const Span where = builder.span(offset, at_end ? offset : offset + 1);
  builder.close();
  if (!at_end && builder.openers().empty()) {
    builder.report(offset, Diagnostic(DiagnosticKind::closer_mismatched, where,
                                      "expected " + closer + ", found " + found)
                               .label(builder.span(opener, opener + 1), "opened here")
                               .fix(where, "]"));
    builder.error_node(offset, offset + 1);
    return offset + 1;
  }
  builder.report(
      offset, Diagnostic(DiagnosticKind::bracket_unclosed, builder.span(opener, opener + 1),
                         std::string("`") + text[opener] + "` is never closed: expected " + closer +
                             " before " + found)
                  .note(at_end ? "the file ends here" : "the block round it ends here", where));
  return offset;
}

template <class Rule>
struct course_stray {
  template <class Same, peg::apply_mode A, peg::rewind_mode M, template <class...> class Action,
            template <class...> class Control, class Input, class... States>
  [[nodiscard]] static bool match(Input& in, TreeBuilder& builder, States&&... states) {
    const std::uint32_t begin = builder.offset_of(in.current());
    if (!peg::match<Rule, A, M, Action, Control>(in, builder, states...)) return false;
    report_course_stray(builder, begin, builder.offset_of(in.current()));
    return true;
  }
};
template <>
struct build<course::stray_closer> : course_stray<course::stray_closer> {};
template <>
struct build<course::stray_bracket> : course_stray<course::stray_bracket> {};

template <class Closer>
struct course_unclosed {
  template <class Same, peg::apply_mode A, peg::rewind_mode M, template <class...> class Action,
            template <class...> class Control, class Input, class... States>
  [[nodiscard]] static bool match(Input& in, TreeBuilder& builder, States&&... states) {
    if (!peg::match<missing<Closer>, A, M, Action, Control>(in, builder, states...)) return false;
    const std::uint32_t offset = builder.offset_of(in.current());
    in.bump(repair_course_closer(builder, offset) - offset);
    return true;
  }
};
template <>
struct build<missing<course::close_brace>> : course_unclosed<course::close_brace> {};
template <>
struct build<missing<course::close_bracket>> : course_unclosed<course::close_bracket> {};

// An element directly in the file: what a hit limit turns into an error node begins here.
template <>
struct build<course::outermost> {
  template <class Same, peg::apply_mode A, peg::rewind_mode M, template <class...> class Action,
            template <class...> class Control, class Input, class... States>
  [[nodiscard]] static bool match(Input& in, TreeBuilder& builder, States&&... states) {
    builder.begin_outermost();
    return peg::match<course::outermost, A, M, Action, Control>(in, builder, states...);
  }
};

}  // namespace scenec::grammar
