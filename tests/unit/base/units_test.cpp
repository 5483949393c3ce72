#include "base/units.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

namespace scenec {
namespace {

double si(double written, std::string_view suffix) {
  const auto unit = find_unit(suffix);
  EXPECT_TRUE(unit.has_value()) << suffix;
  return unit ? written * unit->multiply / unit->divide : 0;
}

TEST(Units, EverySuffixIsFoundAndOnlyThose) {
  std::set<std::string_view> suffixes;
  for (const Unit& unit : all_units()) {
    suffixes.insert(unit.suffix);
    EXPECT_EQ(find_unit(unit.suffix)->dimension, unit.dimension);
  }
  EXPECT_EQ(suffixes, (std::set<std::string_view>{"m", "cm", "mm", "km", "deg", "rad", "s", "ms",
                                                  "W", "K", "%"}));
  for (const std::string_view absent : {"", "M", "kg", "degree", "w", "k", "min"}) {
    EXPECT_FALSE(find_unit(absent).has_value()) << absent;
  }
}

// 35cm must be the double nearest to 0.35, not 35 * 0.01 (which is one ulp away).
TEST(Units, ScaledLengthsAreCorrectlyRounded) {
  EXPECT_EQ(si(35, "cm"), 0.35);
  EXPECT_NE(35 * 0.01, 0.35);
  for (int i = 0; i <= 10000; ++i) {
    const std::string hundredths = std::to_string(i) + "e-2";
    const std::string thousandths = std::to_string(i) + "e-3";
    ASSERT_EQ(si(i, "cm"), std::stod(hundredths)) << i;
    ASSERT_EQ(si(i, "%"), std::stod(hundredths)) << i;
    ASSERT_EQ(si(i, "mm"), std::stod(thousandths)) << i;
    ASSERT_EQ(si(i, "ms"), std::stod(thousandths)) << i;
  }
  EXPECT_EQ(si(1.5, "km"), 1500);
}

TEST(Units, AnglesOfInterestAreExact) {
  EXPECT_EQ(si(180, "deg"), std::numbers::pi);
  EXPECT_EQ(si(90, "deg"), std::numbers::pi / 2);
  EXPECT_EQ(si(360, "deg"), 2 * std::numbers::pi);
  EXPECT_EQ(si(0, "deg"), 0);
  EXPECT_EQ(si(1.25, "rad"), 1.25);
}

TEST(Units, DimensionsHaveNames) {
  EXPECT_EQ(name_of(dimension::none), "number");
  EXPECT_EQ(name_of(dimension::length), "length");
  EXPECT_EQ(name_of(dimension::angle), "angle");
  EXPECT_EQ(name_of(dimension::temperature), "temperature");
  EXPECT_EQ(name_of({.length = 2, .time = -1}), "length^2 time^-1");
  EXPECT_EQ(si_unit_of(dimension::none), "");
  EXPECT_EQ(si_unit_of(dimension::angle), "rad");
  EXPECT_EQ(si_unit_of({.length = -2, .power = 1}), "m^-2 W");
}

TEST(Units, QuantitiesCompare) {
  EXPECT_LT(Length{1}, Length{2});
  EXPECT_EQ(Angle{}, Angle{0});
  EXPECT_EQ(PowerTag::dimension, dimension::power);
}

}  // namespace
}  // namespace scenec
