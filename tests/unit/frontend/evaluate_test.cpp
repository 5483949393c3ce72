#include "frontend/eval/evaluate.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>

#include "frontend/eval/color.hpp"
#include "frontend/eval/math.hpp"
#include "tests/unit/frontend/compile_fixture.hpp"

namespace scenec::frontend::test {
namespace {

struct Case {
  std::string expression;
  double value;
  Dimension dimension;
  bool integer = false;
};

TEST(Evaluate, numbers_and_dimensions) {
  const std::vector<Case> cases{
      {"7", 7, {}, true},
      {"7.0", 7, {}},
      {"1e3m", 1000, dimension::length},
      {"40mm", 0.04, dimension::length},
      {"5%", 0.05, {}},
      {"180deg", pi, dimension::angle},
      {"1 + 2 * 3", 7, {}, true},
      {"7 / 2", 3.5, {}},
      {"6 / 2", 3, {}},
      {"-7 % 3", 2, {}, true},
      {"7 % -3", -2, {}, true},
      {"-7.5 % 2", 0.5, {}},
      {"1m + 50cm", 1.5, dimension::length},
      {"1 + 50cm", 1.5, dimension::length},
      {"2m * 3m", 6, {.length = 2}},
      {"6m / 2m", 3, {}},
      {"10m / 2s", 5, {.length = 1, .time = -1}},
      {"(2m * 8m) / 4m", 4, dimension::length},
      {"sqrt(9m * 4m)", 6, dimension::length},
      {"pow(2m, 3)", 8, {.length = 3}},
      {"pow(2, 0.5)", std::sqrt(2.0), {}},
      {"-(3)", -3, {}, true},
      {"--3", 3, {}, true},
      {"2 - -3", 5, {}, true},
      {"sin(90deg)", 1, {}},
      {"cos(90deg)", 0, {}},
      {"sin(0)", 0, {}},
      {"atan2(1m, 1m)", pi / 4, dimension::angle},
      {"asin(1)", pi / 2, dimension::angle},
      {"abs(-3m)", 3, dimension::length},
      {"abs(-3)", 3, {}, true},
      {"min(3, 2, 5)", 2, {}, true},
      {"max(1m, 2)", 2, dimension::length},
      {"clamp(5, 0, 3)", 3, {}, true},
      {"mix(1, 3, 0.25)", 1.5, {}},
      {"mix(1m, 3, 50%)", 2, dimension::length},
      {"smoothstep(0, 1, 0.5)", 0.5, {}},
      {"floor(-1.5)", -2, {}, true},
      {"ceil(1.2)", 2, {}, true},
      {"round(2.5)", 3, {}, true},
      {"length([3m, 4m, 0m])", 5, dimension::length},
      {"dot([1, 2, 3], [4, 5, 6])", 32, {}},
      {"len([1, 2, 3, 4])", 4, {}, true},
      {"len(\"añb\")", 3, {}, true},
      {"sum([1, 2, 3, 4])", 10, {}, true},
      {"sum([1m, 2, 3])", 6, dimension::length},
      {"[1, 2, 3][1]", 2, {}, true},
      {"[[1, 2], [3, 4]][1][0]", 3, {}, true},
      {"[1m, 2, 3m].y", 2, dimension::length},
      {"rgb(0.1, 0.2, 0.3).g", 0.2, {}},
      {"select(1 < 2, 10, 1 % 0)", 10, {}, true},
      {"select(false, 1m, 2)", 2, dimension::length},
      {"sum([for i in 0 ..< 4: i * i])", 14, {}, true},
      {"len([for i, x in [5, 6, 7]: x + i])", 3, {}, true},
      {"len(concat([1, 2], [3, 4, 5]))", 5, {}, true},
      {"len([for i in 3 .. 1: i])", 0, {}, true},
      {"tau / pi", 2, {}},
  };
  for (const Case& c : cases) {
    const Evaluated result = evaluated(c.expression);
    EXPECT_EQ(result.codes, "") << c.expression << ": " << result.messages;
    ASSERT_TRUE(result.value.is_number()) << c.expression;
    EXPECT_DOUBLE_EQ(result.value.real(), c.value) << c.expression;
    EXPECT_EQ(result.value.dimension, c.dimension)
        << c.expression << ": " << name_of(result.value.dimension);
    EXPECT_EQ(result.value.is(Type::integer), c.integer) << c.expression;
  }
}

TEST(Evaluate, mistakes_give_exactly_one_diagnostic) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"9223372036854775807 + 1", "E0215"},
      {"-9223372036854775807 - 2", "E0215"},
      {"9223372036854775808", "E0221"},
      {"1e400", "E0221"},
      {"1e308 * 10", "E0216"},
      {"1 / 0", "E0217"},
      {"5 % 0", "E0217"},
      {"1m + 1s", "E0211"},
      {"1m + 60deg", "E0211"},
      {"60deg + 1", "E0212"},
      {"sin(60)", "E0212"},
      {"sin(1m)", "E0211"},
      {"[1m, 1s]", "E0211"},
      {"[1, \"a\", 2]", "E0220"},
      {"[1m * 1m, 2]", "E0214"},
      {"true + 1", "E0213"},
      {"\"a\" + \"b\"", "E0213"},
      {"[1, 2] + [1, 2, 3]", "E0213"},
      {"[1, 2, 3] * [1, 2, 3]", "E0213"},
      {"!3", "E0210"},
      {"-true", "E0213"},
      {"1 < 2m * 3m", "E0211"},
      {"true < false", "E0213"},
      {"1 == \"a\"", "E0213"},
      {"1 && true", "E0210"},
      {"nothing", "E0201"},
      {"nothing + 1 / nothing", "E0201 E0201"},
      {"nofn(1)", "E0206"},
      {"sin", "E0204"},
      {"sin()", "E0208"},
      {"sin(1deg, 2deg)", "E0209"},
      {"sin(b = 1deg)", "E0207"},
      {"mix(a = 1, a = 2, t = 0)", "E0207"},
      {"5furlong", "E0222"},
      {"[1, 2, 3][3]", "E0218"},
      {"[1, 2, 3][-1]", "E0218"},
      {"[1, 2, 3][1.0]", "E0210"},
      {"[1, 2].z", "E0219"},
      {"(3).x", "E0219"},
      {"sqrt(-1)", "E0236"},
      {"sqrt(2m)", "E0211"},
      {"log(0)", "E0236"},
      {"asin(2)", "E0236"},
      {"tan(90deg)", "E0236"},
      {"normalize([0, 0, 0])", "E0236"},
      {"blackbody(10K)", "E0236"},
      {"noise([1m, 2m, 3m])", "E0211"},
      {"scale(0)", "E0238"},
      {"matrix([1, 2, 3])", "E0210"},
      {"matrix([1,0,0,0, 0,1,0,0, 0,0,1,0, 1,0,0,1])", "E0239"},
      {"rotate([0, 0, 0], 1deg)", "E0237"},
      {"polyline([[0, 0]])", "E0240"},
      {"beziers([[0,0],[1,1],[2,2],[3,3],[4,4]])", "E0240"},
      {"ramp(image(\"wood.png\").r, [[1, white], [0, black]])", "E0241"},
      {"image(\"wood.png\", wrap = .repat)", "E0229"},
      {"image(\"none.png\")", "E0601"},
      {"image(\"wood.png\") + 1", "E0213"},
      {"select(true, 1, \"a\")", "E0210"},
      {"select(1, 2, 3)", "E0210"},
      {"false && nothing", "E0201"},
  };
  for (const auto& [expression, codes] : cases) {
    const Evaluated result = evaluated(expression);
    EXPECT_EQ(result.codes, codes) << expression << ": " << result.messages;
    const bool decided = expression == "false && nothing";  // the mistake is in the part not needed
    EXPECT_EQ(result.value.poisoned(), !decided) << expression;
  }
}

TEST(Evaluate, other_types) {
  EXPECT_TRUE(evaluated("1 < 2 && 2 <= 2 || nothing").value.poisoned() == false);
  EXPECT_TRUE(evaluated("\"a\" == \"a\"").value.boolean());
  EXPECT_EQ(evaluated("str(\"n = \", 3, \" \", 0.5m)").value.text(), "n = 3 0.5m");
  EXPECT_EQ(evaluated("\"\\u{e9}\\n\"").value.text(), "é\n");
  const Value color = evaluated("#f00 * 0.5").value;
  EXPECT_TRUE(color.is(Type::color));
  EXPECT_DOUBLE_EQ(color.n[0], 0.5);
  EXPECT_DOUBLE_EQ(evaluated("#808080").value.n[0], srgb_decoded(128 / 255.0));
  EXPECT_EQ(evaluated("[1, 2, 3]").value.type, Type::vec3);
  EXPECT_EQ(evaluated("[1, 2, 3, 4]").value.type, Type::list);
  EXPECT_EQ(evaluated("[1m, 2]").value.dimension, dimension::length);
  EXPECT_TRUE(evaluated("checker(0.2, 0.8)").value.grey);
  EXPECT_FALSE(evaluated("checker(black, white)").value.grey);
  EXPECT_TRUE(evaluated("image(\"wood.png\").r * 0.5").value.grey);
  EXPECT_EQ(evaluated("[move([0, 1, 0]), scale(2)]").value.type, Type::list);
}

TEST(Evaluate, rotations_by_quarter_turns_are_exact) {
  const Value turn = evaluated("rotate_y(90deg)").value;
  ASSERT_TRUE(turn.is(Type::transform));
  const ir::Transform expected{{0, 0, 1, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 0, 1}};
  EXPECT_EQ(turn.transform(), expected);
}

// Bits, not nearness: an IR hash must not depend on the C library or the CPU.
TEST(Evaluate, elementary_functions_give_the_same_bits_everywhere) {
  const auto bits = [](const std::string& text) {
    return std::bit_cast<std::uint64_t>(evaluated(text).value.real());
  };
  EXPECT_EQ(bits("sin(1rad)"), 0x3feaed548f090ceeULL);
  EXPECT_EQ(bits("atan(2.0) / 1rad"), 0x3ff1b6e192ebbe44ULL);
  EXPECT_EQ(bits("pow(2.7, 3.3)"), 0x403a83fa3634a624ULL);
  EXPECT_EQ(bits("exp(1.1)"), 0x400808883244d593ULL);
  EXPECT_EQ(bits("log(10)"), 0x40026bb1bbb55516ULL);
  EXPECT_EQ(bits("length([1e200, 2e200, 3e200])"), 0x69938d7e31a50afeULL);
}

TEST(Evaluate, random_functions_stay_in_range) {
  for (int i = 0; i < 200; ++i) {
    const std::string n = std::to_string(i);
    const double uniform = number_of("random(7, " + n + ")");
    EXPECT_TRUE(uniform >= 0 && uniform < 1);
    const double noise = number_of("noise([" + n + ".3, 0.7, " + n + ".9])");
    EXPECT_TRUE(noise >= -1 && noise <= 1);
  }
  EXPECT_EQ(number_of("noise([3, 4, 5])"), 0);
}

TEST(Evaluate, black_body_has_luminance_one) {
  for (const char* kelvin : {"1500K", "3000K", "6500K", "20000K"}) {
    const Value c = evaluated(std::string("blackbody(") + kelvin + ")").value;
    EXPECT_NEAR(0.2126729 * c.n[0] + 0.7151522 * c.n[1] + 0.0721750 * c.n[2], 1, 1e-12) << kelvin;
  }
  const Value daylight = evaluated("blackbody(6500K)").value;
  EXPECT_NEAR(daylight.n[0], daylight.n[2], 0.12);  // close to the white point of Rec. 709
}

TEST(Evaluate, a_million_terms_need_no_stack) {
  std::string sum = "0";
  for (int i = 0; i < 1'000'000; ++i) sum += "+1";
  EXPECT_EQ(number_of(sum), 1'000'000);
}

}  // namespace
}  // namespace scenec::frontend::test
