#include "frontend/format/plan_builder.hpp"

#include <algorithm>

#include "base/text.hpp"

namespace scenec::frontend::layout {

namespace {

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

// CR LF is one line end, a lone CR is one too.
std::uint32_t count_line_ends(std::string_view text) {
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\n' || (text[i] == '\r' && (i + 1 == text.size() || text[i + 1] != '\n'))) {
      ++count;
    }
  }
  return count;
}

std::uint8_t at_most_two(std::uint32_t count) {
  return static_cast<std::uint8_t>(std::min(count, 2u));
}

}  // namespace

PlanBuilder::PlanBuilder(const grammar::SyntaxTree& tree, std::uint32_t indent) : tree_(tree) {
  plan_.text = tree.text();
  plan_.indent = indent;
  const auto is_leaf = [](const grammar::SyntaxNode& node) { return grammar::is_token(node.kind); };
  const auto& nodes = tree.nodes();
  const auto count = std::count_if(nodes.begin(), nodes.end(), is_leaf);
  plan_.tokens.reserve(static_cast<std::size_t>(count) + 1);
  plan_.comments.reserve(tree.trivia().size());
  if (plan_.text.starts_with(byte_order_mark)) place_ = byte_order_mark.size();
}

void PlanBuilder::pass_blanks(std::uint32_t to) {
  const std::uint32_t count = count_line_ends(plan_.text.substr(place_, to - place_));
  line_ += count;
  newlines_ += count;
  place_ = to;
}

void PlanBuilder::take_comments(std::uint32_t before) {
  const auto& trivia = tree_.trivia();
  for (; next_trivia_ < trivia.size() && trivia[next_trivia_].begin < before; ++next_trivia_) {
    const grammar::Trivia& one = trivia[next_trivia_];
    pass_blanks(one.begin);
    const std::uint32_t inside = count_line_ends(plan_.text.substr(one.begin, one.end - one.begin));
    const bool is_line = one.kind != grammar::TriviaKind::block_comment;
    plan_.comments.push_back({one.begin, one.end, at_most_two(newlines_), is_line, inside > 0});
    line_ += inside;
    place_ = one.end;
    newlines_ = 0;
  }
  pass_blanks(before);
}

Token& PlanBuilder::add_token(std::uint32_t begin, std::uint32_t end) {
  take_comments(begin);
  Token& token = plan_.tokens.emplace_back();
  token.begin = begin;
  token.end = end;
  token.line = line_;
  token.width =
      static_cast<std::uint32_t>(count_code_points(plan_.text.substr(begin, end - begin)));
  token.first_comment = gap_;
  token.comment_count = static_cast<std::uint32_t>(plan_.comments.size()) - gap_;
  token.newlines = at_most_two(newlines_);
  gap_ = static_cast<std::uint32_t>(plan_.comments.size());
  place_ = end;
  newlines_ = 0;
  return token;
}

void PlanBuilder::skip_token(std::uint32_t begin, std::uint32_t end) {
  take_comments(begin);
  place_ = end;
}

std::uint32_t PlanBuilder::open_group(GroupKind kind, std::uint32_t parent) {
  Group group;
  group.kind = kind;
  group.first = static_cast<std::uint32_t>(plan_.tokens.size());
  group.parent = parent;
  plan_.groups.push_back(group);
  return static_cast<std::uint32_t>(plan_.groups.size()) - 1;
}

// `a // x` and then `;` on the next line: the mark goes before the comment, unless a line comment
// that follows it would then begin a line (a `///` there would document what comes next). A block
// comment documents nothing, so it holds nothing up.
void PlanBuilder::let_marks_pass() {
  for (std::size_t i = 1; i + 1 < plan_.tokens.size(); ++i) {
    Token& mark = plan_.tokens[i];
    Token& next = plan_.tokens[i + 1];
    if (mark.comment_count != 1 || mark.spacing != Spacing::mark) continue;
    const Comment& comment = plan_.comments[mark.first_comment];
    if (!comment.is_line || comment.newlines > 0) continue;
    if (next.comment_count > 0 && plan_.comments[next.first_comment].newlines == 0 &&
        plan_.comments[next.first_comment].is_line) {
      continue;
    }
    mark.comment_count = 0;
    mark.newlines = 0;
    next.first_comment = mark.first_comment;
    ++next.comment_count;
    if (next.comment_count == 1) next.newlines = std::max<std::uint8_t>(next.newlines, 1);
  }
}

Plan PlanBuilder::finish() {
  const auto size = static_cast<std::uint32_t>(plan_.text.size());
  add_token(size, size).brk = Break::item;
  let_marks_pass();
  // Marks that were left out or moved may have held the line end behind a comment.
  for (Token& token : plan_.tokens) {
    for (std::uint32_t i = 1; i < token.comment_count; ++i) {
      Comment& comment = plan_.comments[token.first_comment + i];
      if (plan_.comments[token.first_comment + i - 1].is_line && comment.newlines == 0) {
        comment.newlines = 1;
      }
    }
    const bool behind_line = token.comment_count > 0 &&
                             plan_.comments[token.first_comment + token.comment_count - 1].is_line;
    if (behind_line && token.newlines == 0) token.newlines = 1;
  }
  return std::move(plan_);
}

}  // namespace scenec::frontend::layout
