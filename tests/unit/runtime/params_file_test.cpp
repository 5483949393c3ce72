#include "runtime/params_file.hpp"

#include <gtest/gtest.h>

#include "base/render_diagnostic.hpp"

namespace scenec::runtime {
namespace {

struct Read {
  std::optional<std::vector<frontend::ParamSetting>> settings;
  std::string messages;
  std::vector<std::string_view> marked;  // text of each diagnostic's span
  SourceMap sources;
};

void read(const std::string& text, Read& result) {
  MemoryFileSystem files;
  files.put("p.json", text);
  DiagnosticSink sink;
  result.settings = read_params_file("p.json", files, result.sources, sink);
  for (const Diagnostic& diagnostic : sink.sorted()) {
    result.messages += diagnostic.message + "\n";
    if (diagnostic.span.valid()) result.marked.push_back(result.sources.text(diagnostic.span));
  }
}

TEST(ParamsFile, ValuesBecomeExpressions) {
  Read result;
  read(R"({"a": 1, "b": -2.5e-7, "c": "20cm", "d": true, "e": [1, "2 \"m\"", [false, []]],
           "f": 9223372036854775808, "": 0})",
       result);
  ASSERT_TRUE(result.settings) << result.messages;
  const auto& all = *result.settings;
  ASSERT_EQ(all.size(), 7u);
  EXPECT_EQ(all[0].value, "1");
  EXPECT_FALSE(all[0].is_text);
  EXPECT_EQ(all[1].value, "-2.5e-07");
  EXPECT_EQ(all[2].value, "20cm");
  EXPECT_TRUE(all[2].is_text);
  EXPECT_EQ(all[3].value, "true");
  EXPECT_EQ(all[4].value, R"([1, 2 "m", [false, []]])");
  EXPECT_EQ(all[4].quoted, R"([1, "2 \"m\"", [false, []]])");
  EXPECT_EQ(all[5].value, "9223372036854775808");
  EXPECT_EQ(result.sources.text(all[2].span), "\"c\"");
}

TEST(ParamsFile, AnEmptyObjectSetsNothing) {
  Read result;
  read("{}", result);
  ASSERT_TRUE(result.settings);
  EXPECT_TRUE(result.settings->empty());
}

TEST(ParamsFile, MistakesAreMarkedInTheFile) {
  struct Case {
    std::string text;
    std::string_view message;
    std::string_view marked;
  };
  const std::vector<Case> cases{
      {R"({"a": null})", "the value of `a` is `null`", "\"a\""},
      {R"({"a": 1, "b": {"c": 1}})", "the value of `b` is an object", "\"b\""},
      {R"({"a": [null]})", "the value of `a` is `null`", "\"a\""},
      {R"({"a": 1, "a": 2})", "`a` is given twice", "\"a\""},
      {"{\"a\": 1,}", "this is no JSON", "}"},
      {"{\"a\": 1e999}", "this is no JSON", "9"},
      {"[[[", "the file holds an array", ""},
      {"7", "the file holds a single value", ""},
      {"null", "the file holds `null`", ""},
      {"", "this is no JSON", ""},
      {"{\"a\": [[[[[[[[[1]]]]]]]]]}", "nested more than 8 deep", "["},
      {"{\"a\": \"\xff\"}", "this is no JSON", "\xff"},
  };
  for (const Case& test : cases) {
    Read result;
    read(test.text, result);
    EXPECT_FALSE(result.settings) << test.text;
    EXPECT_NE(result.messages.find(test.message), std::string::npos) << test.text << "\n"
                                                                     << result.messages;
    ASSERT_EQ(result.marked.size(), 1u) << test.text;
    EXPECT_EQ(result.marked[0], test.marked) << test.text;
  }
}

TEST(ParamsFile, AMissingFileIsSaid) {
  MemoryFileSystem files;
  SourceMap sources;
  DiagnosticSink sink;
  EXPECT_FALSE(read_params_file("p.json", files, sources, sink));
  ASSERT_EQ(sink.sorted().size(), 1u);
  EXPECT_EQ(sink.sorted()[0].message, "`--params` is `p.json`: no such file");
}

}  // namespace
}  // namespace scenec::runtime
