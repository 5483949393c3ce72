// What happens when a rule matches: PEGTL actions that drive a TreeBuilder by what the rule says it
// makes (lexical.hpp). Lookahead builds nothing, and a node that fails takes back what it pushed.
#pragma once

#include <concepts>

#include "grammar/lexical.hpp"
#include "grammar/recovery.hpp"

namespace scenec::grammar {

template <class Rule>
concept token_rule = requires { Rule::token_kind; };
template <class Rule>
concept node_rule = requires { Rule::node_kind; };
template <class Rule>
concept wrapping_rule = requires { Rule::wrapping_kind; };
template <class Rule>
concept recovering_rule = std::derived_from<Rule, recovers>;
template <class Rule>
concept tree_rule = token_rule<Rule> || node_rule<Rule> || wrapping_rule<Rule> ||
                    std::derived_from<Rule, restores_depth>;

template <class Rule>
struct build {};

template <class Rule>
concept string_rule = std::same_as<Rule, lex::string_text>;

template <class Rule>
  requires(tree_rule<Rule> && !recovering_rule<Rule>)
struct build<Rule> {
  template <class Same, peg::apply_mode A, peg::rewind_mode M, template <class...> class Action,
            template <class...> class Control, class Input, class... States>
  [[nodiscard]] static bool match(Input& in, TreeBuilder& builder, States&&... states) {
    if constexpr (A == peg::apply_mode::nothing) {
      return peg::match<Rule, A, M, Action, Control>(in, builder, states...);
    } else {
      const std::uint32_t begin = builder.offset_of(in.current());
      [[maybe_unused]] const auto depth = builder.depth();
      std::uint32_t mark = builder.mark();
      if constexpr (wrapping_rule<Rule>) mark = builder.mark_of_last();
      if (!peg::match<Rule, A, M, Action, Control>(in, builder, states...)) {
        if constexpr (node_rule<Rule>) builder.rollback(mark);
        return false;
      }
      matched(builder, begin, builder.offset_of(in.current()), mark);
      if constexpr (std::derived_from<Rule, restores_depth>) builder.restore(depth);
      return true;
    }
  }

 private:
  static void matched(TreeBuilder& builder, std::uint32_t begin, std::uint32_t end,
                      std::uint32_t mark) {
    if constexpr (token_rule<Rule>) {
      builder.token(Rule::token_kind, begin, end);
      if constexpr (string_rule<Rule>) check_string(builder, begin, end);
    }
    if constexpr (node_rule<Rule>) builder.node(Rule::node_kind, mark);
    if constexpr (wrapping_rule<Rule>) builder.node(Rule::wrapping_kind, mark);
    if constexpr (std::derived_from<Rule, opens>) builder.open(begin);
    if constexpr (std::derived_from<Rule, closes>) builder.close();
    if constexpr (std::derived_from<Rule, deepens>) builder.deepen(begin, end);
  }
};

template <class Rule>
struct build<missing<Rule>> {
  template <class Same, peg::apply_mode A, peg::rewind_mode M, template <class...> class Action,
            template <class...> class Control, class Input, class... States>
  [[nodiscard]] static bool match(Input& in, TreeBuilder& builder, States&&... states) {
    if (!peg::match<missing<Rule>, A, M, Action, Control>(in, builder, states...)) return false;
    static_assert(A == peg::apply_mode::action, "lookahead must not repair");
    const std::uint32_t offset = builder.offset_of(in.current());
    in.bump(repair_missing(builder, expectation<Rule>::value, offset) - offset);
    return true;
  }
};

// An item: whatever breaks inside it ends with it.
template <recovering_rule Rule>
struct build<Rule> {
  template <class Same, peg::apply_mode A, peg::rewind_mode M, template <class...> class Action,
            template <class...> class Control, class Input, class... States>
  [[nodiscard]] static bool match(Input& in, TreeBuilder& builder, States&&... states) {
    const std::uint32_t mark = builder.mark();
    const TreeBuilder::Depth depth = builder.depth();
    if (depth.openers == 0) builder.begin_outermost();
    try {
      const bool matched = peg::match<Rule, A, M, Action, Control>(in, builder, states...);
      if (matched) builder.adopt(mark);
      builder.restore(depth);
      return matched;
    } catch (const BrokenStatement& broken) {
      const std::uint32_t open_brackets = builder.depth().openers - depth.openers;
      builder.restore(depth);
      in.iterator() =
          builder.text().data() + resume_after(builder, broken.offset, mark, open_brackets);
      return true;
    }
  }
};

}  // namespace scenec::grammar
