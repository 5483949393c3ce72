// Widths of a plan's tokens on one line, as sums from the left, so that the width of any stretch is
// a difference; and the places where a line must end because of a comment.
#pragma once

#include <cstdint>
#include <vector>

#include "frontend/format/plan.hpp"

namespace scenec::frontend::layout {

// What stands between a token and the one before it on one line, without comments: a blank or
// nothing.
[[nodiscard]] bool wants_blank(const Token& before, const Token& token);
// No blank between an opening bracket, or a prefix, and what follows; none before a closing one.
[[nodiscard]] constexpr bool is_tight_behind(Spacing spacing) {
  return spacing == Spacing::tight_open || spacing == Spacing::open || spacing == Spacing::prefix ||
         spacing == Spacing::dot;
}
[[nodiscard]] constexpr bool is_tight_before(Spacing spacing) {
  return spacing == Spacing::close || spacing == Spacing::mark;
}
// Whether the comments before a token contain or touch a line end in the source.
[[nodiscard]] bool has_line_end(const Plan& plan, const Token& token);

// A file has at most 512 MiB, so its width on one line fits.
struct Measure {
  std::vector<std::uint32_t> begin;   // column of each token if all stood on one line
  std::vector<std::uint32_t> tail;    // width glued behind each token, to where a line may end
  std::vector<std::uint32_t> forced;  // comments up to each token that a line must end at
};
[[nodiscard]] Measure measure(const Plan& plan);

// Whether the group holds a comment that does not let it stand on one line.
[[nodiscard]] inline bool is_forced(const Measure& measure, const Group& group) {
  return measure.forced[group.last] > measure.forced[group.first];
}
[[nodiscard]] inline std::uint32_t width_of(const Plan& plan, const Measure& measure,
                                            const Group& group) {
  return measure.begin[group.last] + plan.tokens[group.last].width - measure.begin[group.first];
}

}  // namespace scenec::frontend::layout
