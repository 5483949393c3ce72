#include "base/source_excerpt.hpp"

#include <algorithm>

#include "base/utf8.hpp"

namespace scenec {

namespace {

constexpr std::size_t tab_stop = 4;
constexpr std::string_view ellipsis = "…";
constexpr std::size_t ellipsis_width = 1;
constexpr std::size_t narrowest = 16;  // room for two ellipses and the place itself

struct Shown {
  std::string text;
  std::size_t width;
};

// How the code point at `at` is shown when it lands in `column`.
Shown shown(std::string_view line, std::size_t at, utf8::CodePoint point, std::size_t column) {
  if (point.valid && point.value == '\t') {
    const std::size_t width = tab_stop - column % tab_stop;
    return {std::string(width, ' '), width};
  }
  std::string text;
  utf8::append_visible(text, line.substr(at, point.size), point);
  const std::size_t width =
      utf8::needs_escape(point) ? text.size() : utf8::display_width(point.value);
  return {std::move(text), width};
}

// The start of the code point before `at`; an invalid byte counts as its own.
std::size_t previous(std::string_view line, std::size_t at) {
  for (std::size_t back = 2; back <= 4 && back <= at; ++back) {
    const utf8::CodePoint point = utf8::decode(line, at - back);
    if (point.valid && point.size == back) return at - back;
  }
  return at - 1;
}

// The furthest start from which [start, at) is at most `width` columns wide.
std::size_t start_before(std::string_view line, std::size_t at, std::size_t width) {
  std::size_t used = 0;
  while (at > 0) {
    const std::size_t before = previous(line, at);
    used += shown(line, before, utf8::decode(line, before), 0).width;
    if (used > width) break;
    at = before;
  }
  return at;
}

}  // namespace

SourceExcerpt::SourceExcerpt(std::string_view line, std::size_t begin, std::size_t end,
                             std::size_t max_width) {
  const std::size_t width = std::max(max_width, narrowest);
  begin = std::min(begin, line.size());
  end = std::clamp(end, begin, line.size());
  // From the start when the whole place fits that way; else a third of the width stands before it.
  std::size_t at = start_before(line, begin, width - 2 * ellipsis_width);
  const bool whole_place_fits = at == 0 && start_before(line, end, width - 2 * ellipsis_width) == 0;
  if (!whole_place_fits) at = start_before(line, begin, width / 3);
  std::size_t column = 0;
  if (at > 0) {
    text_ += ellipsis;
    column = ellipsis_width;
  }
  while (at < line.size()) {
    const utf8::CodePoint point = utf8::decode(line, at);
    const Shown next = shown(line, at, point, column);
    const bool last = at + point.size == line.size();
    if (column + next.width + (last ? 0 : ellipsis_width) > width) break;
    cells_.push_back({at, column});
    text_ += next.text;
    column += next.width;
    at += point.size;
  }
  cells_.push_back({at, column});
  if (at < line.size()) text_ += ellipsis;
}

std::size_t SourceExcerpt::column_of(std::size_t offset) const {
  const auto after =
      std::upper_bound(cells_.begin(), cells_.end(), offset,
                       [](std::size_t value, const Cell& cell) { return value < cell.offset; });
  return after == cells_.begin() ? cells_.front().column : std::prev(after)->column;
}

SourceExcerpt::Columns SourceExcerpt::columns(std::size_t begin, std::size_t end) const {
  const std::size_t first = column_of(begin);
  const std::size_t last = column_of(end);
  return {first, last > first ? last - first : 1};
}

}  // namespace scenec
