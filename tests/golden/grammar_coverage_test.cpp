// Every rule of both grammars has its golden case: each kind of node stands in a parse golden, and
// each thing the grammars can miss is missed in the expected text of some test.
#include <gtest/gtest.h>

#include <filesystem>
#include <initializer_list>
#include <regex>
#include <string>
#include <string_view>

#include "tests/support/paths.hpp"
#include "tests/support/scenes.hpp"

namespace scenec {
namespace {

namespace fs = std::filesystem;

std::string expected_texts(std::initializer_list<std::string_view> folders) {
  std::string all;
  for (const std::string_view folder : folders) {
    for (const auto& entry :
         fs::recursive_directory_iterator(test::source_directory() / "tests" / folder)) {
      if (entry.path().extension() == ".expected") all += test::text_of_file(entry.path());
    }
  }
  return all;
}

TEST(GrammarCoverage, EveryKindOfNode) {
  const std::string trees = expected_texts({"golden/parse"});
  std::string missing;
  for (const std::string_view kind : {
#define SCENEC_SYNTAX(name, shape) std::string_view(#name),
#include "grammar/syntax_kind.def"
#undef SCENEC_SYNTAX
       }) {
    if (!std::regex_search(trees, std::regex("(^|\n) *" + std::string(kind) + "( |\n)")))
      missing += std::string(kind) + " ";
  }
  EXPECT_EQ(missing, "");
}

TEST(GrammarCoverage, EveryExpectation) {
  const std::string told = expected_texts({"diagnostics", "golden"});
  const std::regex row(R"re(SCENEC_EXPECTS\(\s*(\w+),\s*"((?:[^"\\]|\\.)*)")re");
  std::string missing;
  int found = 0;
  for (const char* const header : {"grammar/sdl_messages.hpp", "grammar/course_messages.hpp"}) {
    const std::string text = test::text_of_file(test::source_directory() / header);
    for (std::sregex_iterator at(text.begin(), text.end(), row), end; at != end; ++at, ++found) {
      if ((*at)[1] == "edition_line") continue;  // `missing_edition` says it in its own words
      const std::string what = "expected " + (*at)[2].str();
      if (told.find(what) == std::string::npos) missing += (*at)[1].str() + " ";
    }
  }
  EXPECT_EQ(missing, "");
  EXPECT_GE(found, 30);
}

}  // namespace
}  // namespace scenec
