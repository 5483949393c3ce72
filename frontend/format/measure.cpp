#include "frontend/format/measure.hpp"

#include <algorithm>

#include "base/text.hpp"

namespace scenec::frontend::layout {

namespace {

std::uint32_t gap_width(const Plan& plan, std::uint32_t index) {
  const Token& token = plan.tokens[index];
  if (index == 0) return 0;
  const Token& before = plan.tokens[index - 1];
  if (token.comment_count == 0) return wants_blank(before, token) ? 1 : 0;
  std::uint32_t width = is_tight_behind(before.spacing) ? 0 : 1;
  for (std::uint32_t i = 0; i < token.comment_count; ++i) {
    const Comment& comment = plan.comments[token.first_comment + i];
    const std::size_t points =
        count_code_points(plan.text.substr(comment.begin, comment.end - comment.begin));
    width += (i > 0 ? 1u : 0u) + static_cast<std::uint32_t>(points);
  }
  return width + (is_tight_before(token.spacing) ? 0 : 1);
}

// A comment alone on its line keeps it, where a line may end.
std::uint32_t count_forced(const Plan& plan, const Token& token) {
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < token.comment_count; ++i) {
    const Comment& comment = plan.comments[token.first_comment + i];
    const bool is_last = i + 1 == token.comment_count;
    const std::uint32_t newlines_behind =
        is_last ? token.newlines : plan.comments[token.first_comment + i + 1].newlines;
    const bool is_alone = token.brk != Break::never && comment.newlines > 0 && newlines_behind > 0;
    if (comment.is_line || comment.spans_lines || is_alone) ++count;
  }
  return count;
}

bool may_break(const Plan& plan, const Token& token) {
  switch (token.brk) {
    case Break::never:
    case Break::annotation:
      break;
    case Break::element:
    case Break::closer:
      if (!plan.groups[token.group].hugs) return true;
      break;
    default:
      return true;
  }
  for (std::uint32_t i = 0; i < token.comment_count; ++i) {
    if (plan.comments[token.first_comment + i].is_line) return true;
  }
  return false;
}

}  // namespace

bool wants_blank(const Token& before, const Token& token) {
  switch (token.spacing) {
    case Spacing::mark:
    case Spacing::close:
    case Spacing::tight_open:
      return false;
    case Spacing::dot:
      return before.spacing == Spacing::number;
    default:
      return !is_tight_behind(before.spacing);
  }
}

bool has_line_end(const Plan& plan, const Token& token) {
  bool found = token.newlines > 0;
  for (std::uint32_t i = 0; i < token.comment_count; ++i) {
    found = found || plan.comments[token.first_comment + i].newlines > 0;
  }
  return found;
}

Measure measure(const Plan& plan) {
  Measure result;
  const auto count = static_cast<std::uint32_t>(plan.tokens.size());
  result.begin.resize(count);
  result.tail.resize(count);
  result.forced.resize(count);
  std::uint32_t column = 0;
  std::uint32_t forced = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    column += gap_width(plan, i);
    forced += count_forced(plan, plan.tokens[i]);
    result.begin[i] = column;
    result.forced[i] = forced;
    column += plan.tokens[i].width;
  }
  for (std::uint32_t i = count - 1; i-- > 0;) {
    const Token& next = plan.tokens[i + 1];
    if (may_break(plan, next)) {
      // The comma that a broken list gets behind its last element.
      const bool gets_comma = next.brk == Break::closer && plan.groups[next.group].takes_comma;
      result.tail[i] = gets_comma ? 1 : 0;
    } else {
      result.tail[i] = result.begin[i + 1] + next.width - result.begin[i] - plan.tokens[i].width +
                       result.tail[i + 1];
    }
  }
  return result;
}

}  // namespace scenec::frontend::layout
