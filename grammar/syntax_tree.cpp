#include "grammar/syntax_tree.hpp"

#include <algorithm>
#include <string>

#include "base/text.hpp"

namespace scenec::grammar {

namespace {

constexpr std::string_view trivia_names[] = {"line_comment", "block_comment", "doc_comment"};

void add_line(std::string& out, std::size_t depth, std::string_view name) {
  out.append(2 * depth, ' ');
  out += name;
}

// The text between two places holds no more than blanks and exactly one line end.
bool is_one_line_end(std::string_view between) {
  std::size_t line_ends = 0;
  for (std::size_t i = 0; i < between.size(); ++i) {
    if (between[i] == '\r' && i + 1 < between.size() && between[i + 1] == '\n') continue;
    if (between[i] == '\n' || between[i] == '\r') {
      ++line_ends;
    } else if (between[i] != ' ' && between[i] != '\t') {
      return false;
    }
  }
  return line_ends == 1;
}

bool is_alone_on_line(std::string_view text, std::uint32_t begin) {
  while (begin > 0 && (text[begin - 1] == ' ' || text[begin - 1] == '\t')) --begin;
  return begin == 0 || text[begin - 1] == '\n' || text[begin - 1] == '\r' ||
         (begin == 3 && text.substr(0, 3) == "\xEF\xBB\xBF");
}

}  // namespace

std::string_view name_of(SyntaxKind kind) {
  static constexpr std::string_view names[] = {
#define SCENEC_SYNTAX(name, shape) #name,
#include "grammar/syntax_kind.def"
#undef SCENEC_SYNTAX
  };
  return names[static_cast<std::size_t>(kind)];
}

SyntaxTree::SyntaxTree(FileId file, std::string_view text, NodeArray nodes,
                       std::vector<Trivia> trivia)
    : file_(file), text_(text), nodes_(std::move(nodes)), trivia_(std::move(trivia)) {}

SyntaxTree SyntaxTree::of_file(FileId file, std::string_view text) const {
  return {file, text, nodes_, trivia_};
}

std::string SyntaxTree::documentation_of(NodeRef item) const {
  const std::uint32_t begin = item.span().begin;
  auto first = std::partition_point(trivia_.begin(), trivia_.end(),
                                    [begin](const Trivia& one) { return one.end <= begin; });
  const auto last = first;
  std::uint32_t below = begin;
  while (first != trivia_.begin()) {
    const Trivia& one = *(first - 1);
    const bool adjacent = is_one_line_end(text_.substr(one.end, below - one.end));
    if (one.kind != TriviaKind::doc_comment || !adjacent || !is_alone_on_line(text_, one.begin))
      break;
    below = one.begin;
    --first;
  }
  std::string documentation;
  for (auto one = first; one != last; ++one) {
    std::string_view line = text_.substr(one->begin + 3, one->end - one->begin - 3);
    if (line.starts_with(' ')) line.remove_prefix(1);
    while (line.ends_with(' ') || line.ends_with('\t')) line.remove_suffix(1);
    if (one != first) documentation += '\n';
    documentation += line;
  }
  return documentation;
}

std::string dump_tree(const SyntaxTree& tree) {
  std::string out;
  std::vector<std::uint32_t> open_ends;  // `next` of the nodes round the current one
  auto comment = tree.trivia().begin();
  const auto add_comments_before = [&](std::uint32_t offset) {
    for (; comment != tree.trivia().end() && comment->begin < offset; ++comment) {
      add_line(out, open_ends.size(), "comment ");
      out += trivia_names[static_cast<std::size_t>(comment->kind)];
      out += ' ' +
             quoted_string(tree.text().substr(comment->begin, comment->end - comment->begin)) +
             '\n';
    }
  };
  for (std::uint32_t index = 0; index < tree.nodes().size(); ++index) {
    const SyntaxNode& node = tree.nodes()[index];
    while (!open_ends.empty() && open_ends.back() <= index) open_ends.pop_back();
    // Comments before the first token stand under the root, not beside it.
    if (index > 0) add_comments_before(node.begin);
    add_line(out, open_ends.size(), name_of(node.kind));
    if (is_token(node.kind)) {
      out += ' ' + quoted_string(tree.text().substr(node.begin, node.end - node.begin));
    }
    out += '\n';
    open_ends.push_back(node.next);
  }
  open_ends.resize(1);
  add_comments_before(0xFFFFFFFFu);
  return out;
}

std::string reassembled_text(const SyntaxTree& tree) {
  std::string out;
  out.reserve(tree.text().size());
  auto comment = tree.trivia().begin();
  std::uint32_t place = 0;
  const auto append = [&](std::uint32_t begin, std::uint32_t end) {
    for (; place < begin; ++place) {
      // Between the pieces there may be blanks only; anything else was lost from the tree.
      const char c = tree.text()[place];
      const bool kept = c == ' ' || (c >= '\t' && c <= '\r') ||
                        (place < 3 && tree.text().starts_with("\xEF\xBB\xBF"));
      if (kept) out += c;
    }
    out += tree.text().substr(begin, end - begin);
    place = end;
  };
  for (const SyntaxNode& node : tree.nodes()) {
    if (!is_token(node.kind)) continue;
    for (; comment != tree.trivia().end() && comment->begin < node.begin; ++comment)
      append(comment->begin, comment->end);
    append(node.begin, node.end);
  }
  for (; comment != tree.trivia().end(); ++comment) append(comment->begin, comment->end);
  append(static_cast<std::uint32_t>(tree.text().size()),
         static_cast<std::uint32_t>(tree.text().size()));
  return out;
}

}  // namespace scenec::grammar
