// Our elementary functions against long double, in ulp, over their domains and at their edges.
#include "base/elementary.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <limits>

namespace scenec {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr bool oracle_is_wider = LDBL_MANT_DIG > DBL_MANT_DIG;

// The i-th number of stream `lane`, in [0, 1): splitmix64, so that the draws never change.
double random_unit(std::uint64_t i, std::uint64_t lane) {
  std::uint64_t v = (8 * i + lane + 1) * 0x9e3779b97f4a7c15ULL;
  v = (v ^ (v >> 30)) * 0xbf58476d1ce4e5b9ULL;
  v = (v ^ (v >> 27)) * 0x94d049bb133111ebULL;
  return static_cast<double>((v ^ (v >> 31)) >> 11) * 0x1p-53;
}

double error_in_ulp(double got, long double want) {
  const double rounded = static_cast<double>(want);
  if (std::isnan(rounded) || std::isinf(rounded) || rounded == 0)
    return got == rounded || (std::isnan(got) && std::isnan(rounded)) ? 0 : infinity;
  const double ulp = std::nextafter(std::fabs(rounded), infinity) - std::fabs(rounded);
  return static_cast<double>(std::fabs(static_cast<long double>(got) - want) /
                             static_cast<long double>(ulp));
}

template <class Ours, class Oracle, class Draw>
double worst_error(Ours ours, Oracle oracle, Draw draw, std::uint64_t count = 200000) {
  double worst = 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    const double x = draw(random_unit(i, 0), random_unit(i, 1));
    worst = std::fmax(worst, error_in_ulp(ours(x), oracle(static_cast<long double>(x))));
  }
  return worst;
}

double spread(double u, double v) {
  return (u < 0.5 ? -1 : 1) * std::ldexp(1 + v, static_cast<int>(60 * u) - 45);
}

#define EXPECT_WITHIN(bound, ...)                   \
  do {                                              \
    const double worst_ = worst_error(__VA_ARGS__); \
    EXPECT_LE(worst_, bound);                       \
    RecordProperty("ulp", std::to_string(worst_));  \
  } while (false)

class Elementary : public testing::Test {
 protected:
  void SetUp() override {
    if (!oracle_is_wider) GTEST_SKIP() << "long double is no wider than double here";
  }
};

TEST_F(Elementary, SinAndCosOverTheDomain) {
  const auto small = [](double u, double) { return 20 * (u - 0.5); };
  const auto large = [](double u, double) { return 2e9 * (u - 0.5); };
  const auto s = [](double x) { return sin(x); };
  const auto c = [](double x) { return cos(x); };
  const auto sl = [](long double x) { return sinl(x); };
  const auto cl = [](long double x) { return cosl(x); };
  EXPECT_WITHIN(0.8, s, sl, small);
  EXPECT_WITHIN(0.8, c, cl, small);
  EXPECT_WITHIN(0.8, s, sl, large);
  EXPECT_WITHIN(0.8, c, cl, large);
  EXPECT_WITHIN(0.8, s, sl, spread);
  EXPECT_WITHIN(0.8, [](double x) { return cos(x); }, cl, spread);
}

TEST_F(Elementary, SinNearMultiplesOfHalfPi) {
  const auto near = [](double u, double v) {
    return std::floor(1e6 * u) * (pi / 2) * (1 + (v - 0.5) * DBL_EPSILON);
  };
  EXPECT_WITHIN(0.8, [](double x) { return sin(x); }, [](long double x) { return sinl(x); }, near);
  EXPECT_WITHIN(0.8, [](double x) { return cos(x); }, [](long double x) { return cosl(x); }, near);
}

TEST_F(Elementary, Tan) {
  EXPECT_WITHIN(
      1.0, [](double x) { return tan(x); }, [](long double x) { return tanl(x); },
      [](double u, double) { return 10 * (u - 0.5); });
}

TEST_F(Elementary, AsinAndAcos) {
  const auto whole = [](double u, double) { return 2 * u - 1; };
  const auto near_one = [](double u, double v) {
    return (u < 0.5 ? -1 : 1) * (1 - std::ldexp(v, -static_cast<int>(50 * u)));
  };
  const auto as = [](double x) { return asin(x); };
  const auto ac = [](double x) { return acos(x); };
  EXPECT_WITHIN(0.8, as, [](long double x) { return asinl(x); }, whole);
  EXPECT_WITHIN(0.8, ac, [](long double x) { return acosl(x); }, whole);
  EXPECT_WITHIN(0.8, as, [](long double x) { return asinl(x); }, near_one);
  EXPECT_WITHIN(0.8, ac, [](long double x) { return acosl(x); }, near_one);
}

TEST_F(Elementary, Atan2) {
  double worst = 0;
  for (std::uint64_t i = 0; i < 200000; ++i) {
    const double y = spread(random_unit(i, 0), random_unit(i, 1));
    const double x = spread(random_unit(i, 2), random_unit(i, 3));
    worst = std::fmax(worst, error_in_ulp(atan2(y, x), atan2l(y, x)));
  }
  EXPECT_LE(worst, 0.8);
}

TEST_F(Elementary, Exp) {
  const auto e = [](double x) { return exp(x); };
  const auto el = [](long double x) { return expl(x); };
  EXPECT_WITHIN(0.8, e, el, [](double u, double) { return 1400 * (u - 0.5); });
  EXPECT_WITHIN(0.8, e, el, [](double u, double) { return 2 * (u - 0.5); });
}

TEST_F(Elementary, Log) {
  const auto l = [](double x) { return log(x); };
  const auto ll = [](long double x) { return logl(x); };
  EXPECT_WITHIN(0.55, l, ll, [](double u, double v) {
    return std::ldexp(1 + v, static_cast<int>(2000 * u) - 1000);
  });
  EXPECT_WITHIN(0.55, l, ll, [](double u, double) { return 0.9 + 0.2 * u; });
}

TEST_F(Elementary, Pow) {
  double worst = 0;
  for (std::uint64_t i = 0; i < 300000; ++i) {
    const double x =
        std::ldexp(1 + random_unit(i, 0), static_cast<int>(20 * random_unit(i, 1)) - 10);
    const double y = 120 * (random_unit(i, 2) - 0.5);
    const long double want = powl(x, y);
    // powl itself is good to about 2^-60 relative here.
    worst = std::fmax(worst, error_in_ulp(pow(x, y), want));
    const double base = random_unit(i, 3);
    const double whole = std::floor(100 * random_unit(i, 4));
    worst = std::fmax(worst, error_in_ulp(pow(base, whole), powl(base, whole)));
  }
  EXPECT_LE(worst, 0.8);
}

TEST(ElementaryEdges, ExactValuesAndZeros) {
  EXPECT_EQ(sin(0.0), 0.0);
  EXPECT_TRUE(std::signbit(sin(-0.0)));
  EXPECT_EQ(cos(0.0), 1.0);
  EXPECT_EQ(sin(1e-300), 1e-300);
  EXPECT_EQ(exp(0.0), 1.0);
  EXPECT_EQ(log(1.0), 0.0);
  EXPECT_EQ(asin(1.0), pi / 2);
  EXPECT_EQ(acos(1.0), 0.0);
  EXPECT_EQ(acos(-1.0), pi);
  EXPECT_EQ(acos(0.0), pi / 2);
  EXPECT_EQ(atan2(0.0, 1.0), 0.0);
  EXPECT_EQ(atan2(0.0, -1.0), pi);
  EXPECT_EQ(atan2(-0.0, -1.0), -pi);
  EXPECT_EQ(atan2(1.0, 0.0), pi / 2);
  EXPECT_EQ(atan2(1e308, 1e308), pi / 4);
  EXPECT_EQ(atan2(5e-324, 5e-324), pi / 4);
  EXPECT_EQ(atan2(infinity, -infinity), 3 * (pi / 4));
}

TEST(ElementaryEdges, OutsideTheDomain) {
  EXPECT_TRUE(std::isnan(sin(0x1p49)));
  EXPECT_TRUE(std::isnan(cos(infinity)));
  EXPECT_TRUE(std::isnan(tan(not_a_number)));
  EXPECT_TRUE(std::isnan(asin(1.0000000001)));
  EXPECT_TRUE(std::isnan(acos(not_a_number)));
  EXPECT_TRUE(std::isnan(log(-1.0)));
  EXPECT_EQ(log(0.0), -infinity);
  EXPECT_EQ(log(infinity), infinity);
  EXPECT_EQ(exp(infinity), infinity);
  EXPECT_EQ(exp(-infinity), 0.0);
  EXPECT_EQ(exp(710.5), infinity);
  EXPECT_EQ(exp(-746.5), 0.0);
  EXPECT_TRUE(std::isnan(exp(not_a_number)));
}

TEST(ElementaryEdges, PowAsInTheStandard) {
  for (const double x : {0.0, -0.0, 1.0, -3.0, infinity, -infinity, not_a_number, 1e-310})
    EXPECT_EQ(pow(x, 0.0), 1.0);
  for (const double y : {2.0, -3.0, 0.5, infinity, not_a_number}) EXPECT_EQ(pow(1.0, y), 1.0);
  for (const double x : {0.0, -0.0, 0.25, 2.0, -2.0, infinity, -infinity})
    for (const double y : {-infinity, -3.0, -2.0, -0.5, 0.5, 1.0, 2.0, 3.0, 1e300, infinity}) {
      const double want = std::pow(x, y);
      const double got = pow(x, y);
      if (std::isnan(want)) {
        EXPECT_TRUE(std::isnan(got)) << x << " " << y;
      } else {
        EXPECT_EQ(got, want) << x << " " << y;
      }
    }
  EXPECT_EQ(pow(2.0, 10.0), 1024.0);
  EXPECT_EQ(pow(10.0, 22.0), 1e22);
  EXPECT_EQ(pow(0.5, 20.0), 0x1p-20);
  EXPECT_EQ(pow(2.0, -1074.0), 5e-324);
}

// The bits themselves, on any machine: a hash of an IR may contain any of them.
TEST(ElementaryBits, AreTheSameEverywhere) {
  std::uint64_t digest = 0;
  const auto absorb = [&](double value) {
    digest = (digest ^ std::bit_cast<std::uint64_t>(value)) * 0x100000001b3ULL;
  };
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const double x = spread(random_unit(i, 0), random_unit(i, 1));
    const double unit = 2 * random_unit(i, 2) - 1;
    const double positive = std::fabs(x);
    for (const double value : {sin(x), cos(x), tan(x), asin(unit), acos(unit), atan2(x, unit),
                               exp(20 * unit), log(positive), pow(positive, unit)})
      absorb(value);
  }
  EXPECT_EQ(digest, 10632494973806777686ULL);
}

}  // namespace
}  // namespace scenec
