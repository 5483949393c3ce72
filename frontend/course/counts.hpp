// `numX n`: the count a block states and the count that was found.
#pragma once

#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "base/text.hpp"
#include "frontend/course/reader.hpp"

namespace scenec::frontend::course {

struct Count {
  std::optional<Number> stated;
  std::size_t found = 0;

  void state(const Entry& entry) { stated = entry.numbers.front(); }
  // `what` in the singular. A block without its count is an error unless a count with wrong values
  // was reported.
  void check(Context& context, std::string_view word, std::string_view what,
             const BlockReader& reader, Span block_word = {}) const {
    if (!stated) {
      if (!reader.had_mistakes() && block_word.valid()) {
        context.error(DiagnosticKind::course_missing_word, block_word,
                      fmt::format("`{}` is missing", word));
      }
      return;
    }
    if (stated->value == static_cast<double>(found) || reader.had_unknown()) return;
    context.sink.report(
        Diagnostic(
            DiagnosticKind::course_wrong_count, stated->span,
            fmt::format("`{}` is {}, but there {} {} {}{}", word, short_number_text(stated->value),
                        found == 1 ? "is" : "are", found, what, found == 1 ? "" : "s"))
            .fix(stated->span, std::to_string(found)));
  }
};

// Calls `read_one(entry)` for each entry of a block that states how many there are under `word`.
template <class ReadOne>
void read_counted(Context& context, const Entry& block, Place place, std::string_view word,
                  std::string_view what, const ReadOne& read_one) {
  BlockReader reader(context, block.block, place);
  Count count;
  while (const auto entry = reader.next()) {
    if (entry->role() == Role::count) {
      count.state(*entry);
    } else {
      ++count.found;
      read_one(*entry);
    }
  }
  count.check(context, word, what, reader, block.word_span);
}

}  // namespace scenec::frontend::course
