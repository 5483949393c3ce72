#include "frontend/course/words.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <unordered_map>

#include "frontend/course/translate.hpp"

namespace scenec::frontend::course {

namespace {

constexpr std::size_t place_count = static_cast<std::size_t>(Place::transform) + 1;

constexpr Word make_word(Place place, std::string_view text, Role role, Values values,
                         Vocabulary vocabulary, Treat treat, std::string_view reading,
                         std::string_view found) {
  return {place, text, role, values, vocabulary, treat, reading, found};
}

constexpr std::array words = [] {
  using enum Values;
  return std::to_array<Word>({
// `Place::x` and the like: the rows name enumerators, some of which several enumerations share.
#define SCENEC_COURSE_WORD(place, text, role, values, vocabulary, treat, reading, found)           \
  make_word(Place::place, text, Role::role, values, Vocabulary::vocabulary, Treat::treat, reading, \
            found),
#include "frontend/course/words.def"
#undef SCENEC_COURSE_WORD
  });
}();

constexpr std::array<std::pair<std::string_view, std::string_view>, 4> reading_forms{
    {{"flag: ", "alone"}, {"number: ", "a number"}, {"vec3: ", "3 numbers"}, {"word: ", "a word"}}};

using PlaceIndex = std::unordered_map<std::string_view, const Word*>;

const std::array<PlaceIndex, place_count>& index_of_words() {
  static const std::array<PlaceIndex, place_count> index = [] {
    std::array<PlaceIndex, place_count> made;
    for (const Word& word : words)
      made[static_cast<std::size_t>(word.place)].emplace(word.text, &word);
    return made;
  }();
  return index;
}

// `vec3: a|number: b` as the manual says it: `3 numbers: a; a number: b`.
std::string manual_text_of(std::string_view reading) {
  std::string text;
  for (std::size_t at = 0; at < reading.size();) {
    const std::size_t bar = std::min(reading.find('|', at), reading.size());
    std::string_view part = reading.substr(at, bar - at);
    if (!text.empty()) text += "; ";
    for (const auto& [form, name] : reading_forms) {
      if (!part.starts_with(form)) continue;
      part.remove_prefix(form.size());
      text += name;
      text += ": ";
    }
    text += part;
    at = bar + 1;
  }
  return text;
}

bool is_object(const Word& word) {
  return word.place == Place::group && word.values == Values::block;
}

}  // namespace

std::string_view name_of(Place place) {
  static constexpr std::array<std::string_view, place_count> names{
      "a scene",  "a camera",        "`Model`",    "`Background`", "`Lights`",   "`DiskLights`",
      "a light",  "`Materials`",     "a material", "`Noise`",      "`Textures`", "a group",
      "a sphere", "a moving sphere", "a plane",    "a triangle",   "a mesh",     "`Rectangle`",
      "a box",    "`Disc`",          "`FFDCage`",  "`RevSurface`", "a curve",    "`Transform`"};
  return names[static_cast<std::size_t>(place)];
}

std::string text_of(Values set) {
  static constexpr std::array<std::pair<Values, std::string_view>, 10> names{{
      {Values::flag, "nothing"},
      {Values::number, "a number"},
      {Values::vec2, "2 numbers"},
      {Values::vec3, "3 numbers"},
      {Values::word, "a word"},
      {Values::file_numbers, "a file name"},
      {Values::block, "a block `{ }`"},
      {Values::object, "an object with its block"},
      {Values::points, "points `[ x y z ]`"},
      {Values::braced, "numbers in `{ }`"},
  }};
  std::string text;
  for (const auto& [value, name] : names) {
    if (!allows(set, value)) continue;
    if (!text.empty()) text += " or ";
    text += name;
  }
  return text;
}

std::span<const Word> all_words() {
  return words;
}

const Word* find_word(Place place, std::string_view text) {
  const PlaceIndex& own = index_of_words()[static_cast<std::size_t>(place)];
  if (const auto found = own.find(text); found != own.end()) return found->second;
  if (place != Place::transform) return nullptr;
  const Word* const word = find_word(Place::group, text);
  return word != nullptr && is_object(*word) ? word : nullptr;
}

std::vector<std::string_view> words_of(Place place) {
  std::vector<std::string_view> texts;
  for (const Word& word : words) {
    if (word.place == place || (place == Place::transform && is_object(word))) {
      texts.push_back(word.text);
    }
  }
  return texts;
}

std::string_view reading_for(const Word& word, Values form) {
  std::string_view rest = word.reading;
  if (rest.find('|') == std::string_view::npos) return rest;
  const auto wanted = form == Values::flag     ? 0u
                      : form == Values::number ? 1u
                      : form == Values::vec3   ? 2u
                                               : 3u;
  while (!rest.empty()) {
    const std::size_t bar = std::min(rest.find('|'), rest.size());
    const std::string_view part = rest.substr(0, bar);
    if (part.starts_with(reading_forms[wanted].first))
      return part.substr(reading_forms[wanted].first.size());
    rest.remove_prefix(std::min(bar + 1, rest.size()));
  }
  return word.reading;
}

std::string words_markdown() {
  static constexpr std::array<std::string_view, 4> vocabularies{"base", "extension", "Whitted",
                                                                "path"};
  static constexpr std::array<std::string_view, 3> treats{
      "", "chosen reading (warned): ", "not used (warned): "};
  std::string text;
  for (std::size_t i = 0; i < place_count; ++i) {
    const auto place = static_cast<Place>(i);
    text += "### In ";
    text += name_of(place);
    text += "\n\n| word | takes | vocabulary | reading | found |\n|---|---|---|---|---|\n";
    for (const Word& word : words) {
      if (word.place != place) continue;
      text += "| `";
      text += word.text;
      text += "` | " + text_of(word.values) + " | ";
      text += vocabularies[static_cast<std::size_t>(word.vocabulary)];
      text += " | ";
      text += treats[static_cast<std::size_t>(word.treat)];
      text += manual_text_of(word.reading);
      text += " | ";
      text += word.found;
      text += " |\n";
    }
    text += '\n';
  }
  return text;
}

}  // namespace scenec::frontend::course
