// The grammars check themselves: no rule can loop without progress, and the golden inputs make
// every rule, each repair included, succeed at least once.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <tao/pegtl.hpp>
#include <tao/pegtl/contrib/analyze.hpp>
#include <tao/pegtl/contrib/coverage.hpp>

#include "grammar/course.hpp"
#include "grammar/course_messages.hpp"
#include "grammar/sdl.hpp"
#include "grammar/sdl_actions.hpp"
#include "grammar/sdl_messages.hpp"
#include "tests/unit/grammar/inputs.hpp"

namespace scenec::grammar {
namespace {

TEST(GrammarCheck, no_rule_loops_without_progress) {
  EXPECT_EQ(peg::analyze<sdl::file>(), 0u);
  EXPECT_EQ(peg::analyze<sdl::file_part>(), 0u);
  EXPECT_EQ(peg::analyze<course::file>(), 0u);
}

// Names of our rules that succeeded over no input of the dialect.
template <class Grammar>
std::vector<std::string> uncovered(Dialect dialect) {
  std::map<std::string, std::size_t> successes;
  for (const GoldenInput& input : golden_inputs()) {
    if (input.dialect != dialect) continue;
    DiagnosticSink sink;
    TreeBuilder builder(dialect, FileId(0), input.text, 0, sink, {});
    peg::memory_input<peg::tracking_mode::lazy, peg::eol::lf_crlf, const char*> in(
        input.text.data(), input.text.size(), "");
    peg::coverage_result result;
    EXPECT_TRUE((peg::coverage<Grammar, build>(in, result, builder))) << input.name;
    for (const auto& [name, entry] : result) successes[std::string(name)] += entry.success;
  }
  std::vector<std::string> missed;
  for (const auto& [name, count] : successes) {
    if (count == 0 && name.starts_with("scenec::grammar")) missed.push_back(name);
  }
  return missed;
}

TEST(GrammarCheck, golden_inputs_cover_every_native_rule) {
  EXPECT_THAT(uncovered<sdl::file>(Dialect::sdl), testing::IsEmpty());
}

TEST(GrammarCheck, golden_inputs_cover_every_course_rule) {
  EXPECT_THAT(uncovered<course::file>(Dialect::course), testing::IsEmpty());
}

}  // namespace
}  // namespace scenec::grammar
