// What both planners share: puts tokens and the comments between them into a plan, and counts the
// line ends of the source.
#pragma once

#include <cstdint>

#include "frontend/format/plan.hpp"

namespace scenec::frontend::layout {

class PlanBuilder {
 public:
  PlanBuilder(const grammar::SyntaxTree& tree, std::uint32_t indent);

  // Appends a token of the source with the comments before it.
  Token& add_token(std::uint32_t begin, std::uint32_t end);
  // Leaves a token of the source out; the comments before it go to the next one.
  void skip_token(std::uint32_t begin, std::uint32_t end);
  // Opens a group that begins with the next token.
  std::uint32_t open_group(GroupKind kind, std::uint32_t parent);
  // Ends a group with the token added last.
  void close_group(std::uint32_t group) { plan_.groups[group].last = last_token(); }

  [[nodiscard]] std::uint32_t last_token() const {
    return static_cast<std::uint32_t>(plan_.tokens.size()) - 1;
  }
  [[nodiscard]] Plan& plan() { return plan_; }
  [[nodiscard]] const Plan& plan() const { return plan_; }
  // Adds the end of the file and gives the plan away.
  [[nodiscard]] Plan finish();

 private:
  void pass_blanks(std::uint32_t to);
  void take_comments(std::uint32_t before);
  void let_marks_pass();

  const grammar::SyntaxTree& tree_;
  Plan plan_;
  std::size_t next_trivia_ = 0;
  std::uint32_t place_ = 0;
  std::uint32_t line_ = 0;
  std::uint32_t newlines_ = 0;  // since the token or comment before
  std::uint32_t gap_ = 0;       // first comment since the token added last
};

}  // namespace scenec::frontend::layout
