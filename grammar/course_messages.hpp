// What is wrong with the brackets of a course file, the only mistakes its grammar knows.
#pragma once

#include <string>

#include "grammar/course.hpp"
#include "grammar/tree_actions.hpp"

namespace scenec::grammar {

inline void report_course_stray(TreeBuilder& builder, std::uint32_t begin, std::uint32_t end) {
  const std::string mark(builder.text().substr(begin, end - begin));
  builder.report(begin, Diagnostic(DiagnosticKind::closer_stray, builder.span(begin, end), "`" + mark + "` closes nothing"));
  builder.error_node(begin, end);
}

// Zero width: the block or bracket ends where its parent closes, or with the file.
inline void report_course_unclosed(TreeBuilder& builder, std::uint32_t offset) {
  const std::string_view text = builder.text();
  const std::uint32_t opener = builder.openers().back();
  const bool at_end = offset >= text.size();
  const std::string closer = text[opener] == '{' ? "`}`" : "`]`";
  Diagnostic diagnostic(DiagnosticKind::bracket_unclosed, builder.span(opener, opener + 1),
                        std::string("`") + text[opener] + "` is never closed: expected " + closer + " before " +
                            (at_end ? std::string("the end of the file") : std::string("`") + text[offset] + "`"));
  diagnostic.notes.push_back({at_end ? "the file ends here" : "its parent ends here",
                              builder.span(offset, at_end ? offset : offset + 1)});
  builder.report(offset, std::move(diagnostic));
  builder.close();
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
  template <class Same, peg::apply_mode, peg::rewind_mode, template <class...> class, template <class...> class,
            class Input, class... States>
  [[nodiscard]] static bool match(Input& in, TreeBuilder& builder, States&&...) {
    report_course_unclosed(builder, builder.offset_of(in.current()));
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
