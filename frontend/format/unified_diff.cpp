#include "frontend/format/unified_diff.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace scenec::frontend {

namespace {

using Lines = std::vector<std::string_view>;
using Index = std::int64_t;

constexpr Index most_edits = 1000;  // the trace takes memory in the square of it
constexpr Index context = 3;

Lines lines_of(std::string_view text) {
  Lines lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
    lines.push_back(text.substr(0, end));
    text.remove_prefix(end);
  }
  return lines;
}

// Lines [a_begin, a_end) of the one are replaced by [b_begin, b_end) of the other.
struct Change {
  Index a_begin, a_end, b_begin, b_end;
};

std::string_view line(const Lines& lines, Index at) {
  return lines[static_cast<std::size_t>(at)];
}

// The shortest edit script (Myers 1986, the greedy algorithm) of the stretches that `whole` spans.
// Empty when it has more than most_edits edits.
std::vector<Change> edits_of(const Lines& a, const Lines& b, const Change& whole) {
  const Index n = whole.a_end - whole.a_begin;
  const Index m = whole.b_end - whole.b_begin;
  const auto same = [&](Index x, Index y) {
    return line(a, whole.a_begin + x) == line(b, whole.b_begin + y);
  };
  const Index limit = std::min(n + m, most_edits);
  std::vector<Index> furthest(static_cast<std::size_t>(2 * limit + 3), 0);
  const auto slot = [&](Index k) -> Index& {
    return furthest[static_cast<std::size_t>(k + limit + 1)];
  };
  std::vector<std::vector<std::int32_t>> trace;  // of each d: slots -d .. d before it
  for (Index d = 0; d <= limit; ++d) {
    std::vector<std::int32_t>& row = trace.emplace_back();
    for (Index k = -d - 1; k <= d + 1; ++k) row.push_back(static_cast<std::int32_t>(slot(k)));
    for (Index k = -d; k <= d; k += 2) {
      const bool down = k == -d || (k != d && slot(k - 1) < slot(k + 1));
      Index x = down ? slot(k + 1) : slot(k - 1) + 1;
      while (x < n && x - k < m && same(x, x - k)) ++x;
      slot(k) = x;
      if (x < n || x - k < m) continue;
      std::vector<Change> edits;
      Index end_x = n;
      for (Index step = d; step > 0; --step) {
        const std::vector<std::int32_t>& before = trace[static_cast<std::size_t>(step)];
        const auto at = [&](Index diagonal) -> Index {
          return before[static_cast<std::size_t>(diagonal + step + 1)];
        };
        const Index diagonal = end_x - (step == d ? m : edits.back().b_begin - whole.b_begin);
        const bool was_down =
            diagonal == -step || (diagonal != step && at(diagonal - 1) < at(diagonal + 1));
        const Index from_x = was_down ? at(diagonal + 1) : at(diagonal - 1);
        const Index from_y = from_x - (was_down ? diagonal + 1 : diagonal - 1);
        edits.push_back({whole.a_begin + from_x, whole.a_begin + from_x + (was_down ? 0 : 1),
                         whole.b_begin + from_y, whole.b_begin + from_y + (was_down ? 1 : 0)});
        end_x = from_x;
      }
      std::reverse(edits.begin(), edits.end());
      return edits;
    }
  }
  return {};
}

// Changes that touch become one.
std::vector<Change> changes_of(const Lines& a, const Lines& b) {
  Change whole{0, static_cast<Index>(a.size()), 0, static_cast<Index>(b.size())};
  while (whole.a_begin < whole.a_end && whole.b_begin < whole.b_end &&
         line(a, whole.a_begin) == line(b, whole.b_begin)) {
    ++whole.a_begin;
    ++whole.b_begin;
  }
  while (whole.a_begin < whole.a_end && whole.b_begin < whole.b_end &&
         line(a, whole.a_end - 1) == line(b, whole.b_end - 1)) {
    --whole.a_end;
    --whole.b_end;
  }
  if (whole.a_begin == whole.a_end && whole.b_begin == whole.b_end) return {};
  std::vector<Change> edits = edits_of(a, b, whole);
  if (edits.empty()) return {whole};
  std::vector<Change> changes;
  for (const Change& edit : edits) {
    if (!changes.empty() && changes.back().a_end == edit.a_begin &&
        changes.back().b_end == edit.b_begin) {
      changes.back().a_end = edit.a_end;
      changes.back().b_end = edit.b_end;
    } else {
      changes.push_back(edit);
    }
  }
  return changes;
}

void put_lines(std::string& out, char mark, const Lines& lines, Index begin, Index end) {
  for (Index i = begin; i < end; ++i) {
    out += mark;
    out += line(lines, i);
    if (!out.ends_with('\n')) out += "\n\\ No newline at end of file\n";
  }
}

std::string range_text(Index begin, Index end) {
  const Index count = end - begin;
  const Index first = count == 0 ? begin : begin + 1;
  return count == 1 ? fmt::format("{}", first) : fmt::format("{},{}", first, count);
}

}  // namespace

std::string unified_diff(std::string_view before, std::string_view after,
                         std::string_view before_name, std::string_view after_name) {
  const Lines a = lines_of(before);
  const Lines b = lines_of(after);
  const std::vector<Change> changes = changes_of(a, b);
  if (changes.empty()) return {};
  std::string out = fmt::format("--- {}\n+++ {}\n", before_name, after_name);
  for (std::size_t first = 0; first < changes.size();) {
    std::size_t last = first;
    while (last + 1 < changes.size() &&
           changes[last + 1].a_begin - changes[last].a_end <= 2 * context) {
      ++last;
    }
    const Index lead = std::min(context, changes[first].a_begin);
    const Index trail = std::min(context, static_cast<Index>(a.size()) - changes[last].a_end);
    const Index a_begin = changes[first].a_begin - lead;
    const Index a_end = changes[last].a_end + trail;
    out += fmt::format("@@ -{} +{} @@\n", range_text(a_begin, a_end),
                       range_text(changes[first].b_begin - lead, changes[last].b_end + trail));
    Index place = a_begin;
    for (std::size_t i = first; i <= last; ++i) {
      put_lines(out, ' ', a, place, changes[i].a_begin);
      put_lines(out, '-', a, changes[i].a_begin, changes[i].a_end);
      put_lines(out, '+', b, changes[i].b_begin, changes[i].b_end);
      place = changes[i].a_end;
    }
    put_lines(out, ' ', a, place, a_end);
    first = last + 1;
  }
  return out;
}

}  // namespace scenec::frontend
