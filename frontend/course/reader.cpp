#include "frontend/course/reader.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "base/text.hpp"

namespace scenec::frontend::course {

using grammar::NodeRef;
using grammar::SyntaxKind;

namespace {

bool is_element(NodeRef node) {
  switch (node.kind()) {
    case SyntaxKind::course_word:
    case SyntaxKind::course_number:
    case SyntaxKind::course_block:
    case SyntaxKind::course_bracket:
      return true;
    default:
      return false;  // braces, and what the parser already reported
  }
}

// Whether `word` is surely a slip for `name`: they differ in one place of at most two letters.
bool is_slip(std::string_view word, std::string_view name) {
  const std::size_t shorter = std::min(word.size(), name.size());
  std::size_t front = 0;
  while (front < shorter && word[front] == name[front]) ++front;
  std::size_t back = 0;
  while (back < shorter - front && word[word.size() - 1 - back] == name[name.size() - 1 - back])
    ++back;
  return front + back + 2 >= std::max(word.size(), name.size());
}

Values form_of(const Entry& entry) {
  if (!entry.name.empty()) return Values::word;
  if (entry.numbers.empty()) return Values::flag;
  return entry.numbers.size() == 1 ? Values::number : Values::vec3;
}

std::string found_text(const Entry& entry) {
  if (!entry.points.empty()) return "points in brackets";
  if (!entry.numbers.empty()) {
    return fmt::format("{} number{}", entry.numbers.size(), entry.numbers.size() == 1 ? "" : "s");
  }
  if (!entry.name.empty()) return fmt::format("`{}`", printable(entry.name));
  return entry.block ? "a block" : "nothing";
}

}  // namespace

Span Entry::values_span() const {
  if (!numbers.empty()) return join(numbers.front().span, numbers.back().span);
  return name.empty() ? word_span : name_span;
}

BlockReader::BlockReader(Context& context, NodeRef block, Place place)
    : context_(context), block_(block), place_(place) {
  for (const NodeRef child : block.children()) {
    if (is_element(child)) elements_.push_back(child);
  }
}

bool BlockReader::was_tried(Role role) const {
  return std::find(tried_.begin(), tried_.end(), role) != tried_.end();
}

bool BlockReader::at(SyntaxKind kind) const {
  return at_ < elements_.size() && elements_[at_].is(kind);
}

std::optional<Entry> BlockReader::next() {
  while (at_ < elements_.size()) {
    if (!at(SyntaxKind::course_word)) {
      skip_stray();
      continue;
    }
    std::optional<Entry> entry = read_entry();
    if (!entry) continue;
    if (entry->usable) return entry;
    tried_.push_back(entry->role());
  }
  return std::nullopt;
}

void BlockReader::skip_stray() {
  const NodeRef first = elements_[at_];
  Span span = first.is(SyntaxKind::course_block)
                  ? Span{first.span().file, first.span().begin, first.span().begin + 1}
                  : first.span();
  while (at_ < elements_.size() && !at(SyntaxKind::course_word)) {
    if (!at(SyntaxKind::course_block)) span = join(span, elements_[at_].span());
    ++at_;
  }
  context_.error(DiagnosticKind::course_stray, span,
                 fmt::format("a value stands in {} without a word before it", name_of(place_)));
}

std::optional<Entry> BlockReader::read_entry() {
  const NodeRef node = elements_[at_++];
  const Word* const word = identify(node);
  if (word == nullptr) {
    skip_unknown_values();
    return std::nullopt;
  }
  Entry entry;
  entry.word = word;
  entry.word_span = node.span();
  entry.span = node.span();
  entry.usable = read_values(entry);
  const NodeRef last = elements_[at_ - 1];
  if (!last.is(SyntaxKind::course_block)) entry.span = join(entry.span, last.span());
  if (entry.usable) {
    note_use(entry);
  } else {
    report_wrong_values(entry);
  }
  return entry;
}

const Word* BlockReader::identify(NodeRef node) {
  const std::string_view text = node.text();
  if (const Word* const word = find_word(place_, text)) return word;
  const std::vector<std::string_view> legal = words_of(place_);
  const std::optional<std::string_view> nearest = nearest_name(text, legal);
  const bool slip = nearest && is_slip(text, *nearest);
  // A slip is put right where it stands; of a word without a reading one message is enough.
  const std::string key = fmt::format("{} in {}", text, name_of(place_));
  if (!slip) {
    had_unknown_ = true;
    if (!context_.warned.emplace(DiagnosticKind::course_unknown_word, key).second) return nullptr;
  }
  Diagnostic diagnostic(DiagnosticKind::course_unknown_word, node.span(),
                        fmt::format("`{}` has no reading in {}", printable(text), name_of(place_)));
  if (nearest) {
    diagnostic.hints.push_back(fmt::format("did you mean `{}`?", *nearest));
    diagnostic.fixits.push_back({node.span(), std::string(*nearest)});
  }
  diagnostic.notes.push_back({fmt::format("known here: {}", quoted_list(legal)), {}});
  context_.sink.report(std::move(diagnostic));
  return slip ? find_word(place_, *nearest) : nullptr;
}

// What follows a word nobody knows: numbers, brackets and a block; or one word that is no key.
void BlockReader::skip_unknown_values() {
  const std::size_t begin = at_;
  while (at(SyntaxKind::course_number) || at(SyntaxKind::course_bracket)) ++at_;
  if (at(SyntaxKind::course_block)) ++at_;
  if (at_ != begin || !at(SyntaxKind::course_word)) return;
  if (find_word(place_, elements_[at_].text()) == nullptr) {
    ++at_;
    while (at(SyntaxKind::course_number)) ++at_;
    if (at(SyntaxKind::course_block)) ++at_;
  }
}

void BlockReader::read_numbers(std::vector<Number>& numbers) {
  while (at(SyntaxKind::course_number)) {
    if (const auto number = number_of(elements_[at_])) {
      numbers.push_back(*number);
    } else {
      context_.error(
          DiagnosticKind::course_wrong_values, elements_[at_].span(),
          fmt::format("`{}` is no number that can be stored", printable(elements_[at_].text())));
      numbers.push_back({0, elements_[at_].span(), "0"});
    }
    ++at_;
  }
}

void BlockReader::read_points(Entry& entry) {
  while (at(SyntaxKind::course_number) || at(SyntaxKind::course_bracket)) {
    if (at(SyntaxKind::course_number)) {
      read_numbers(entry.numbers);
      continue;
    }
    std::vector<Number>& point = entry.points.emplace_back();
    for (const NodeRef child : elements_[at_].children()) {
      if (const auto number = number_of(child)) point.push_back(*number);
    }
    ++at_;
  }
}

void BlockReader::read_braced(Entry& entry) {
  if (!at(SyntaxKind::course_block)) return;
  for (const NodeRef child : elements_[at_].children()) {
    if (const auto number = number_of(child)) entry.numbers.push_back(*number);
  }
  ++at_;
}

// One word, and whatever touches it: `2k.png` is scanned as a number and a word.
void BlockReader::read_name(Entry& entry) {
  const Span first = elements_[at_].span();
  entry.name_span = first;
  ++at_;
  while ((at(SyntaxKind::course_word) || at(SyntaxKind::course_number)) &&
         elements_[at_].span().begin == entry.name_span.end) {
    entry.name_span = join(entry.name_span, elements_[at_].span());
    ++at_;
  }
  const std::string_view text = block_.tree().text();
  entry.name = text.substr(entry.name_span.begin, entry.name_span.end - entry.name_span.begin);
  if (entry.name.size() >= 2 && entry.name.front() == '"' && entry.name.back() == '"') {
    entry.name = entry.name.substr(1, entry.name.size() - 2);
  }
}

bool BlockReader::read_block(Entry& entry) {
  if (!at(SyntaxKind::course_block)) return false;
  entry.block = elements_[at_++];
  return true;
}

bool BlockReader::read_values(Entry& entry) {
  const Values values = entry.word->values;
  if (allows(values, Values::points)) {
    read_points(entry);
    return !entry.points.empty() || !entry.numbers.empty();
  }
  if (allows(values, Values::braced)) {
    read_braced(entry);
    return entry.numbers.size() == (entry.role() == Role::matrix ? 16u : 4u);
  }
  if (allows(values, Values::block)) return read_block(entry);
  const bool takes_name = allows(values, Values::word | Values::file_numbers | Values::object);
  const bool named_by_digit = at(SyntaxKind::course_number) && at_ + 1 < elements_.size() &&
                              elements_[at_ + 1].is(SyntaxKind::course_word) &&
                              elements_[at_ + 1].span().begin == elements_[at_].span().end;
  if (takes_name && (at(SyntaxKind::course_word) || named_by_digit)) {
    read_name(entry);
    if (allows(values, Values::object)) return read_block(entry);
    if (allows(values, Values::file_numbers)) read_numbers(entry.numbers);
    return true;
  }
  read_numbers(entry.numbers);
  switch (entry.numbers.size()) {
    case 0:
      return allows(values, Values::flag);
    case 1:
      return allows(values, Values::number);
    case 2:
      return allows(values, Values::vec2);
    case 3:
      return allows(values, Values::vec3);
    default:
      return false;
  }
}

void BlockReader::report_wrong_values(Entry& entry) {
  // `radius one`: a word that means nothing here stands in the place of a value.
  if (at(SyntaxKind::course_word) && find_word(place_, elements_[at_].text()) == nullptr) {
    const NodeRef culprit = elements_[at_];
    skip_unknown_values();
    context_.error(
        DiagnosticKind::course_wrong_values, culprit.span(),
        fmt::format("`{}` stands in the values of `{}`, which takes {}", printable(culprit.text()),
                    entry.word->text, text_of(entry.word->values)));
    return;
  }
  Span where = entry.numbers.empty() ? entry.word_span : entry.values_span();
  if (!where.valid()) where = entry.word_span;
  context_.error(DiagnosticKind::course_wrong_values, where,
                 fmt::format("`{}` is followed by {}; it takes {}", entry.word->text,
                             found_text(entry), text_of(entry.word->values)));
}

void BlockReader::note_use(const Entry& entry) {
  const Word& word = *entry.word;
  context_.vocabulary = std::max(context_.vocabulary, word.vocabulary);
  if (word.treat == Treat::chosen) {
    context_.warn_once(DiagnosticKind::course_chosen_reading, word.text, entry.word_span,
                       fmt::format("`{}` has several readings; read as: {}", word.text,
                                   reading_for(word, form_of(entry))));
  } else if (word.treat == Treat::ignored) {
    context_.warn_once(DiagnosticKind::course_ignored_word, word.text, entry.word_span,
                       fmt::format("`{}` has no effect: {}", word.text, word.reading));
  }
}

}  // namespace scenec::frontend::course
