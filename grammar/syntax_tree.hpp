// The lossless tree both dialects are parsed into: a flat array of nodes in pre-order. Nothing is
// lost (comments are trivia, broken text is error nodes) and nothing is recursive: trees of any
// shape are walked, copied and destroyed by loops.
#pragma once

#include <cstdint>
#include <iterator>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/span.hpp"

namespace scenec::grammar {

enum class SyntaxKind : std::uint8_t {
#define SCENEC_SYNTAX(name, shape) name,
#include "grammar/syntax_kind.def"
#undef SCENEC_SYNTAX
};
[[nodiscard]] std::string_view name_of(SyntaxKind kind);
[[nodiscard]] constexpr bool is_token(SyntaxKind kind) {
  return kind <= SyntaxKind::error_text;
}

// Without initialisers, so that large arrays of nodes are written once.
struct SyntaxNode {
  SyntaxKind kind;
  std::uint32_t begin;  // of the first token; an empty node stands where it was expected
  std::uint32_t end;    // one past the last token
  std::uint32_t next;   // index behind this node's subtree
};

// Nodes in one piece, left as they are until they are written; copies share them.
class NodeArray {
 public:
  NodeArray() = default;
  explicit NodeArray(std::size_t size)
      : nodes_(std::make_shared_for_overwrite<SyntaxNode[]>(size)), size_(size) {}
  [[nodiscard]] SyntaxNode& operator[](std::size_t index) {
    return nodes_[static_cast<std::ptrdiff_t>(index)];
  }
  [[nodiscard]] std::span<const SyntaxNode> all() const { return {nodes_.get(), size_}; }

 private:
  std::shared_ptr<SyntaxNode[]> nodes_;
  std::size_t size_ = 0;
};

enum class TriviaKind : std::uint8_t { line_comment, block_comment, doc_comment };
struct Trivia {
  TriviaKind kind;
  std::uint32_t begin = 0;
  std::uint32_t end = 0;  // without the line end
};

class SyntaxTree;

// A node of a tree: a pair of pointer and index, copied freely, valid while the tree lives.
class NodeRef {
 public:
  class Iterator {
   public:
    using value_type = NodeRef;
    using difference_type = std::ptrdiff_t;
    using iterator_category = std::forward_iterator_tag;
    Iterator() = default;
    Iterator(const SyntaxTree* tree, std::uint32_t index) : tree_(tree), index_(index) {}
    NodeRef operator*() const { return {tree_, index_}; }
    Iterator& operator++();
    Iterator operator++(int) {
      Iterator old = *this;
      ++*this;
      return old;
    }
    friend bool operator==(const Iterator&, const Iterator&) = default;

   private:
    const SyntaxTree* tree_ = nullptr;
    std::uint32_t index_ = 0;
  };
  struct Children {
    Iterator first, last;
    [[nodiscard]] Iterator begin() const { return first; }
    [[nodiscard]] Iterator end() const { return last; }
    [[nodiscard]] bool empty() const { return first == last; }
  };

  NodeRef() = default;
  NodeRef(const SyntaxTree* tree, std::uint32_t index) : tree_(tree), index_(index) {}

  explicit operator bool() const { return tree_ != nullptr; }
  [[nodiscard]] std::uint32_t index() const { return index_; }
  [[nodiscard]] const SyntaxTree& tree() const { return *tree_; }
  [[nodiscard]] SyntaxKind kind() const;
  [[nodiscard]] bool is(SyntaxKind kind_wanted) const { return kind() == kind_wanted; }
  [[nodiscard]] Span span() const;
  [[nodiscard]] std::string_view text() const;
  [[nodiscard]] Children children() const;  // tokens and nodes in order of the text
  // First child of a kind, or an empty reference.
  [[nodiscard]] NodeRef find_child(SyntaxKind kind_wanted) const;
  friend bool operator==(const NodeRef&, const NodeRef&) = default;

 private:
  const SyntaxTree* tree_ = nullptr;
  std::uint32_t index_ = 0;
};

class SyntaxTree {
 public:
  SyntaxTree() = default;
  // `text` must outlive the tree (the SourceMap owns it). nodes[0] is the root.
  SyntaxTree(FileId file, std::string_view text, NodeArray nodes, std::vector<Trivia> trivia);
  // The same tree for another file with the same text.
  [[nodiscard]] SyntaxTree of_file(FileId file, std::string_view text) const;

  [[nodiscard]] FileId file() const { return file_; }
  [[nodiscard]] std::string_view text() const { return text_; }
  [[nodiscard]] NodeRef root() const { return {this, 0}; }
  [[nodiscard]] std::span<const SyntaxNode> nodes() const { return nodes_.all(); }
  [[nodiscard]] const std::vector<Trivia>& trivia() const { return trivia_; }  // sorted by offset
  // The text of the `///` comments bound to a declaration: those on the lines just above it, joined
  // by line ends, without slashes and one leading blank; empty when there are none.
  [[nodiscard]] std::string documentation_of(NodeRef item) const;

 private:
  FileId file_;
  std::string_view text_;
  NodeArray nodes_;
  std::vector<Trivia> trivia_;
};

inline NodeRef::Iterator& NodeRef::Iterator::operator++() {
  index_ = tree_->nodes()[index_].next;
  return *this;
}
inline SyntaxKind NodeRef::kind() const {
  return tree_->nodes()[index_].kind;
}
inline Span NodeRef::span() const {
  const SyntaxNode& node = tree_->nodes()[index_];
  return {tree_->file(), node.begin, node.end};
}
inline std::string_view NodeRef::text() const {
  const SyntaxNode& node = tree_->nodes()[index_];
  return tree_->text().substr(node.begin, node.end - node.begin);
}
inline NodeRef::Children NodeRef::children() const {
  return {Iterator(tree_, index_ + 1), Iterator(tree_, tree_->nodes()[index_].next)};
}
inline NodeRef NodeRef::find_child(SyntaxKind kind_wanted) const {
  for (NodeRef child : children()) {
    if (child.is(kind_wanted)) return child;
  }
  return {};
}

// One line a node, indented, tokens with their text, trivia as `comment` lines: the text of
// `scenec dump --stage tree` and of the parse goldens.
[[nodiscard]] std::string dump_tree(const SyntaxTree& tree);
// The text put together again from tokens, trivia and the blanks between them; equals tree.text().
[[nodiscard]] std::string reassembled_text(const SyntaxTree& tree);

}  // namespace scenec::grammar
