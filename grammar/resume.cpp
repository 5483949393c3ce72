// Where reading goes on after an item was given up; see recovery.hpp.
#include "grammar/recovery.hpp"
#include "grammar/scan.hpp"

namespace scenec::grammar {

using scan::ItemStart;

namespace {

// End of the block that opens at `offset`, or of the text: a brace without partner is not reported
// here, as the item it belongs to already was.
std::uint32_t block_end(TreeBuilder& builder, std::uint32_t offset) {
  const std::string_view text = builder.text();
  std::uint32_t depth = 0;
  while (offset < text.size()) {
    if (text[offset] == '{') ++depth;
    const bool closes_one = text[offset] == '}';
    offset = static_cast<std::uint32_t>(scan::token_end(text, offset));
    if (closes_one && --depth == 0) return offset;
    offset = builder.skip_trivia(offset);
  }
  return offset;
}

}  // namespace

std::uint32_t resume_after(TreeBuilder& builder, std::uint32_t broken_at, std::uint32_t mark,
                           std::uint32_t open_brackets) {
  const std::string_view text = builder.text();
  const bool in_block = !builder.openers().empty();
  std::uint32_t offset = broken_at;
  std::uint32_t end = broken_at;  // of the last token skipped
  for (bool done = false; !done && offset < text.size(); offset = builder.skip_trivia(end)) {
    const bool must_move = builder.mark() == mark && offset == broken_at;
    const char c = text[offset];
    if (!must_move && scan::begins_line(text, offset)) {
      const ItemStart start = scan::item_start(text, offset);
      if (start == ItemStart::strong || (start == ItemStart::weak && open_brackets == 0)) break;
    }
    if (c == '}') {
      if (in_block || !must_move) break;
      done = true;
    }
    if (c == ';') done = true;
    if (c == '(' || c == '[') ++open_brackets;
    if ((c == ')' || c == ']') && open_brackets > 0) --open_brackets;
    if (c == '{') {
      end = block_end(builder, offset);
      const std::uint32_t next = builder.skip_trivia(end);
      done = open_brackets == 0 && text.substr(next, scan::token_end(text, next) - next) != "else";
      continue;
    }
    end = static_cast<std::uint32_t>(scan::token_end(text, offset));
  }
  if (end > broken_at) builder.skipped(broken_at, end);
  builder.node(SyntaxKind::error, mark);
  return builder.skip_trivia(end > broken_at ? end : broken_at);
}

}  // namespace scenec::grammar
