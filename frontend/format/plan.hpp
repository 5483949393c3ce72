// What the layout works on: the tokens of a file in order, with the comments before each, the
// places where a line may end, and the groups that end all their lines or none. The planners (one a
// dialect) know the grammar; the layout knows columns.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "grammar/syntax_tree.hpp"

namespace scenec::frontend::layout {

inline constexpr std::uint32_t no_group = 0xFFFFFFFF;
inline constexpr std::uint64_t line_width = 100;

// What a token wants beside it on one line; `word` wants blanks.
enum class Spacing : std::uint8_t {
  word,
  number,      // `.` must not touch it
  tight_open,  // ( or [ behind what it applies to
  open,        // ( or [
  close,       // ) or ]
  mark,        // , ; :
  dot,
  prefix,  // @ and unary operators
};

// When the line ends before a token.
enum class Break : std::uint8_t {
  never,
  item,        // when its block is broken; the file always is
  element,     // when its bracket is broken
  operation,   // when its chain of operators is broken; continues the line
  closer,      // when its bracket or block is broken
  annotation,  // when it does so in the source
  wrap,        // when what follows does not fit; continues the line
  row,         // as wrap, and where it does so in the source
};

struct Comment {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
  std::uint8_t newlines = 0;  // before it, since the token or comment before it; at most 2
  bool is_line = false;       // reaches to the end of its line
  bool spans_lines = false;
};

struct Token {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
  std::uint32_t line = 0;          // of the source
  std::uint32_t width = 0;         // in code points
  std::uint32_t group = no_group;  // the one that decides its break
  std::uint32_t first_comment = 0;
  std::uint32_t comment_count = 0;
  std::uint8_t newlines = 0;  // as of a comment
  Spacing spacing = Spacing::word;
  Break brk = Break::never;
};

enum class GroupKind : std::uint8_t {
  block,
  branches,  // if and all its else: their blocks are broken together
  bracket,
  chain,
};
struct Group {
  GroupKind kind = GroupKind::block;
  std::uint32_t first = 0;  // tokens, inclusive
  std::uint32_t last = 0;
  std::uint32_t parent = no_group;
  bool takes_comma = false;  // a comma behind the last element when broken
  bool fills = false;        // elements share lines
  bool hugs = false;         // its only element is a bracket itself, which is broken in its stead
};

struct Plan {
  std::string_view text;
  std::uint32_t indent = 2;
  std::vector<Token> tokens;  // the last one is the empty end of the file
  std::vector<Comment> comments;
  std::vector<Group> groups;  // outer before inner, by first token
};

[[nodiscard]] Plan plan_sdl(const grammar::SyntaxTree& tree);
[[nodiscard]] Plan plan_course(const grammar::SyntaxTree& tree);

}  // namespace scenec::frontend::layout
