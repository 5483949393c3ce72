// The few native rules whose match is more than characters, or is taken with a report.
#pragma once

#include "grammar/sdl.hpp"
#include "grammar/tree_actions.hpp"

namespace scenec::grammar {

// Matches the rule, then calls `taken(builder, begin, end)` with the range of its text.
template <class Rule, void (*taken)(TreeBuilder&, std::uint32_t, std::uint32_t)>
struct taken_with_report {
  template <class Same, peg::apply_mode A, peg::rewind_mode M, template <class...> class Action,
            template <class...> class Control, class Input, class... States>
  [[nodiscard]] static bool match(Input& in, TreeBuilder& builder, States&&... states) {
    const std::uint32_t begin = builder.offset_of(in.current());
    if (!peg::match<Rule, A, M, Action, Control>(in, builder, states...)) return false;
    const std::size_t end = scan::token_end(builder.text(), begin);
    if constexpr (A == peg::apply_mode::action)
      taken(builder, begin, static_cast<std::uint32_t>(end));
    return true;
  }
};

inline void take_wrong_colon(TreeBuilder& builder, std::uint32_t begin, std::uint32_t end) {
  report_colon_for_equals(builder, begin);
  builder.token(SyntaxKind::punctuation, begin, end);
}
inline void take_modulo(TreeBuilder& builder, std::uint32_t begin, std::uint32_t end) {
  report_touching_percent(builder, begin);
  builder.token(SyntaxKind::operator_token, begin, end);
}
inline void take_chained(TreeBuilder& builder, std::uint32_t begin, std::uint32_t end) {
  report_chained_comparison(builder, begin, end);
  builder.token(SyntaxKind::operator_token, begin, end);
}
inline void take_bare_fraction(TreeBuilder& builder, std::uint32_t begin, std::uint32_t) {
  const std::string_view text = builder.text();
  report_bare_fraction(builder, begin, static_cast<std::uint32_t>(scan::name_end(text, begin + 1)));
}

template <>
struct build<sdl::wrong_colon_text> : taken_with_report<sdl::wrong_colon_text, take_wrong_colon> {};
template <>
struct build<sdl::modulo_text> : taken_with_report<sdl::modulo_text, take_modulo> {};
template <>
struct build<sdl::chained_text> : taken_with_report<sdl::chained_text, take_chained> {};
template <>
struct build<sdl::bare_fraction> : taken_with_report<sdl::bare_fraction, take_bare_fraction> {};
template <>
struct build<sdl::bad_color> : taken_with_report<sdl::bad_color, report_bad_color> {};
template <>
struct build<sdl::edition_number> : taken_with_report<sdl::edition_number, check_edition> {};

template <>
struct build<sdl::detached_unit> {
  template <class Same, peg::apply_mode A, peg::rewind_mode M, template <class...> class Action,
            template <class...> class Control, class Input, class... States>
  [[nodiscard]] static bool match(Input& in, TreeBuilder& builder, States&&... states) {
    if (in.empty() || !scan::is(in.peek_char(), scan::name_first)) return false;
    const std::uint32_t begin = builder.offset_of(in.current());
    if (A == peg::apply_mode::nothing || !is_detached_unit(builder, begin)) return false;
    const std::size_t end = scan::name_end(builder.text(), begin);
    report_detached_unit(builder, begin, static_cast<std::uint32_t>(end));
    return peg::match<sdl::detached_unit, A, M, Action, Control>(in, builder, states...);
  }
};

template <>
struct build<sdl::callable> {
  template <class Same, peg::apply_mode A, peg::rewind_mode M, template <class...> class Action,
            template <class...> class Control, class Input, class... States>
  [[nodiscard]] static bool match(Input& in, TreeBuilder& builder, States&&... states) {
    const SyntaxKind callee = builder.last_kind();
    if (callee != SyntaxKind::name_ref && callee != SyntaxKind::member) return false;
    return peg::match<sdl::callable, A, M, Action, Control>(in, builder, states...);
  }
};

}  // namespace scenec::grammar
