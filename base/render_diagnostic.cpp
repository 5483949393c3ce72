#include "base/render_diagnostic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "base/source_excerpt.hpp"
#include "base/text.hpp"

namespace scenec {

namespace {

enum class Style : std::uint8_t { bold, error, warning, note, help, gutter, marker };

std::string_view code_of(Style style) {
  switch (style) {
    case Style::bold:
      return "\x1b[1m";
    case Style::error:
      return "\x1b[1;31m";
    case Style::warning:
      return "\x1b[1;35m";
    case Style::note:
      return "\x1b[1;36m";
    case Style::help:
      return "\x1b[1;32m";
    case Style::gutter:
      return "\x1b[34m";
    case Style::marker:
      return "\x1b[36m";
  }
  return "";
}

// Messages are never cut, only made safe: a control character of a path or a quoted word must not
// reach the terminal.
std::string safe(std::string_view text) {
  return printable(text, std::numeric_limits<std::size_t>::max());
}

struct Mark {
  Span span;
  std::string_view text;
  bool primary = false;
};

class Renderer {
 public:
  Renderer(const SourceMap& sources, const RenderOptions& options)
      : sources_(sources), options_(options) {}

  void render(const Diagnostic& diagnostic) {
    const DiagnosticKindInfo& info = info_of(diagnostic.kind);
    const bool is_error = options_.severity.value_or(info.severity) == Severity::error;
    const Span place = sources_.resolve(diagnostic.span);
    head_style_ = is_error ? Style::error : Style::warning;
    head(place, fmt::format("{}[{}]", is_error ? "error" : "warning", info.code), head_style_,
         diagnostic.message);
    show_marks(diagnostic, place);
    for (const Note& note : diagnostic.notes) show_note(note);
    for (const std::string& hint : diagnostic.hints) help(hint);
    for (const FixIt& fix : diagnostic.fixits) show_fix(fix, place);
  }

  [[nodiscard]] std::string take() { return std::move(out_); }

 private:
  std::string styled(Style style, std::string_view text) const {
    if (!options_.color || text.empty()) return std::string(text);
    return fmt::format("{}{}\x1b[0m", code_of(style), text);
  }

  std::string place_text(Span span) const {
    const Position position = sources_.position(span.file, span.begin);
    return fmt::format("{}:{}:{}", safe(sources_.path(span.file)), position.line, position.column);
  }

  std::uint32_t line_of(Span span) const { return sources_.position(span.file, span.begin).line; }

  void head(Span place, std::string_view word, Style style, std::string_view message) {
    const std::string where = place.valid() ? place_text(place) : "scenec";
    out_ += styled(Style::bold, where + ':') + ' ' + styled(style, fmt::format("{}:", word)) + ' ' +
            styled(Style::bold, safe(message)) + '\n';
  }

  void help(std::string_view text) {
    out_ += styled(Style::help, "help:") + ' ' + safe(text) + '\n';
  }

  // The primary place with the labels of its line, then the labels of other lines, each with its
  // own excerpt.
  void show_marks(const Diagnostic& diagnostic, Span place) {
    std::vector<Mark> here;
    std::vector<Mark> elsewhere;
    if (place.valid()) here.push_back({place, "", true});
    for (const Label& label : diagnostic.labels) {
      const Span span = sources_.resolve(label.span);
      if (!span.valid()) continue;
      if (span == place && here.front().text.empty()) {
        here.front().text = label.text;
      } else if (span.file == place.file && line_of(span) == line_of(place)) {
        here.push_back({span, label.text});
      } else {
        elsewhere.push_back({span, label.text});
      }
    }
    if (!here.empty()) excerpt(here, head_style_);
    for (const Mark& mark : elsewhere) {
      out_ += styled(Style::gutter, "  --> ") + place_text(mark.span) + '\n';
      excerpt({&mark, 1}, Style::marker);
    }
  }

  void show_note(const Note& note) {
    const Span place = sources_.resolve(note.span);
    if (!place.valid()) {
      out_ += styled(Style::note, "note:") + ' ' + safe(note.text) + '\n';
      return;
    }
    head(place, "note", Style::note, note.text);
    const Mark mark{place, "", true};
    excerpt({&mark, 1}, Style::note);
  }

  // A fix of derived text is not shown: its words are not those of the file the author edits.
  void show_fix(const FixIt& fix, Span place) {
    if (!fix.span.valid() || sources_.resolve(fix.span) != fix.span) return;
    const std::string old_text = printable(sources_.text(fix.span));
    const std::string new_text = printable(fix.replacement);
    std::string text;
    if (fix.replacement.empty()) {
      text = fmt::format("remove `{}`", old_text);
    } else if (old_text.empty()) {
      text = fmt::format("insert `{}`", new_text);
    } else {
      text = fmt::format("replace `{}` by `{}`", old_text, new_text);
    }
    if (fix.span.file != place.file || fix.span.begin != place.begin)
      text += " at " + place_text(fix.span);
    help(text);
  }

  void excerpt(std::span<const Mark> marks, Style primary_style) {
    const Mark& first = marks.front();
    const std::uint32_t line_number = line_of(first.span);
    const std::string_view line = sources_.line(first.span.file, line_number);
    const auto line_begin =
        static_cast<std::size_t>(line.data() - sources_.text(first.span.file).data());
    const auto in_line = [&](std::uint32_t offset) {
      return std::clamp<std::size_t>(offset, line_begin, line_begin + line.size()) - line_begin;
    };
    const SourceExcerpt source(line, in_line(first.span.begin), in_line(first.span.end),
                               options_.max_source_width);
    out_ += styled(Style::gutter, fmt::format("{:>5} |", line_number)) + ' ' + source.text() + '\n';
    for (const Mark& mark : marks) {
      const auto [begin, width] = source.columns(in_line(mark.span.begin), in_line(mark.span.end));
      std::string marker(width, mark.primary ? '^' : '-');
      if (!mark.text.empty()) marker += ' ' + safe(mark.text);
      out_ += styled(Style::gutter, "      |") + ' ' + std::string(begin, ' ') +
              styled(mark.primary ? primary_style : Style::marker, marker) + '\n';
    }
  }

  const SourceMap& sources_;
  const RenderOptions& options_;
  Style head_style_ = Style::error;
  std::string out_;
};

}  // namespace

std::string render_terminal(const Diagnostic& diagnostic, const SourceMap& sources,
                            const RenderOptions& options) {
  Renderer renderer(sources, options);
  renderer.render(diagnostic);
  return renderer.take();
}

}  // namespace scenec
