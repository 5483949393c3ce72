#include "base/text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>
#include <random>
#include <string>

namespace scenec {
namespace {

using testing::Optional;

constexpr double infinity = std::numeric_limits<double>::infinity();

// ---- numbers ------------------------------------------------------------------------------------

TEST(NumberText, IsALanguageNumeral) {
  EXPECT_EQ(number_text(0), "0.0");
  EXPECT_EQ(number_text(-0.0), "-0.0");
  EXPECT_EQ(number_text(1), "1.0");
  EXPECT_EQ(number_text(-3), "-3.0");
  EXPECT_EQ(number_text(0.1), "0.1");
  EXPECT_EQ(number_text(0.1 + 0.2), "0.30000000000000004");
  EXPECT_EQ(number_text(1e-7), "1e-07");
  EXPECT_EQ(number_text(1e22), "1e+22");
  EXPECT_EQ(number_text(123456789), "123456789.0");
  EXPECT_EQ(number_text(5e-324), "5e-324");
  EXPECT_EQ(number_text(1.7976931348623157e308), "1.7976931348623157e+308");
}

void expect_round_trip(double value) {
  const std::string text = number_text(value);
  EXPECT_NE(text.find_first_of(".e"), std::string::npos) << text;
  const auto back = parse_double(text);
  ASSERT_TRUE(back.has_value()) << text;
  EXPECT_EQ(std::bit_cast<std::uint64_t>(*back), std::bit_cast<std::uint64_t>(value)) << text;
}

TEST(NumberText, ReadsBackToTheSameBits) {
  std::mt19937_64 random(20240501);
  for (int i = 0; i < 100000; ++i) {
    const double value = std::bit_cast<double>(random());
    if (std::isfinite(value)) expect_round_trip(value);
    // Subnormals are too rare among random bits.
    expect_round_trip(std::bit_cast<double>(random() & 0x800fffffffffffffU));
  }
  for (const double value :
       {0.0, -0.0, std::numeric_limits<double>::max(), std::numeric_limits<double>::min(),
        std::numeric_limits<double>::denorm_min()}) {
    expect_round_trip(value);
  }
}

TEST(NumberText, RefusesWhatIsNotFinite) {
  EXPECT_DEATH((void)number_text(infinity), "internal failure");
  EXPECT_DEATH((void)number_text(std::numeric_limits<double>::quiet_NaN()), "internal failure");
}

TEST(ShortNumberText, IsForPeople) {
  EXPECT_EQ(short_number_text(1), "1");
  EXPECT_EQ(short_number_text(-0.0), "0");
  EXPECT_EQ(short_number_text(0.1 + 0.2), "0.3");
  EXPECT_EQ(short_number_text(-2.5), "-2.5");
  EXPECT_EQ(short_number_text(1048576), "1048576");
  EXPECT_EQ(short_number_text(-999999999999.0), "-999999999999");
  EXPECT_EQ(short_number_text(1e12), "1e+12");
  EXPECT_EQ(short_number_text(1234567.5), "1.23457e+06");
}

TEST(ParseDouble, short_decimals_are_rounded_as_from_chars_rounds_them) {
  std::mt19937_64 random(20240607);
  for (int round = 0; round < 200'000; ++round) {
    std::string text = std::to_string(random() % 100'000'000'000'000'000ULL >> random() % 50);
    if (round % 4 != 0) text.insert(1 + random() % text.size(), ".");
    if (text.back() == '.') text += '0';
    double expected = 0;
    std::from_chars(text.data(), text.data() + text.size(), expected);
    ASSERT_THAT(parse_double(text), Optional(expected)) << text;
  }
}

TEST(ParseDouble, AcceptsNumbersOnly) {
  EXPECT_THAT(parse_double("1"), Optional(1.0));
  EXPECT_THAT(parse_double("-1.5e3"), Optional(-1500.0));
  EXPECT_THAT(parse_double(".5"), Optional(0.5));
  EXPECT_THAT(parse_double("5."), Optional(5.0));
  EXPECT_THAT(parse_double("4.9406564584124654e-324"),
              Optional(std::numeric_limits<double>::denorm_min()));
  for (const std::string_view text : {"", " 1", "1 ", "1x", "+1", "--1", "inf", "-inf", "nan",
                                      "NaN", "infinity", "0x10", "1e", "e5", "1,5", ".", "-"}) {
    EXPECT_EQ(parse_double(text), std::nullopt) << text;
  }
}

TEST(ParseDouble, OverflowIsRefusedAndUnderflowIsZero) {
  EXPECT_EQ(parse_double("1e309"), std::nullopt);
  EXPECT_EQ(parse_double("-1e309"), std::nullopt);
  EXPECT_EQ(parse_double(std::string(400, '9')), std::nullopt);
  EXPECT_EQ(parse_double("0.001e999"), std::nullopt);
  EXPECT_THAT(parse_double("1e-400"), Optional(0.0));
  EXPECT_THAT(parse_double("0." + std::string(400, '0') + "1"), Optional(0.0));
  EXPECT_TRUE(std::signbit(parse_double("-1e-400").value_or(1)));
  EXPECT_THAT(parse_double("0e999"), Optional(0.0));
  // The digits and the exponent decide together, and the exponent may be of any length.
  EXPECT_EQ(parse_double(std::string(700, '9') + "e-200"), std::nullopt);
  EXPECT_THAT(parse_double("0." + std::string(700, '0') + "1e+200"), Optional(0.0));
  EXPECT_THAT(parse_double("1e-99999999999999999999999"), Optional(0.0));
  EXPECT_EQ(parse_double("1e99999999999999999999999"), std::nullopt);
}

// 2^53 + 1 lies exactly between two doubles; a digit far behind decides.
TEST(ParseDouble, IsCorrectlyRounded) {
  EXPECT_THAT(parse_double("9007199254740993"), Optional(9007199254740992.0));
  EXPECT_THAT(parse_double("9007199254740993.0000000000000000000000000000000001"),
              Optional(9007199254740994.0));
}

TEST(ParseInt, CoversTheWholeRange) {
  EXPECT_THAT(parse_int("9223372036854775807"), Optional(std::numeric_limits<std::int64_t>::max()));
  EXPECT_THAT(parse_int("-9223372036854775808"),
              Optional(std::numeric_limits<std::int64_t>::min()));
  EXPECT_THAT(parse_int("007"), Optional(7));
  for (const std::string_view text : {"", "9223372036854775808", "1.0", "1e3", " 1", "+1", "0x1"}) {
    EXPECT_EQ(parse_int(text), std::nullopt) << text;
  }
}

// ---- names --------------------------------------------------------------------------------------

constexpr std::array<std::string_view, 8> keys = {"center", "radius",    "roughness", "material",
                                                  "ior",    "transform", "color",     "m"};

TEST(NearestName, FindsTypingMistakes) {
  EXPECT_THAT(nearest_name("radus", keys), Optional(std::string_view("radius")));
  EXPECT_THAT(nearest_name("raduis", keys), Optional(std::string_view("radius")));
  EXPECT_THAT(nearest_name("centre", keys), Optional(std::string_view("center")));
  EXPECT_THAT(nearest_name("colour", keys), Optional(std::string_view("color")));
  EXPECT_THAT(nearest_name("Radius", keys), Optional(std::string_view("radius")));
  EXPECT_THAT(nearest_name("roughnes", keys), Optional(std::string_view("roughness")));
  EXPECT_THAT(nearest_name("oir", keys), Optional(std::string_view("ior")));
  EXPECT_THAT(nearest_name("tarnsfrom", keys), Optional(std::string_view("transform")));
}

TEST(NearestName, IsSilentWhenNothingIsNear) {
  for (const std::string_view word : {"", "x", "fog", "position", "rad", "eye"}) {
    EXPECT_EQ(nearest_name(word, keys), std::nullopt) << word;
  }
  EXPECT_EQ(nearest_name("radius", {}), std::nullopt);
  EXPECT_EQ(nearest_name(std::string(1 << 20, 'r'), keys), std::nullopt);
}

TEST(NearestName, PrefersTheNearestThenTheFirst) {
  constexpr std::array<std::string_view, 4> names = {"spheres", "spherf", "sphere", "spherg"};
  EXPECT_THAT(nearest_name("sphere", names), Optional(std::string_view("sphere")));
  EXPECT_THAT(nearest_name("spherx", names), Optional(std::string_view("spherf")));
}

TEST(QuotedList, CutsLongLists) {
  EXPECT_EQ(quoted_list({}), "");
  EXPECT_EQ(quoted_list(std::span(keys).first(1)), "`center`");
  EXPECT_EQ(quoted_list(std::span(keys).first(3)), "`center`, `radius`, `roughness`");
  EXPECT_EQ(quoted_list(keys, 2), "`center`, `radius` and 6 more");
}

// ---- escapes ------------------------------------------------------------------------------------

TEST(Printable, EscapesAndCuts) {
  EXPECT_EQ(printable("wood"), "wood");
  EXPECT_EQ(printable("木の板"), "木の板");
  EXPECT_EQ(printable("a\nb\tc\x1b[31m"), "a\\nb\\tc\\u{1b}[31m");
  EXPECT_EQ(printable(std::string_view("a\0b", 3)), "a\\u{0}b");
  EXPECT_EQ(printable("\xff\xc3"), "\\xff\\xc3");
  EXPECT_EQ(printable("\u202egnp"), "\\u{202e}gnp");  // would show the rest right to left
  EXPECT_EQ(printable("abcdef", 3), "abc…");
  EXPECT_EQ(printable("äöü", 3), "äöü");
  EXPECT_EQ(printable("äöüß", 3), "äöü…");
}

TEST(QuotedString, UsesTheLanguagesEscapes) {
  EXPECT_EQ(quoted_string("plain"), "\"plain\"");
  EXPECT_EQ(quoted_string("a\"b\\c\nd\te"), R"("a\"b\\c\nd\te")");
  EXPECT_EQ(quoted_string("\x01\x7f木"), R"("\u{1}\u{7f}木")");
}

// ---- UTF-8 --------------------------------------------------------------------------------------

TEST(Utf8, FindsTheFirstInvalidByte) {
  for (const std::string_view valid :
       {"", "abc", "ä", "木", "😀", "\u00ff\uffff", "\U0010ffff", "\ud7ff\ue000"}) {
    EXPECT_EQ(find_invalid_utf8(valid), std::nullopt) << valid;
  }
  const std::array<std::string_view, 12> invalid = {
      "\x80",  // continues nothing
      "\xc3",
      "\xe6\x9c",
      "\xf0\x9f\x98",  // cut short
      "\xc0\x80",
      "\xc1\xbf",  // overlong, 2 bytes
      "\xe0\x9f\xbf",
      "\xf0\x8f\xbf\xbf",  // overlong, 3 and 4
      "\xed\xa0\x80",
      "\xf4\x90\x80\x80",  // surrogate, above U+10FFFF
      "\xf8\x88\x80\x80",
      "\xff"};
  for (const std::string_view bytes : invalid) {
    EXPECT_THAT(find_invalid_utf8(bytes), Optional(std::size_t{0}));
    for (const std::size_t before : {1UL, 7UL, 8UL, 9UL, 16UL, 31UL}) {
      const std::string text = std::string(before, 'a') + std::string(bytes) + "tail";
      EXPECT_THAT(find_invalid_utf8(text), Optional(before));
    }
  }
}

TEST(Utf8, CountsCodePoints) {
  EXPECT_EQ(count_code_points(""), 0U);
  EXPECT_EQ(count_code_points("abc"), 3U);
  EXPECT_EQ(count_code_points("aä木😀"), 4U);
  std::string text;
  for (std::size_t count = 0; count < 100; ++count) {
    EXPECT_EQ(count_code_points(text), count);
    text += std::array{"x", "é", "界", "🎨"}[count % 4];
  }
}

}  // namespace
}  // namespace scenec
