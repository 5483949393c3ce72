#include "grammar/tree_builder.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/assert.hpp"
#include "base/text.hpp"
#include "grammar/scan.hpp"
#include "grammar/text_checks.hpp"

namespace scenec::grammar {

namespace {

// People read the first dozen; beyond this the text is not in this language at all. With the
// message that says so they are the hundred that are printed.
constexpr std::uint32_t most_reports = 99;

TriviaKind trivia_kind(std::string_view comment) {
  if (comment.starts_with("/*")) return TriviaKind::block_comment;
  const bool documents = comment.starts_with("///") && !comment.starts_with("////");
  return documents ? TriviaKind::doc_comment : TriviaKind::line_comment;
}

// The comments between two tokens, of either dialect (a course comment starts with `#` or `//`).
void add_trivia(std::string_view text, std::uint32_t begin, std::uint32_t end, Dialect dialect,
                std::vector<Trivia>& trivia) {
  while (begin < end) {
    const char c = text[begin];
    if (c != '/' && c != '#') {
      ++begin;
      continue;
    }
    const std::uint32_t close =
        static_cast<std::uint32_t>(std::min<std::size_t>(scan::comment_end(text, begin), end));
    const bool native = dialect == Dialect::sdl;
    trivia.push_back(
        {native ? trivia_kind(text.substr(begin, close - begin)) : TriviaKind::line_comment, begin,
         close});
    begin = close;
  }
}

}  // namespace

void NodeStack::grow() {
  pieces_.push_back(std::make_unique_for_overwrite<SyntaxNode[]>(mask + 1));
}

// A node with `next` nodes in its subtree, `depth` ancestors and index i in post-order goes to
// i - (next - 1) + depth. Read from the end, ancestors come before what they hold.
NodeArray NodeStack::release_in_preorder() {
  NodeArray nodes(size_);
  std::vector<std::uint32_t> first_of_open;  // first index of the subtrees round the current node
  for (std::uint32_t index = size_; index-- > 0;) {
    const SyntaxNode& one = pieces_[index >> shift][index & mask];
    while (!first_of_open.empty() && index < first_of_open.back()) first_of_open.pop_back();
    const std::uint32_t first = index + 1 - one.next;
    const std::uint32_t target = first + static_cast<std::uint32_t>(first_of_open.size());
    if (one.next > 1) first_of_open.push_back(first);
    nodes[target] = {one.kind, one.begin, one.end, one.next + target};
    if ((index & mask) == 0) pieces_.resize(index >> shift);
  }
  size_ = 0;
  return nodes;
}

TreeBuilder::TreeBuilder(Dialect dialect, FileId file, std::string_view text, std::uint32_t begin,
                         DiagnosticSink& sink, const ParseLimits& limits)
    : dialect_(dialect),
      file_(file),
      text_(text),
      begin_(begin),
      sink_(sink),
      limits_(limits),
      shortest_limit_(std::min(limits.token, limits.string)) {}

void TreeBuilder::node(SyntaxKind kind, std::uint32_t mark) {
  if (mark == nodes_.size()) {
    const std::uint32_t place = last_end();
    nodes_.push({kind, place, place, 1});
    return;
  }
  nodes_.push({kind, nodes_[mark].begin, nodes_.back().end, nodes_.size() - mark + 1});
}

void TreeBuilder::adopt(std::uint32_t mark) {
  SyntaxNode& last = nodes_.back();
  if (nodes_.size() - mark == last.next) return;
  last.begin = nodes_[mark].begin;
  last.next = nodes_.size() - mark;
}

void TreeBuilder::error_node(std::uint32_t begin, std::uint32_t end) {
  if (begin == end) {
    nodes_.push({SyntaxKind::error, last_end(), last_end(), 1});
    return;
  }
  nodes_.push({SyntaxKind::error_text, begin, end, 1});
  nodes_.push({SyntaxKind::error, begin, end, 2});
}

SyntaxNode TreeBuilder::last_token() {
  for (std::uint32_t index = nodes_.size(); index > 0; --index) {
    if (is_token(nodes_[index - 1].kind)) return nodes_[index - 1];
  }
  return {SyntaxKind::error_text, 0, 0, 0};
}

void TreeBuilder::restore(Depth depth) {
  depth_ = depth.depth;
  openers_.resize(depth.openers);
}

void TreeBuilder::report(Diagnostic diagnostic) {
  if (reported_++ < most_reports) {
    if (!muted_) sink_.report(std::move(diagnostic));
    return;
  }
  if (muted_) throw Abandon{};
  sink_.report(Diagnostic(
      DiagnosticKind::too_many_syntax_errors, diagnostic.span,
      fmt::format("more than {} syntax errors; the rest of the file is not read", most_reports)));
  throw Abandon{};
}

void TreeBuilder::report(std::uint32_t found, Diagnostic diagnostic) {
  if (found == last_found_) return;
  last_found_ = found;
  report(std::move(diagnostic));
}

void TreeBuilder::limit_exceeded(Diagnostic diagnostic) {
  if (!muted_) sink_.report(std::move(diagnostic));
  throw Abandon{};
}

void TreeBuilder::nesting_exceeded(std::uint32_t begin, std::uint32_t end) {
  limit_exceeded(
      Diagnostic(DiagnosticKind::nesting_too_deep, span(begin, end),
                 fmt::format("nesting deeper than {} levels", limits_.nesting))
          .hint("blocks, brackets, `else if` and chains such as `a.b.c` count one level each"));
}

void TreeBuilder::check_token_limit(SyntaxKind kind, std::uint32_t begin, std::uint32_t end) {
  const bool is_string = kind == SyntaxKind::string;
  const std::uint32_t limit = is_string ? limits_.string : limits_.token;
  if (end - begin <= limit) return;
  limit_exceeded(Diagnostic(
      is_string ? DiagnosticKind::string_literal_too_long : DiagnosticKind::text_too_long,
      span(begin, end),
      fmt::format("{} of {} bytes; the limit is {} bytes",
                  is_string ? "a string" : "a word or number", end - begin, limit)));
}

std::uint32_t TreeBuilder::comment(std::uint32_t begin) {
  met_comment_ = true;
  const std::size_t end = scan::comment_end(text_, begin);
  if (end != std::string_view::npos) return static_cast<std::uint32_t>(end);
  const std::uint32_t file_end = static_cast<std::uint32_t>(text_.size());
  report(file_end,
         Diagnostic(DiagnosticKind::comment_unclosed, span(begin, begin + 2),
                    "this comment is never closed: expected `*/` before the end of the file"));
  return file_end;
}

std::uint32_t TreeBuilder::skip_trivia(std::uint32_t offset) {
  while (offset < text_.size()) {
    const char c = text_[offset];
    if (scan::is(c, scan::blank)) {
      ++offset;
    } else if (c == '/' &&
               (scan::at(text_, offset + 1) == '/' || scan::at(text_, offset + 1) == '*')) {
      offset = comment(offset);
    } else {
      break;
    }
  }
  return offset;
}

void TreeBuilder::abandon() {
  std::uint32_t begin = last_end();
  begin = dialect_ == Dialect::sdl ? static_cast<std::uint32_t>(scan::skip_trivia(text_, begin))
                                   : static_cast<std::uint32_t>(skip_course_trivia(text_, begin));
  const std::uint32_t end = static_cast<std::uint32_t>(text_.size());
  if (begin < end) nodes_.push({SyntaxKind::error_text, begin, end, 1});
  node(SyntaxKind::error, std::min(outermost_, nodes_.size()));
}

void TreeBuilder::admit() {
  constexpr std::uint64_t most = 0xFFFFFFF0u;  // offsets are 32 bits
  const std::uint64_t limit = std::min<std::uint64_t>(limits_.file, most);
  const std::size_t size = text_.size();
  if (size <= limit) {
    check_lines();
    check_characters();
    return;
  }
  if (size > most) text_ = {};
  limit_exceeded(
      Diagnostic(DiagnosticKind::text_too_long, span(0, 0),
                 fmt::format("the file has {} bytes; the limit is {} bytes", size, limit)));
}

void TreeBuilder::check_lines() {
  for (std::size_t begin = begin_; text_.size() - begin > limits_.line;) {
    const std::size_t end = std::min(text_.find('\n', begin), text_.size());
    if (end - begin > limits_.line) {
      const std::uint32_t start = static_cast<std::uint32_t>(begin);
      limit_exceeded(Diagnostic(DiagnosticKind::text_too_long, span(start, start + 1),
                                fmt::format("the line has {} bytes; the limit is {} bytes",
                                            end - begin, limits_.line))
                         .hint("geometry of that size belongs in a mesh file"));
    }
    if (end == text_.size()) return;
    begin = end + 1;
  }
}

void TreeBuilder::check_characters() {
  const CharacterFaults faults = character_faults(text_.substr(begin_), dialect_);
  const auto at_byte = [&](std::size_t begin, std::size_t size) {
    return span(static_cast<std::uint32_t>(begin_ + begin),
                static_cast<std::uint32_t>(begin_ + begin + size));
  };
  for (std::size_t bidi : faults.bidi_controls) {
    report(
        Diagnostic(
            DiagnosticKind::bidi_control,
            at_byte(bidi, static_cast<unsigned char>(text_[begin_ + bidi]) == 0xD8 ? 2 : 3),
            "a character that changes the direction of writing: the text is not what it looks like")
            .hint("remove it, or write it in a string as an escape such as `\\u{202e}`"));
  }
  if (faults.first_control == CharacterFaults::none &&
      faults.first_invalid == CharacterFaults::none)
    return;
  if (faults.first_control < faults.first_invalid) {
    const unsigned code = static_cast<unsigned char>(text_[begin_ + faults.first_control]);
    report(Diagnostic(DiagnosticKind::control_character, at_byte(faults.first_control, 1),
                      fmt::format("control character U+{:04X} in the text", code)));
  } else {
    const unsigned byte = static_cast<unsigned char>(text_[begin_ + faults.first_invalid]);
    report(Diagnostic(DiagnosticKind::text_not_utf8, at_byte(faults.first_invalid, 1),
                      fmt::format("byte 0x{:02X} is not part of valid UTF-8", byte))
               .hint("save the file as UTF-8"));
  }
  muted_ = true;
}

// Whatever is not in a token is blank or comment.
std::vector<Trivia> TreeBuilder::comments(std::span<const SyntaxNode> nodes) const {
  std::vector<Trivia> trivia;
  if (dialect_ == Dialect::sdl && !met_comment_) return trivia;
  std::uint32_t place = begin_ == 0 && text_.starts_with("\xEF\xBB\xBF") ? 3 : begin_;
  for (const SyntaxNode& one : nodes) {
    if (!is_token(one.kind)) continue;
    if (one.begin > place + 1) add_trivia(text_, place, one.begin, dialect_, trivia);
    place = one.end;
  }
  add_trivia(text_, place, static_cast<std::uint32_t>(text_.size()), dialect_, trivia);
  return trivia;
}

SyntaxTree TreeBuilder::finish(SyntaxKind root) {
  SCENEC_ASSERT(nodes_.size() > 0 && nodes_.back().kind == root &&
                nodes_.back().next == nodes_.size());
  NodeArray nodes = nodes_.release_in_preorder();
  std::vector<Trivia> trivia = comments(nodes.all());
  return SyntaxTree(file_, text_, std::move(nodes), std::move(trivia));
}

}  // namespace scenec::grammar
