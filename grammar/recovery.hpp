// What native parsing does where a required part does not come: says so once, then either goes on
// as if it were there (zero width) or gives the item up and finds where the next one begins.
#pragma once

#include <cstdint>
#include <string_view>

#include "grammar/tree_builder.hpp"

namespace scenec::grammar {

enum class Repair : std::uint8_t {
  give_up,      // report and leave the item
  semicolon,    // zero width when an item, `}` or the end follows
  closer,       // zero width when the statement ends; a wrong closer is taken for it
  list_closer,  // the same; a `,` could also come
  value,        // an empty error node when nothing stands where a value belongs
  name,         // a reserved word is taken for it
  type,         // an empty error node
  colon,        // `=` is taken for it
  assign,       // `:` is taken for it
  block,        // leaves a `}` behind
  item,         // nothing here begins an item
  edition,      // a file without `sdl 1;`
};

struct Expectation {
  std::string_view what;  // as messages say it, with its own back quotes
  Repair repair = Repair::give_up;
};
// sdl_messages.hpp has one for every rule that occurs as `expect<rule>`.
template <class Rule>
struct expectation;

// Returns where reading goes on; throws BrokenStatement when the item cannot be kept.
[[nodiscard]] std::uint32_t repair_missing(TreeBuilder& builder, const Expectation& expected,
                                           std::uint32_t offset);

// After a BrokenStatement: turns what was pushed since `mark` and what is skipped into one error
// node. `open_brackets` counts the `(` and `[` of the item that were open where it broke.
// Skipping takes balanced braces whole and stops behind `;`, before `}` and before a line that
// begins with an item. Returns where the next item begins.
[[nodiscard]] std::uint32_t resume_after(TreeBuilder& builder, std::uint32_t broken_at,
                                         std::uint32_t mark, std::uint32_t open_brackets);

// Reports of literals that are taken as they are.
void check_string(TreeBuilder& builder, std::uint32_t begin, std::uint32_t end);
void check_edition(TreeBuilder& builder, std::uint32_t begin, std::uint32_t end);
void report_bare_fraction(TreeBuilder& builder, std::uint32_t begin, std::uint32_t end);
void report_bad_color(TreeBuilder& builder, std::uint32_t begin, std::uint32_t end);
void report_colon_for_equals(TreeBuilder& builder, std::uint32_t colon);
void report_touching_percent(TreeBuilder& builder, std::uint32_t percent);
void report_chained_comparison(TreeBuilder& builder, std::uint32_t begin, std::uint32_t end);
// `1 m`: true when a unit stands, after blanks, where `offset` is and belongs to the number before.
[[nodiscard]] bool is_detached_unit(TreeBuilder& builder, std::uint32_t offset);
void report_detached_unit(TreeBuilder& builder, std::uint32_t begin, std::uint32_t end);

}  // namespace scenec::grammar
