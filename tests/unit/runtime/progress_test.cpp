#include "runtime/progress.hpp"

#include <gtest/gtest.h>

#include <sstream>

namespace scenec::runtime {
namespace {

std::string printed(ProgressStyle style, bool terminal, int steps) {
  std::ostringstream out;
  const Environment environment{.out = out,
                                .err = out,
                                .err_is_terminal = terminal,
                                .variable = [](std::string_view) { return std::nullopt; },
                                .handle_signals = false};
  ProgressPrinter printer(style, environment);
  for (int i = 0; i <= steps; ++i) {
    printer.update({.fraction = static_cast<double>(i) / steps, .samples_done = i});
  }
  printer.finish();
  return out.str();
}

TEST(Progress, PlainIsOneLineEveryTenPercent) {
  const std::string expected = "10 %\n20 %\n30 %\n40 %\n50 %\n60 %\n70 %\n80 %\n90 %\n100 %\n";
  EXPECT_EQ(printed(ProgressStyle::plain, true, 1000), expected);
  EXPECT_EQ(printed(ProgressStyle::automatic, false, 1000), expected);
  EXPECT_EQ(printed(ProgressStyle::plain, true, 1), "100 %\n");
}

TEST(Progress, TheRewrittenLineIsLimitedInRateAndLeftEmpty) {
  const std::string text = printed(ProgressStyle::automatic, true, 1000);
  EXPECT_TRUE(text.starts_with("\r  0 %  0 samples a pixel\x1b[K")) << text;
  EXPECT_TRUE(text.ends_with("\r\x1b[K"));
  EXPECT_LT(text.size(), 1000u);  // a thousand updates in no time are not a thousand lines
  EXPECT_EQ(text.find('\n'), std::string::npos);
}

TEST(Progress, JsonIsOneObjectALineAndNoneIsSilent) {
  EXPECT_TRUE(printed(ProgressStyle::json, false, 10)
                  .starts_with(R"({"event":"progress","fraction":0.0000)"));
  EXPECT_EQ(printed(ProgressStyle::none, true, 10), "");
}

TEST(Progress, DurationsReadLikeSpeech) {
  EXPECT_EQ(duration_text(0.2), "0 s");
  EXPECT_EQ(duration_text(59.4), "59 s");
  EXPECT_EQ(duration_text(250), "4 min 10 s");
  EXPECT_EQ(duration_text(7500), "2 h 5 min");
}

}  // namespace
}  // namespace scenec::runtime
