#include "frontend/format/layout.hpp"

#include <algorithm>

#include "base/text.hpp"
#include "frontend/format/comment_text.hpp"
#include "frontend/format/measure.hpp"

namespace scenec::frontend::layout {

namespace {

enum class Mode : std::uint8_t { flat, broken, hugging };

// Indentation inside a broken block or bracket, and of what closes it.
struct Container {
  std::uint64_t inside = 0;
  std::uint64_t closer = 0;
};

class Layout {
 public:
  explicit Layout(const Plan& plan)
      : plan_(plan), measure_(measure(plan)), modes_(plan.groups.size(), Mode::flat) {
    out_.reserve(plan.text.size() + plan.text.size() / 4);
  }

  std::string run() {
    std::uint32_t next_group = 0;
    for (std::uint32_t i = 0; i < plan_.tokens.size(); ++i) {
      const Token& token = plan_.tokens[i];
      write_gap(i);
      for (; next_group < plan_.groups.size() && plan_.groups[next_group].first == i;
           ++next_group) {
        modes_[next_group] = mode_of(plan_.groups[next_group]);
      }
      write(plan_.text.substr(token.begin, token.end - token.begin), token.width);
      if (next_group > 0) enter(i, next_group);
    }
    if (!out_.empty() && !out_.ends_with('\n')) out_ += '\n';
    return std::move(out_);
  }

 private:
  Mode mode_of(const Group& group) const {
    if (group.parent != no_group && modes_[group.parent] == Mode::flat) return Mode::flat;
    const bool may_be_flat = is_block(group) ? is_on_one_line(group) : !is_forced(measure_, group);
    if (group.kind == GroupKind::block && is_empty(group)) return Mode::flat;
    if (group.kind == GroupKind::block && group.parent != no_group &&
        plan_.groups[group.parent].kind == GroupKind::branches) {
      return Mode::broken;
    }
    const std::uint64_t end =
        column_ + width_of(plan_, measure_, group) + measure_.tail[group.last];
    if (may_be_flat && end <= line_width) return Mode::flat;
    return group.hugs ? Mode::hugging : Mode::broken;
  }

  static bool is_block(const Group& group) {
    return group.kind == GroupKind::block || group.kind == GroupKind::branches;
  }
  bool is_on_one_line(const Group& group) const {
    return plan_.tokens[group.first].line == plan_.tokens[group.last].line;
  }
  bool is_empty(const Group& group) const {
    return group.first + 1 == group.last && plan_.tokens[group.last].comment_count == 0;
  }

  // The groups that were opened at token `i` and are broken indent what follows. Only the innermost
  // of them can be a bracket or block: its first token is its own bracket.
  void enter(std::uint32_t i, std::uint32_t group_end) {
    const Group& group = plan_.groups[group_end - 1];
    if (group.first != i || modes_[group_end - 1] != Mode::broken) return;
    if (group.kind == GroupKind::bracket) {
      containers_.push_back({line_indent_ + plan_.indent, line_indent_});
    } else if (group.kind == GroupKind::block) {
      const std::uint64_t outer = containers_.back().inside;
      containers_.push_back({outer + plan_.indent, outer});
    }
  }

  bool is_broken(std::uint32_t group) const {
    return group == no_group || modes_[group] == Mode::broken;
  }
  bool fits(std::uint32_t i) const {
    const std::uint64_t before = measure_.begin[i - 1] + plan_.tokens[i - 1].width;
    const std::uint64_t width = measure_.begin[i] + plan_.tokens[i].width - before;
    return column_ + width + measure_.tail[i] <= line_width;
  }
  bool breaks_before(std::uint32_t i) const {
    const Token& token = plan_.tokens[i];
    const bool comment_breaks = token.comment_count > 0 && has_line_end(plan_, token);
    switch (token.brk) {
      case Break::never:
        return false;
      case Break::item:
      case Break::operation:
      case Break::closer:
        return is_broken(token.group);
      case Break::element: {
        if (!is_broken(token.group)) return false;
        const Group& group = plan_.groups[token.group];
        if (!group.fills || i == group.first + 1) return true;
        return comment_breaks || !fits(i);
      }
      case Break::annotation:
        return has_line_end(plan_, token);
      case Break::wrap:
      case Break::row:
        if (!is_broken(token.group)) return false;
        return comment_breaks || (token.brk == Break::row && token.newlines > 0) || !fits(i);
    }
    return false;
  }

  // ---- writing
  void write(std::string_view text, std::uint64_t width) {
    out_ += text;
    column_ += width;
  }
  void write_blank() { write(" ", 1); }
  void new_line(std::uint64_t indent) {
    if (!out_.empty()) out_ += '\n';
    out_.append(indent, ' ');
    column_ = indent;
    line_indent_ = indent;
  }
  void write_comment(const Comment& comment, bool begins_line) {
    std::string text = comment_text(plan_.text.substr(comment.begin, comment.end - comment.begin));
    const bool began_line = comment.newlines > 0 || comment.begin == 0;
    if (begins_line && began_line && comment.spans_lines) {
      text = shifted_lines(text, source_indent(comment), column_);
    }
    const std::size_t last_line = text.rfind('\n');
    if (last_line == std::string::npos) {
      write(text, count_code_points(text));
    } else {
      out_ += text;
      column_ = count_code_points(std::string_view(text).substr(last_line + 1));
    }
  }
  // Blanks before a comment that begins its line.
  std::size_t source_indent(const Comment& comment) const {
    std::size_t blanks = 0;
    while (blanks < comment.begin && (plan_.text[comment.begin - blanks - 1] == ' ' ||
                                      plan_.text[comment.begin - blanks - 1] == '\t')) {
      ++blanks;
    }
    return blanks;
  }
  const Comment& comment_of(const Token& token, std::uint32_t i) const {
    return plan_.comments[token.first_comment + i];
  }
  std::uint64_t continued() const { return containers_.back().inside + plan_.indent; }

  void write_gap(std::uint32_t i) {
    const Token& token = plan_.tokens[i];
    const bool breaks = breaks_before(i);
    if (token.brk == Break::closer && is_broken(token.group) &&
        plan_.groups[token.group].takes_comma) {
      write(",", 1);
    }
    if (breaks) {
      write_broken_gap(i);
    } else {
      write_flat_gap(i);
    }
  }

  // Everything on the line it is on; only comments that reach to the end of their line end it.
  void write_flat_gap(std::uint32_t i) {
    const Token& token = plan_.tokens[i];
    const Token* before = i > 0 ? &plan_.tokens[i - 1] : nullptr;
    if (token.comment_count == 0) {
      if (before != nullptr && wants_blank(*before, token)) write_blank();
      return;
    }
    bool behind_line = false;
    for (std::uint32_t k = 0; k < token.comment_count; ++k) {
      const Comment& comment = comment_of(token, k);
      const bool begins_line = behind_line || (comment.is_line && comment.newlines > 0);
      if (begins_line) {
        new_line(continued());
      } else if (k > 0 ||
                 (before != nullptr && (comment.is_line || !is_tight_behind(before->spacing)))) {
        write_blank();
      }
      write_comment(comment, begins_line);
      behind_line = comment.is_line;
    }
    if (behind_line) {
      new_line(continued());
    } else if (!is_tight_before(token.spacing)) {
      write_blank();
    }
  }

  // The line ends; comments keep to the line of the source they were on.
  void write_broken_gap(std::uint32_t i) {
    const Token& token = plan_.tokens[i];
    const bool is_end = i + 1 == plan_.tokens.size();
    const bool closes = is_end || token.brk == Break::closer;
    const std::uint64_t inside = inside_of(token);
    const bool blank_lines =
        token.brk == Break::item || (closes && plan_.groups[token.group].kind == GroupKind::block);
    std::uint32_t k = 0;
    if (i > 0 && (closes || has_line_end(plan_, token))) {
      for (; k < token.comment_count && comment_of(token, k).newlines == 0; ++k) {
        if (column_ > 0) write_blank();
        write_comment(comment_of(token, k), false);
      }
    }
    // No blank line at the beginning or the end of a block.
    const bool opens = k == 0 && (i == 0 || (blank_lines && opens_block(i - 1)));
    bool is_first = true;
    for (; k < token.comment_count; ++k) {
      const Comment& comment = comment_of(token, k);
      const bool begins_line = is_first || comment.newlines > 0;
      if (begins_line) {
        if (blank_lines && comment.newlines > 1 && !(opens && is_first)) out_ += '\n';
        new_line(inside);
      } else {
        write_blank();
      }
      write_comment(comment, begins_line);
      is_first = false;
    }
    if (!is_first && token.newlines == 0 && !closes) {
      write_blank();
      return;
    }
    if (is_end) return;
    if (blank_lines && !closes && token.newlines > 1 && !(opens && is_first)) out_ += '\n';
    if (closes) {
      new_line(containers_.back().closer);
      containers_.pop_back();
    } else {
      new_line(inside);
    }
  }

  bool opens_block(std::uint32_t i) const {
    const Token& token = plan_.tokens[i];
    return token.end - token.begin == 1 && plan_.text[token.begin] == '{';
  }
  std::uint64_t inside_of(const Token& token) const {
    const bool continues =
        token.brk == Break::operation || token.brk == Break::wrap || token.brk == Break::row;
    return continues ? continued() : containers_.back().inside;
  }

  const Plan& plan_;
  const Measure measure_;
  std::vector<Mode> modes_;
  std::vector<Container> containers_{Container{}};
  std::string out_;
  std::uint64_t column_ = 0;
  std::uint64_t line_indent_ = 0;
};

}  // namespace

std::string text_of(const Plan& plan) {
  return Layout(plan).run();
}

}  // namespace scenec::frontend::layout
