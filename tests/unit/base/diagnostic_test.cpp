#include "base/diagnostic.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <set>
#include <thread>

namespace scenec {
namespace {

using testing::ElementsAre;

const FileId file_0{0};
const FileId file_1{1};

const DiagnosticKindInfo* find_kind(bool (*wanted)(const DiagnosticKindInfo&)) {
  for (const DiagnosticKindInfo& info : all_diagnostic_kinds()) {
    if (wanted(info)) return &info;
  }
  return nullptr;
}

TEST(DiagnosticKinds, AreWellFormed) {
  std::set<std::string_view> codes;
  std::set<std::string_view> names;
  for (const DiagnosticKindInfo& info : all_diagnostic_kinds()) {
    SCOPED_TRACE(info.code);
    EXPECT_TRUE(codes.insert(info.code).second) << "the code is given twice";
    EXPECT_TRUE(names.insert(info.name).second) << "the name is given twice";
    ASSERT_EQ(info.code.size(), 5U);
    EXPECT_EQ(info.code[0], info.severity == Severity::error ? 'E' : 'L');
    EXPECT_TRUE(std::all_of(info.code.begin() + 1, info.code.end(),
                            [](unsigned char c) { return std::isdigit(c) != 0; }));
    EXPECT_EQ(info.name.find('_'), std::string_view::npos);
    EXPECT_FALSE(info.title.empty());
    EXPECT_EQ(info.title.find('\n'), std::string_view::npos);
    EXPECT_FALSE(info.title.ends_with('.'));
    EXPECT_GE(info.explanation.size(), 20U) << "an author should learn something";
    EXPECT_EQ(&info_of(info.kind), &info);
  }
}

TEST(DiagnosticKinds, NamesCarryDashes) {
  EXPECT_EQ(info_of(DiagnosticKind::file_unreadable).name, "file-unreadable");
  EXPECT_EQ(info_of(DiagnosticKind::file_unreadable).code, "E0601");
}

TEST(Diagnostic, IsBuiltInOneExpression) {
  const Diagnostic diagnostic = Diagnostic(DiagnosticKind::file_unreadable, {file_0, 1, 2}, "text")
                                    .label({file_0, 1, 2}, "here")
                                    .note("seen")
                                    .hint("try")
                                    .fix({file_0, 1, 2}, "b");
  EXPECT_EQ(diagnostic.labels.at(0).text, "here");
  EXPECT_FALSE(diagnostic.notes.at(0).span.valid());
  EXPECT_EQ(diagnostic.hints.at(0), "try");
  EXPECT_EQ(diagnostic.fixits.at(0).replacement, "b");
}

std::vector<std::string> messages(const DiagnosticSink& sink) {
  std::vector<std::string> result;
  for (const Diagnostic& diagnostic : sink.sorted()) result.push_back(diagnostic.message);
  return result;
}

TEST(DiagnosticSink, DropsASecondOneOfTheSameKindAndSpan) {
  DiagnosticSink sink;
  sink.report({DiagnosticKind::file_unreadable, {file_0, 3, 5}, "first"});
  sink.report({DiagnosticKind::file_unreadable, {file_0, 3, 5}, "second"});
  sink.report({DiagnosticKind::file_unreadable, {file_0, 3, 6}, "wider"});
  EXPECT_EQ(sink.error_count(), 2U);
  EXPECT_THAT(messages(sink), ElementsAre("first", "wider"));
}

TEST(DiagnosticSink, WithoutAPlaceTheMessageDecides) {
  DiagnosticSink sink;
  sink.report({DiagnosticKind::file_unreadable, {}, "a"});
  sink.report({DiagnosticKind::file_unreadable, {}, "b"});
  sink.report({DiagnosticKind::file_unreadable, {}, "a"});
  EXPECT_THAT(messages(sink), ElementsAre("a", "b"));
}

TEST(DiagnosticSink, SortsByPlace) {
  DiagnosticSink sink;
  sink.report({DiagnosticKind::file_unreadable, {}, "nowhere"});
  sink.report({DiagnosticKind::file_unreadable, {file_1, 0, 1}, "second file"});
  sink.report({DiagnosticKind::file_unreadable, {file_0, 9, 10}, "late"});
  sink.report({DiagnosticKind::file_unreadable, {file_0, 2, 4}, "early, wide"});
  sink.report({DiagnosticKind::file_unreadable, {file_0, 2, 3}, "early, narrow"});
  EXPECT_THAT(messages(sink),
              ElementsAre("early, narrow", "early, wide", "late", "second file", "nowhere"));
}

TEST(DiagnosticSink, CountsByWhatItHolds) {
  DiagnosticSink sink;
  EXPECT_FALSE(sink.has_errors());
  EXPECT_FALSE(sink.only_limits());
  std::uint32_t offset = 0;
  const auto report = [&](const DiagnosticKindInfo* info) {
    if (info == nullptr) return false;
    sink.report({info->kind, {file_0, offset, offset + 1}, "text"});
    ++offset;
    return true;
  };
  const auto is_warning = [](const DiagnosticKindInfo& info) {
    return info.severity == Severity::warning;
  };
  const auto is_limit = [](const DiagnosticKindInfo& info) { return info.is_limit(); };
  if (report(find_kind(is_warning))) {
    EXPECT_EQ(sink.warning_count(), 1U);
    EXPECT_FALSE(sink.has_errors());
    EXPECT_FALSE(sink.only_limits());
  }
  if (report(find_kind(is_limit))) {
    EXPECT_TRUE(sink.only_limits());
  }
  report(&info_of(DiagnosticKind::file_unreadable));
  EXPECT_TRUE(sink.has_errors());
  EXPECT_FALSE(sink.only_limits());
}

TEST(DiagnosticSink, OrderDoesNotDependOnThreads) {
  DiagnosticSink alone;
  DiagnosticSink shared;
  const auto diagnostic = [](std::uint32_t i) {
    return Diagnostic(DiagnosticKind::file_unreadable, {file_0, i, i + 1}, std::to_string(i));
  };
  for (std::uint32_t i = 0; i < 400; ++i) alone.report(diagnostic(i));
  {
    std::vector<std::jthread> threads;
    for (std::uint32_t thread = 0; thread < 4; ++thread) {
      threads.emplace_back([&, thread] {
        for (std::uint32_t i = 0; i < 400; ++i)
          shared.report(diagnostic((i * 7 + thread * 100) % 400));
      });
    }
  }
  EXPECT_EQ(shared.error_count(), 400U);
  EXPECT_EQ(messages(shared), messages(alone));
}

}  // namespace
}  // namespace scenec
