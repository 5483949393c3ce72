#include "runtime/diagnostic_formats.hpp"

#include <gtest/gtest.h>

namespace scenec::runtime {
namespace {

class DiagnosticFormats : public testing::Test {
 protected:
  SourceMap sources_;
  // The second line starts with two code points of two bytes each.
  FileId file_ = sources_.add("a b/ä:#.sdl", std::string("sdl 1;\nää x = 1;\n"));
  Span x_{file_, 12, 13};
};

TEST_F(DiagnosticFormats, AJsonLineCountsCodePointsAndGivesBytes) {
  const Finding finding{Diagnostic(DiagnosticKind::shadowed_name, x_, "`x` hides \"x\"")
                            .label(x_, "here")
                            .note("nowhere in particular")
                            .note("declared here", {file_, 0, 3})
                            .hint("choose another name")
                            .fix(x_, "y"),
                        Severity::warning};
  EXPECT_EQ(
      json_line(finding, sources_),
      R"({"version":1,"code":"L0202","name":"shadowed-name","severity":"warning",)"
      R"("message":"`x` hides \"x\"","file":"a b/\u00e4:#.sdl","line":2,"column":4,"end_line":2,)"
      R"("end_column":5,"begin":12,"end":13,)"
      R"("labels":[{"text":"here","file":"a b/\u00e4:#.sdl","line":2,"column":4,"end_line":2,)"
      R"("end_column":5,"begin":12,"end":13}],)"
      R"("notes":[{"text":"nowhere in particular"},)"
      R"({"text":"declared here","file":"a b/\u00e4:#.sdl","line":1,"column":1,"end_line":1,)"
      R"("end_column":4,"begin":0,"end":3}],"hints":["choose another name"],)"
      R"("fixits":[{"replacement":"y","file":"a b/\u00e4:#.sdl","line":2,"column":4,)"
      R"("end_line":2,"end_column":5,"begin":12,"end":13}]})"
      "\n");
}

TEST_F(DiagnosticFormats, WithoutAPlaceTheKeysOfThePlaceAreAbsent) {
  const Finding finding{Diagnostic(DiagnosticKind::no_light, {}, "no light"), Severity::error};
  EXPECT_EQ(json_line(finding, sources_),
            R"({"version":1,"code":"L0302","name":"no-light","severity":"error",)"
            R"("message":"no light","labels":[],"notes":[],"hints":[],"fixits":[]})"
            "\n");
}

TEST_F(DiagnosticFormats, InvalidBytesAndControlsAreMadeSafe) {
  const Finding finding{Diagnostic(DiagnosticKind::no_light, {}, "\xff\x1b[31m\n"),
                        Severity::warning};
  const std::string line = json_line(finding, sources_);
  EXPECT_NE(line.find(R"(\ufffd\u001b[31m\n)"), std::string::npos) << line;
  EXPECT_EQ(line.find('\n'), line.size() - 1);
}

// Places in derived text are those of its origin; fixes of derived text are left out.
TEST_F(DiagnosticFormats, PlacesAreResolvedThroughDerivedFiles) {
  const FileId derived = sources_.add_derived(file_, "y = 1;", {{0, 6, 12, 18}});
  const Finding finding{
      Diagnostic(DiagnosticKind::shadowed_name, {derived, 0, 6}, "m").fix({derived, 0, 1}, "z"),
      Severity::warning};
  const std::string line = json_line(finding, sources_);
  EXPECT_NE(line.find(R"("line":2,"column":4,)"), std::string::npos) << line;
  EXPECT_NE(line.find(R"("fixits":[])"), std::string::npos) << line;
  EXPECT_EQ(sarif_log({&finding, 1}, sources_).find("fixes"), std::string::npos);
}

TEST_F(DiagnosticFormats, ASarifLogHasRulesPlacesAndFixes) {
  const std::vector<Finding> findings{
      {Diagnostic(DiagnosticKind::shadowed_name, x_, "first").hint("h").fix(x_, "y"),
       Severity::error},
      {Diagnostic(DiagnosticKind::unused_declaration, x_, "second").note("n", {file_, 0, 3}),
       Severity::warning},
      {Diagnostic(DiagnosticKind::shadowed_name, x_, "third"), Severity::warning}};
  const std::string log = sarif_log(findings, sources_);
  const auto count = [&](std::string_view part) {
    int found = 0;
    for (std::size_t at = log.find(part); at != std::string::npos; at = log.find(part, at + 1)) {
      ++found;
    }
    return found;
  };
  EXPECT_EQ(count(R"("version": "2.1.0")"), 1);
  EXPECT_EQ(count(R"("version": "0.1.0")"), 1);
  EXPECT_EQ(count(R"("columnKind": "unicodeCodePoints")"), 1);
  EXPECT_EQ(count(R"("id": )"), 2);  // a rule for each kind that occurs
  EXPECT_LT(log.find(R"("id": "L0201")"), log.find(R"("id": "L0202")"));
  EXPECT_EQ(count(R"("ruleIndex": 1)"), 2);
  EXPECT_EQ(count(R"("level": "error")"), 1);
  EXPECT_EQ(count(R"("text": "first\nhelp: h")"), 1);
  EXPECT_EQ(count(R"("uri": "a%20b/%C3%A4%3A%23.sdl")"), 5);
  EXPECT_EQ(count(R"("deletedRegion")"), 1);
  EXPECT_EQ(count(R"("relatedLocations")"), 1);
  EXPECT_EQ(count(R"("startColumn": 4)"), 4);
}

TEST_F(DiagnosticFormats, SarifListsHoldNothingTwice) {
  const Finding finding{Diagnostic(DiagnosticKind::shadowed_name, x_, "m")
                            .note("expanded from `f` here", {file_, 0, 3})
                            .note("expanded from `f` here", {file_, 0, 3})
                            .fix(x_, "y")
                            .fix(x_, "y"),
                        Severity::warning};
  const std::string log = sarif_log({&finding, 1}, sources_);
  EXPECT_EQ(log.find("expanded from"), log.rfind("expanded from")) << log;
  EXPECT_EQ(log.find("insertedContent"), log.rfind("insertedContent")) << log;
}

TEST_F(DiagnosticFormats, AnAbsolutePathBecomesAFileUri) {
  const FileId file = sources_.add("/tmp/a b.sdl", std::string("x"));
  const Finding finding{Diagnostic(DiagnosticKind::no_light, {file, 0, 1}, "m"), Severity::warning};
  EXPECT_NE(sarif_log({&finding, 1}, sources_).find(R"("uri": "file:///tmp/a%20b.sdl")"),
            std::string::npos);
}

TEST_F(DiagnosticFormats, ASarifLogOfNothingHasNoResults) {
  const std::string log = sarif_log({}, sources_);
  EXPECT_NE(log.find(R"("results": [])"), std::string::npos) << log;
  EXPECT_NE(log.find(R"("rules": [])"), std::string::npos) << log;
}

}  // namespace
}  // namespace scenec::runtime
