// The plan of a course file. Its tree knows words and values only, so what is a key is decided
// here: a word is the value of the key before it when that key may take a word and both stand on
// one line.
#include <string_view>
#include <unordered_map>

#include "frontend/course/words.hpp"
#include "frontend/format/plan_builder.hpp"

namespace scenec::frontend::layout {

namespace {

using grammar::SyntaxKind;
using grammar::SyntaxNode;

constexpr std::uint32_t indent_of_blocks = 4;  // what course files have always used
// As many numbers after one key are a matrix or a list of points, whose rows the author has chosen.
constexpr std::uint32_t fewest_numbers_with_rows = 9;

class Vocabulary {
 public:
  Vocabulary() {
    for (const course::Word& word : course::all_words()) {
      const bool takes = allows(word.values, course::Values::word) ||
                         allows(word.values, course::Values::file_numbers) ||
                         allows(word.values, course::Values::object);
      bool& known = takes_word_[word.text];
      known = known || takes;
    }
  }
  // Unknown words may take one.
  [[nodiscard]] bool may_take_word(std::string_view key) const {
    const auto found = takes_word_.find(key);
    return found == takes_word_.end() || found->second;
  }

 private:
  std::unordered_map<std::string_view, bool> takes_word_;
};

// What the elements read so far in one block lead to.
struct Entry {
  std::uint32_t group = no_group;
  std::uint32_t next = 0;  // of the block's node
  bool is_block = true;    // else a bracket
  bool begins = true;      // the next element begins an entry
  std::string_view key;    // when the last element was a key
  bool after_value = false;
  std::uint32_t numbers = 0;
  std::uint32_t brackets = 0;
  std::vector<std::uint32_t> values;  // tokens that begin a value
};

class Walk {
 public:
  explicit Walk(const grammar::SyntaxTree& tree) : tree_(tree), builder_(tree, indent_of_blocks) {}

  Plan run() {
    const auto& nodes = tree_.nodes();
    for (std::uint32_t index = 0; index < nodes.size(); ++index) {
      while (!open_.empty() && open_.back().next <= index) leave();
      if (grammar::is_token(nodes[index].kind)) {
        add_token(nodes[index]);
      } else {
        enter(nodes[index], index);
      }
    }
    while (!open_.empty()) leave();
    return builder_.finish();
  }

 private:
  void enter(const SyntaxNode& node, std::uint32_t index) {
    if (node.kind == SyntaxKind::course_word || node.kind == SyntaxKind::course_number) return;
    Entry entry;
    entry.next = node.next;
    if (index > 0) {
      Entry& around = open_.back();
      entry.is_block = node.kind == SyntaxKind::course_block;
      entry.group = around.group;
      if (entry.is_block) {
        if (around.begins) expect_item(around);
        entry.group = builder_.open_group(GroupKind::block, around.group);
      } else {
        expect_value(around);
        ++around.brackets;
      }
    }
    open_.push_back(std::move(entry));
  }

  void leave() {
    Entry entry = std::move(open_.back());
    open_.pop_back();
    if (entry.is_block) end_entry(entry);
    if (open_.empty()) return;
    if (entry.is_block) {
      builder_.close_group(entry.group);
      end_entry(open_.back());
    }
    open_.back().after_value = true;
  }

  void add_token(const SyntaxNode& node) {
    Entry& entry = open_.back();
    if (node.kind == SyntaxKind::punctuation) {
      Token& token = put(node);
      const char mark = tree_.text()[node.begin];
      if (mark == '}') {
        token.brk = Break::closer;
        token.group = entry.group;
      }
      return;
    }
    if (node.kind == SyntaxKind::number) {
      expect_value(entry);
      ++entry.numbers;
      put(node);
      entry.after_value = true;
      return;
    }
    add_word(entry, node);
  }

  void add_word(Entry& entry, const SyntaxNode& node) {
    const std::string_view text = tree_.text().substr(node.begin, node.end - node.begin);
    Token& token = put(node);
    if (!entry.is_block) return;
    const bool is_value = !entry.begins && !entry.after_value && token.newlines == 0 &&
                          token.comment_count == 0 && words_.may_take_word(entry.key);
    entry.after_value = is_value;
    if (is_value) return;
    end_entry(entry);
    token.brk = Break::item;
    token.group = entry.group;
    entry.begins = false;
    entry.after_value = false;
    entry.key = text;
  }

  // A value: the first thing of a block, or something behind a key.
  void expect_value(Entry& entry) {
    if (entry.is_block && entry.begins) {
      expect_item(entry);
      return;
    }
    if (entry.is_block) entry.values.push_back(builder_.last_token() + 1);
    pending_ = Break::wrap;
    pending_group_ = entry.group;
  }

  void expect_item(Entry& entry) {
    pending_ = Break::item;
    pending_group_ = entry.group;
    entry.begins = false;
    entry.key = {};
  }

  void end_entry(Entry& entry) {
    if (entry.brackets > 0 || entry.numbers >= fewest_numbers_with_rows) {
      for (const std::uint32_t value : entry.values) {
        builder_.plan().tokens[value].brk = Break::row;
      }
    }
    entry.values.clear();
    entry.numbers = 0;
    entry.brackets = 0;
    entry.begins = true;
  }

  Token& put(const SyntaxNode& node) {
    Token& token = builder_.add_token(node.begin, node.end);
    token.brk = pending_;
    token.group = pending_group_;
    pending_ = Break::never;
    pending_group_ = no_group;
    return token;
  }

  const grammar::SyntaxTree& tree_;
  PlanBuilder builder_;
  Vocabulary words_;
  std::vector<Entry> open_;
  Break pending_ = Break::never;
  std::uint32_t pending_group_ = no_group;
};

}  // namespace

Plan plan_course(const grammar::SyntaxTree& tree) {
  return Walk(tree).run();
}

}  // namespace scenec::frontend::layout
