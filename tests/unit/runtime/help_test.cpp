#include "runtime/help.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "runtime/cli.hpp"
#include "runtime/completion.hpp"
#include "tests/support/paths.hpp"

namespace scenec::runtime {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const OptionRow& row_of(std::string_view name) {
  for (const OptionRow& row : all_options()) {
    if (names_of(row).back() == name) return row;
  }
  throw std::logic_error(std::string(name));
}

TEST(Help, ChoicesAreThoseThatAreAccepted) {
  EXPECT_THAT(choices_of(row_of("--method")), ElementsAre("path", "whitted", "phong"));
  EXPECT_THAT(choices_of(row_of("--stage")), ElementsAre("tree", "ast", "ir", "effects"));
  EXPECT_THAT(choices_of(row_of("--size")), ElementsAre());
  EXPECT_THAT(choices_of(row_of("--half")), ElementsAre());
  for (const OptionRow& row : all_options()) {
    for (const std::string& choice : choices_of(row)) {
      Options options;
      EXPECT_EQ(row.store(options, choice), std::nullopt) << row.names << " " << choice;
    }
  }
}

TEST(Help, TheManualAndTheCompletionsKnowEveryVerbAndOption) {
  const std::string manual = manual_page();
  for (const VerbInfo& verb : all_verbs()) {
    EXPECT_THAT(manual, HasSubstr("scenec " + std::string(verb.name)));
    EXPECT_THAT(bash_completion(), HasSubstr("      " + std::string(verb.name) + ") "));
    EXPECT_THAT(zsh_completion(), HasSubstr("    (" + std::string(verb.name) + ")"));
    EXPECT_THAT(fish_completion(), HasSubstr(" -a " + std::string(verb.name) + " "));
  }
  for (const OptionRow& row : all_options()) {
    for (const std::string_view name : names_of(row)) {
      std::string in_roff;
      for (const char c : name) in_roff += c == '-' ? std::string("\\-") : std::string(1, c);
      EXPECT_THAT(manual, HasSubstr("\\fB" + in_roff + "\\fR"));
      EXPECT_THAT(bash_completion(), HasSubstr(std::string(name)));
      EXPECT_THAT(zsh_completion(), HasSubstr(std::string(name)));
      const std::string bare(name.substr(name.starts_with("--") ? 2 : 1));
      EXPECT_THAT(fish_completion(), HasSubstr(" " + bare + " "));
    }
  }
}

TEST(Help, LinesOfTheManualAreNoRoffRequests) {
  std::istringstream lines(manual_page());
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with('.')) continue;
    const std::string_view request = std::string_view(line).substr(0, line.find(' '));
    EXPECT_TRUE(request == ".TH" || request == ".SH" || request == ".TP" || request == ".B" ||
                request == ".nf" || request == ".fi" || request == ".\\\"")
        << line;
  }
}

// SCENEC_UPDATE_DOCS=1 writes the generated part anew.
TEST(Help, TheLanguageReferenceIsUpToDate) {
  std::ostringstream out;
  std::ostringstream err;
  const Environment environment{
      .out = out, .err = err, .variable = [](std::string_view) { return std::nullopt; }};
  ASSERT_EQ(run({"schema", "--markdown"}, environment), ExitCode::ok);
  const auto path = test::source_directory() / "docs" / "language-reference.md";
  std::ifstream stream(path);
  std::ostringstream content;
  content << stream.rdbuf();
  const std::string text = content.str();
  constexpr std::string_view mark = "<!-- generated: scenec schema --markdown -->\n\n";
  const std::size_t at = text.find(mark);
  ASSERT_NE(at, std::string::npos);
  const std::size_t begin = at + mark.size();
  if (std::getenv("SCENEC_UPDATE_DOCS") != nullptr) {
    std::ofstream(path) << text.substr(0, begin) << out.str();
    return;
  }
  EXPECT_EQ(text.substr(begin), out.str())
      << "run unit_runtime with SCENEC_UPDATE_DOCS=1 and read the difference";
}

}  // namespace
}  // namespace scenec::runtime
