#include "runtime/option_values.hpp"

#include <gtest/gtest.h>

namespace scenec::runtime {
namespace {

TEST(OptionValues, WholeNumbersAreDigitsOnlyAndInRange) {
  EXPECT_EQ(parse_whole_number("64", 1, 100).value(), 64);
  EXPECT_EQ(parse_whole_number("0064", 1, 100).value(), 64);
  for (const char* const text : {"", "-1", "+1", "1e3", "1.0", " 1", "1 ", "0x10", "1_000", "101",
                                 "0", "99999999999999999999999"}) {
    const auto value = parse_whole_number(text, 1, 100);
    ASSERT_FALSE(value) << text;
    EXPECT_EQ(value.error(), "a whole number from 1 to 100, written in plain digits");
  }
}

TEST(OptionValues, SizesHaveTwoSidesAndALimit) {
  EXPECT_EQ(parse_size("640x480").value(), (ir::ImageSize{640, 480}));
  EXPECT_EQ(parse_size("1x65535").value(), (ir::ImageSize{1, 65535}));
  for (const char* const text :
       {"", "640", "0x0", "640x", "x480", "640X480", "1x2x3", "-1x5", "65536x1", "65535x65535"}) {
    EXPECT_FALSE(parse_size(text)) << text;
  }
}

TEST(OptionValues, RegionsAreNotEmpty) {
  EXPECT_EQ(parse_region("0,1,20,30").value(), (ir::Region{0, 1, 20, 30}));
  for (const char* const text : {"", "0,0,1", "0,0,0,1", "5,0,4,1", "0,0,1,-1", "0,0,1,1,1"}) {
    EXPECT_FALSE(parse_region(text)) << text;
  }
}

TEST(OptionValues, DurationsNeedAUnit) {
  EXPECT_DOUBLE_EQ(parse_duration("500ms").value().value, 0.5);
  EXPECT_DOUBLE_EQ(parse_duration("30s").value().value, 30);
  EXPECT_DOUBLE_EQ(parse_duration("2min").value().value, 120);
  EXPECT_DOUBLE_EQ(parse_duration("1.5h").value().value, 5400);
  for (const char* const text :
       {"", "30", "s", "0s", "-1s", "1e400s", "infs", "nans", "1 s", "1m"}) {
    EXPECT_FALSE(parse_duration(text)) << text;
  }
}

TEST(OptionValues, SettingsSplitAtTheFirstEqualsSign) {
  EXPECT_EQ(parse_setting("a=b=c").value().name, "a");
  EXPECT_EQ(parse_setting("a=b=c").value().value, "b=c");
  EXPECT_EQ(parse_setting("a=").value().value, "");
  EXPECT_FALSE(parse_setting("a"));
  EXPECT_FALSE(parse_setting("=1"));
}

}  // namespace
}  // namespace scenec::runtime
