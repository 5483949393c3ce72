// What both grammars build trees with: nodes pushed in post-order (a rollback is a truncation, a
// node takes what was pushed since its mark), the guards for limits, and reports that say each
// mistake once. Knows nothing of PEGTL.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.hpp"
#include "grammar/parse.hpp"
#include "grammar/syntax_tree.hpp"

namespace scenec::grammar {

// Thrown where a statement cannot go on; caught by the item that holds it. Already reported.
struct BrokenStatement {
  std::uint32_t offset = 0;  // of the token that does not fit
};
// Thrown when a limit is hit: nothing but the entry point catches it. Already reported.
struct Abandon {};

// Growing array in pieces: growth copies nothing, and pieces are given back from the end.
class NodeStack {
 public:
  [[nodiscard]] std::uint32_t size() const { return size_; }
  [[nodiscard]] SyntaxNode& operator[](std::uint32_t index) {
    return pieces_[index >> shift][index & mask];
  }
  [[nodiscard]] SyntaxNode& back() { return (*this)[size_ - 1]; }
  void push(const SyntaxNode& node) {
    if ((size_ & mask) == 0 && (size_ >> shift) == pieces_.size()) grow();
    pieces_[size_ >> shift][size_ & mask] = node;
    ++size_;
  }
  void truncate(std::uint32_t size) { size_ = size; }
  // The nodes, pushed in post-order, as one array in pre-order with `next` as an index; the stack
  // is empty then. Pieces are given back as they are read, so memory never doubles.
  [[nodiscard]] NodeArray release_in_preorder();

 private:
  static constexpr std::uint32_t shift = 14;
  static constexpr std::uint32_t mask = (1u << shift) - 1;
  void grow();

  std::vector<std::unique_ptr<SyntaxNode[]>> pieces_;
  std::uint32_t size_ = 0;
};

class TreeBuilder {
 public:
  // Reads `text` from `begin` on; offsets count from the begin of the text.
  TreeBuilder(Dialect dialect, FileId file, std::string_view text, std::uint32_t begin,
              DiagnosticSink& sink, const ParseLimits& limits);

  [[nodiscard]] std::string_view text() const { return text_; }
  [[nodiscard]] const ParseLimits& limits() const { return limits_; }
  [[nodiscard]] std::uint32_t offset_of(const char* place) const {
    return static_cast<std::uint32_t>(place - text_.data());
  }

  // Building. A mark is a place in the node stack.
  [[nodiscard]] std::uint32_t mark() const { return nodes_.size(); }
  [[nodiscard]] std::uint32_t mark_of_last() { return nodes_.size() - nodes_.back().next; }
  void token(SyntaxKind kind, std::uint32_t begin, std::uint32_t end) {
    if (end - begin > shortest_limit_) check_token_limit(kind, begin, end);
    nodes_.push({kind, begin, end, 1});
  }
  void node(SyntaxKind kind, std::uint32_t mark);
  void rollback(std::uint32_t mark) { nodes_.truncate(mark); }
  // The last node also takes what stands between `mark` and it (annotations before an item).
  void adopt(std::uint32_t mark);
  // An error node over `[begin, end)`; over nothing when the range is empty.
  void error_node(std::uint32_t begin, std::uint32_t end);
  // Bytes passed over by recovery, as a token of their own.
  void skipped(std::uint32_t begin, std::uint32_t end) {
    nodes_.push({SyntaxKind::error_text, begin, end, 1});
  }
  [[nodiscard]] SyntaxKind last_kind() {
    return nodes_.size() == 0 ? SyntaxKind::file : nodes_.back().kind;
  }
  // End of the last token, and the token itself (an empty node at 0 when there is none).
  [[nodiscard]] std::uint32_t last_end() { return nodes_.size() == 0 ? 0 : nodes_.back().end; }
  [[nodiscard]] SyntaxNode last_token();

  // Nesting: brackets of all sorts, and chains that nest in the tree (`a.b.c`, `else if`).
  void open(std::uint32_t begin) {
    openers_.push_back(begin);
    deepen(begin, begin + 1);
  }
  void close() {
    openers_.pop_back();
    --depth_;
  }
  void deepen(std::uint32_t begin, std::uint32_t end) {
    if (++depth_ > limits_.nesting) nesting_exceeded(begin, end);
  }
  struct Depth {
    std::uint32_t depth = 0;
    std::uint32_t openers = 0;
  };
  [[nodiscard]] Depth depth() const {
    return {depth_, static_cast<std::uint32_t>(openers_.size())};
  }
  void restore(Depth depth);
  [[nodiscard]] const std::vector<std::uint32_t>& openers() const { return openers_; }

  // Reports. `found` is the offset of the token that does not fit: a second report about the same
  // token is a consequence of the first and is dropped.
  [[nodiscard]] Span span(std::uint32_t begin, std::uint32_t end) const {
    return {file_, begin, end};
  }
  void report(std::uint32_t found, Diagnostic diagnostic);
  void report(Diagnostic diagnostic);
  [[nodiscard]] bool was_reported(std::uint32_t found) const { return found == last_found_; }
  // The last token is broken and swallowed what should follow it: no missing `;` or `)` after it.
  void forgive_after(std::uint32_t end) { forgiven_ = end; }
  [[nodiscard]] bool is_forgiven(std::uint32_t end) const { return forgiven_ == end; }
  [[noreturn]] void limit_exceeded(Diagnostic diagnostic);

  // A comment met by the grammar; reports once when it is never closed. Returns its end.
  [[nodiscard]] std::uint32_t comment(std::uint32_t begin);
  // First offset behind blanks and comments of native text.
  [[nodiscard]] std::uint32_t skip_trivia(std::uint32_t offset);

  // A block that lacks its `{` leaves a `}` behind; the next stray one is its own.
  void owe_closer() { ++owed_closers_; }
  [[nodiscard]] bool take_owed_closer() { return owed_closers_ > 0 && owed_closers_-- > 0; }

  // Begin of the outermost item being read: abandoning wraps from here.
  void begin_outermost() { outermost_ = mark(); }
  // Everything since the outermost item and the rest of the text becomes one error node.
  void abandon();
  // Checks size and characters of the text; abandons one that is too large.
  void admit();
  [[nodiscard]] SyntaxTree finish(SyntaxKind root);

 private:
  [[nodiscard]] std::vector<Trivia> comments(std::span<const SyntaxNode> nodes) const;
  void check_token_limit(SyntaxKind kind, std::uint32_t begin, std::uint32_t end);
  [[noreturn]] void nesting_exceeded(std::uint32_t begin, std::uint32_t end);
  void check_lines();
  void check_characters();

  Dialect dialect_;
  FileId file_;
  std::string_view text_;
  std::uint32_t begin_;
  DiagnosticSink& sink_;
  ParseLimits limits_;
  std::uint32_t shortest_limit_;
  NodeStack nodes_;
  std::vector<std::uint32_t> openers_;
  std::uint32_t depth_ = 0;
  std::uint32_t outermost_ = 0;
  std::uint32_t last_found_ = 0xFFFFFFFFu;
  std::uint32_t forgiven_ = 0xFFFFFFFFu;
  std::uint32_t owed_closers_ = 0;
  std::uint32_t reported_ = 0;
  bool met_comment_ = false;
  bool muted_ = false;  // the text is no text: its first bad byte was reported, that is enough
};

}  // namespace scenec::grammar
