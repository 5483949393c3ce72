// Reads the words of one block of the generic course tree by the table: each with the values its
// row allows. Words without a reading, wrong values and stray values are reported here; a misspelt
// word is read as the one it stands for, so that it causes no second message.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "frontend/course/context.hpp"
#include "frontend/course/words.hpp"
#include "grammar/syntax_tree.hpp"

namespace scenec::frontend::course {

struct Number {
  double value = 0;
  Span span;
  std::string_view text;
};

// A word with what follows it.
struct Entry {
  const Word* word = nullptr;
  Span word_span;
  Span span;                    // word and values, without a block
  std::vector<Number> numbers;  // behind the word, or behind its name, or in its braces
  std::string_view name;        // file, word, or the word of an object
  Span name_span;
  grammar::NodeRef block;                   // of a block or an object
  std::vector<std::vector<Number>> points;  // one a bracket
  bool usable = false;                      // false: its values were wrong, and it was reported

  [[nodiscard]] Role role() const { return word->role; }
  [[nodiscard]] Span values_span() const;
};

class BlockReader {
 public:
  // `block` is a course_block or the file.
  BlockReader(Context& context, grammar::NodeRef block, Place place);
  // The next entry that has a reading and usable values.
  [[nodiscard]] std::optional<Entry> next();
  // The roles of words whose values were wrong: they are not missing.
  [[nodiscard]] bool was_tried(Role role) const;
  // A word had no reading or wrong values: what seems to be missing may be what it meant.
  [[nodiscard]] bool had_mistakes() const { return had_unknown_ || !tried_.empty(); }
  [[nodiscard]] bool had_unknown() const { return had_unknown_; }

 private:
  [[nodiscard]] bool at(grammar::SyntaxKind kind) const;
  void skip_stray();
  [[nodiscard]] std::optional<Entry> read_entry();
  [[nodiscard]] const Word* identify(grammar::NodeRef word);
  void skip_unknown_values();
  void read_numbers(std::vector<Number>& numbers);
  void read_points(Entry& entry);
  void read_braced(Entry& entry);
  void read_name(Entry& entry);
  bool read_block(Entry& entry);
  bool read_values(Entry& entry);
  void report_wrong_values(Entry& entry);
  void note_use(const Entry& entry);

  Context& context_;
  grammar::NodeRef block_;
  Place place_;
  std::vector<grammar::NodeRef> elements_;
  std::size_t at_ = 0;
  std::vector<Role> tried_;
  bool had_unknown_ = false;
};

// Only the numbers in a node, with brackets looked through.
[[nodiscard]] std::optional<Number> number_of(grammar::NodeRef node);

}  // namespace scenec::frontend::course
