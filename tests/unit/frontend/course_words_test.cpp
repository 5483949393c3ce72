// The vocabulary table, and the manual's part that is made from it.
#include "frontend/course/words.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>

#include "frontend/course/translate.hpp"
#include "tests/support/paths.hpp"

namespace scenec::frontend::course {
namespace {

TEST(CourseWords, EveryWordHasOneRowAPlace) {
  std::set<std::pair<Place, std::string_view>> seen;
  for (const Word& word : all_words()) {
    EXPECT_TRUE(seen.emplace(word.place, word.text).second) << word.text;
    EXPECT_FALSE(word.reading.empty()) << word.text;
    EXPECT_EQ(find_word(word.place, word.text), &word);
  }
}

TEST(CourseWords, WhatHasNoEffectSaysSo) {
  for (const Word& word : all_words()) {
    const bool without_effect =
        word.role == Role::ignored || word.role == Role::ignored_block || word.role == Role::bump;
    if (word.text == "no_controls") continue;  // says that nothing is deformed
    EXPECT_EQ(word.treat == Treat::ignored, without_effect) << word.text;
  }
}

TEST(CourseWords, ObjectsMayStandInATransform) {
  ASSERT_NE(find_word(Place::transform, "Sphere"), nullptr);
  EXPECT_EQ(find_word(Place::transform, "MaterialIndex"), nullptr);
  EXPECT_EQ(find_word(Place::transform, "numObjects"), nullptr);
}

TEST(CourseWords, AReadingDependsOnTheValues) {
  const Word* const type = find_word(Place::material, "type");
  ASSERT_NE(type, nullptr);
  EXPECT_TRUE(reading_for(*type, Values::vec3).starts_with("weights"));
  EXPECT_TRUE(reading_for(*type, Values::number).starts_with("0 diffuse"));
}

// SCENEC_UPDATE_DOCS=1 writes the generated part anew.
TEST(CourseWords, TheManualHoldsTheTable) {
  const auto path = test::source_directory() / "docs" / "course-dialect.md";
  std::ifstream stream(path);
  std::stringstream content;
  content << stream.rdbuf();
  std::string text = content.str();
  constexpr std::string_view begin_mark = "<!-- begin generated: words -->\n";
  constexpr std::string_view end_mark = "<!-- end generated: words -->";
  const std::size_t begin = text.find(begin_mark);
  const std::size_t end = text.find(end_mark);
  ASSERT_NE(begin, std::string::npos);
  ASSERT_NE(end, std::string::npos);
  const std::size_t first = begin + begin_mark.size();
  if (std::getenv("SCENEC_UPDATE_DOCS") != nullptr) {
    text.replace(first, end - first, words_markdown());
    std::ofstream(path) << text;
    return;
  }
  EXPECT_EQ(text.substr(first, end - first), words_markdown())
      << "run unit_frontend with SCENEC_UPDATE_DOCS=1 and read the difference";
}

}  // namespace
}  // namespace scenec::frontend::course
