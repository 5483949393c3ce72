// Blocks whose words stand in any order, each once: the checks they share.
#include <algorithm>

#include <fmt/format.h>

#include "base/text.hpp"
#include "frontend/course/objects.hpp"

namespace scenec::frontend::course {

namespace {

// The word an author would write for a role: the first of the table.
std::string_view word_for(Place place, Role role) {
  for (const Word& word : all_words()) {
    if (word.place == place && word.role == role) return word.text;
  }
  return "";
}

}  // namespace

Fields::Fields(Context& context, const Entry& block, Place place,
               std::initializer_list<Role> required) {
  BlockReader reader(context, block.block, place);
  while (auto entry = reader.next()) {
    const auto same = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& other) {
      return other.role() == entry->role();
    });
    if (same == entries_.end()) {
      entries_.push_back(std::move(*entry));
      continue;
    }
    const bool harmless = entry->role() == Role::ignored || entry->role() == Role::ignored_block;
    if (!harmless) {
      context.warn_once(
          DiagnosticKind::course_repeated_word, entry->word->text, entry->word_span,
          fmt::format("`{}` replaces an earlier value in this block", entry->word->text));
    }
    *same = std::move(*entry);
  }
  had_mistakes_ = reader.had_mistakes();
  std::vector<std::string_view> missing;
  for (const Role role : required) {
    if (find(role) != nullptr) continue;
    complete_ = false;
    if (!reader.was_tried(role)) missing.push_back(word_for(place, role));
  }
  if (!missing.empty() && !reader.had_unknown()) {
    context.error(DiagnosticKind::course_missing_word, block.word_span,
                  fmt::format("`{}` lacks {}", block.name.empty() ? block.word->text : block.name,
                              quoted_list(missing)));
  }
}

const Entry* Fields::find(Role role) const {
  for (const Entry& entry : entries_) {
    if (entry.role() == role) return &entry;
  }
  return nullptr;
}

double Fields::value(Role role, double otherwise) const {
  const Entry* const entry = find(role);
  return entry == nullptr || entry->numbers.empty() ? otherwise : entry->numbers.front().value;
}

std::array<double, 3> vector_of(const Entry& entry) {
  std::array<double, 3> vector{};
  for (std::size_t i = 0; i < 3 && i < entry.numbers.size(); ++i)
    vector[i] = entry.numbers[i].value;
  return vector;
}

}  // namespace scenec::frontend::course
