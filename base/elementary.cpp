// See elementary.hpp. Every function reduces its argument to a small one in double-double, sums the
// large terms of the result with their errors and leaves only a tail below 2^-3 of it to plain
// double arithmetic.
#include "base/elementary.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "base/double_double.hpp"

namespace scenec {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

constexpr DoubleDouble pi_dd{0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};
constexpr DoubleDouble half_pi_dd{0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};
constexpr double half_pi_third = -0x1.f1976b7ed8fbcp-110;
constexpr double two_over_pi = 0x1.45f306dc9c883p-1;
// ln 2 with a first part of 42 bits, so that its product with an exponent is exact.
constexpr double ln2_hi = 0x1.62e42fefa3800p-1;
constexpr double ln2_mid = 0x1.ef35793c76730p-45;
constexpr double ln2_lo = 0x1.f97b57a079a19p-103;
constexpr double one_over_ln2 = 0x1.71547652b82fep+0;

// 2^exponent for exponents of normal numbers.
double power_of_two(int exponent) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52);
}

// value * 2^exponent with one rounding of results in the normal range.
double scale_by_power(double value, int exponent) {
  if (exponent > 1023) return value * power_of_two(1023) * power_of_two(exponent - 1023);
  if (exponent < -1022) return value * power_of_two(exponent + 100) * power_of_two(-100);
  return value * power_of_two(exponent);
}

template <std::size_t n>
double horner(double x, const std::array<double, n>& coefficients) {
  double sum = coefficients[n - 1];
  for (std::size_t i = n - 1; i-- > 0;) sum = sum * x + coefficients[i];
  return sum;
}

// 1/k! for k = first, first + 2, ... with alternating signs beginning with minus.
constexpr std::array<double, 8> sin_series{
    -1.0 / 6,        1.0 / 120,        -1.0 / 5040,          1.0 / 362880,
    -1.0 / 39916800, 1.0 / 6227020800, -1.0 / 1307674368000, 1.0 / 355687428096000};
constexpr std::array<double, 7> cos_series{
    1.0 / 24,        -1.0 / 720,         1.0 / 40320,         -1.0 / 3628800,
    1.0 / 479001600, -1.0 / 87178291200, 1.0 / 20922789888000};

// |r| slightly above pi/4 at most.
DoubleDouble sin_of_reduced(const DoubleDouble& r) {
  const double z = r.hi * r.hi;
  const double tail = r.hi * z * horner(z, sin_series);
  return fast_two_sum(r.hi, tail + r.lo * (1 - 0.5 * z));
}

DoubleDouble cos_of_reduced(const DoubleDouble& r) {
  const double z = r.hi * r.hi;
  const double half = 0.5 * z;
  const double w = 1 - half;
  return fast_two_sum(w, ((1 - w) - half) + (z * z * horner(z, cos_series) - r.hi * r.lo));
}

struct ReducedAngle {
  DoubleDouble r;
  int quadrant = 0;
};

// x - n pi/2 with n the nearest integer, for |x| <= 2^48: the products with the first two parts of
// pi/2 are exact pairs, so the absolute error stays below 2^-110 while no double of this range
// comes closer than 2^-60 to a multiple.
ReducedAngle reduce_angle(double x) {
  const double n = std::floor(x * two_over_pi + 0.5);
  const DoubleDouble first = two_product(n, half_pi_dd.hi);
  const DoubleDouble second = two_product(n, half_pi_dd.lo);
  const DoubleDouble a = two_sum(x - first.hi, -first.lo);
  const DoubleDouble b = two_sum(a.hi, -second.hi);
  const DoubleDouble r = fast_two_sum(b.hi, b.lo + (a.lo - (second.lo + n * half_pi_third)));
  return {r, static_cast<int>(static_cast<std::int64_t>(n) & 3)};
}

constexpr std::array<DoubleDouble, 17> atan_of_sixteenths{{
    {0x0.0p+0, 0x0.0p+0},
    {0x1.ff55bb72cfdeap-5, -0x1.c934d86d23f1dp-60},
    {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59},
    {0x1.7b97b4bce5b02p-3, 0x1.347b0b4f881cap-58},
    {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
    {0x1.362773707ebccp-2, -0x1.963a544b672d8p-57},
    {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56},
    {0x1.a64eec3cc23fdp-2, -0x1.24dec1b50b7ffp-56},
    {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
    {0x1.0657e94db30d0p-1, -0x1.d5b495f6349e6p-56},
    {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58},
    {0x1.345f01cce37bbp-1, 0x1.1021137c71102p-55},
    {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
    {0x1.5d58987169b18p-1, 0x1.0028e4bc5e7cap-57},
    {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56},
    {0x1.819d0b7158a4dp-1, -0x1.bf76229d3b917p-56},
    {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55},
}};
constexpr std::array<double, 6> atan_series{-1.0 / 3, 1.0 / 5,   -1.0 / 7,
                                            1.0 / 9,  -1.0 / 11, 1.0 / 13};

// atan(q) for 0 <= q <= 1: atan(c) + atan((q - c) / (1 + q c)) with c the nearest sixteenth.
DoubleDouble atan_of_ratio(const DoubleDouble& q) {
  const double step = std::floor(q.hi * 16 + 0.5);
  const double c = step / 16;
  const DoubleDouble numerator = DoubleDouble{q.hi - c, 0} + DoubleDouble{q.lo, 0};
  const DoubleDouble denominator = DoubleDouble{1, 0} + q * DoubleDouble{c, 0};
  const DoubleDouble r = numerator / denominator;
  const double z = r.hi * r.hi;
  const double tail = r.lo + r.hi * z * horner(z, atan_series);
  return atan_of_sixteenths[static_cast<std::size_t>(step)] + fast_two_sum(r.hi, tail);
}

// The angle of (x, y), both finite, not both zero, y >= 0, well inside the range of exact products.
double angle_of(const DoubleDouble& y, const DoubleDouble& x) {
  const bool left = x.hi < 0;
  const DoubleDouble ax = left ? -x : x;
  const bool steep = y.hi > ax.hi || (y.hi == ax.hi && y.lo > ax.lo);
  DoubleDouble angle = atan_of_ratio(steep ? ax / y : y / ax);
  if (steep) angle = half_pi_dd + -angle;
  if (left) angle = pi_dd + -angle;
  return angle.hi + angle.lo;
}

// sqrt(1 - x^2) for |x| <= 1.
DoubleDouble cosine_of_sine(double x) {
  const DoubleDouble square = two_product(x, x);
  const DoubleDouble rest = DoubleDouble{1, 0} + -square;
  if (!(rest.hi > 0)) return {0, 0};
  const double root = std::sqrt(rest.hi);
  const DoubleDouble back = two_product(root, root);
  return fast_two_sum(root, ((rest.hi - back.hi) - back.lo + rest.lo) / (2 * root));
}

constexpr std::array<double, 12> exp_series{
    1.0 / 2,     1.0 / 6,      1.0 / 24,      1.0 / 120,      1.0 / 720,       1.0 / 5040,
    1.0 / 40320, 1.0 / 362880, 1.0 / 3628800, 1.0 / 39916800, 1.0 / 479001600, 1.0 / 6227020800};

double exp_of(const DoubleDouble& x) {
  if (x.hi > 710) return infinity;
  if (x.hi < -746) return 0;
  const double k = std::floor(x.hi * one_over_ln2 + 0.5);
  // x.hi - k ln2_hi is exact: both are multiples of the same bit and nearly equal.
  const DoubleDouble mid = two_product(k, ln2_mid);
  const DoubleDouble r = two_sum(x.hi - k * ln2_hi, -mid.hi) + DoubleDouble{x.lo - mid.lo, 0};
  const DoubleDouble lead = fast_two_sum(1, r.hi);
  const double tail = r.lo + (r.hi * r.hi * horner(r.hi, exp_series) + r.hi * r.lo);
  return scale_by_power(lead.hi + (lead.lo + tail), static_cast<int>(k));
}

constexpr DoubleDouble one_third{1.0 / 3, 0x1.5555555555555p-56};
constexpr DoubleDouble one_fifth{1.0 / 5, -0x1.999999999999ap-57};
constexpr std::array<double, 11> atanh_tail{1.0 / 7,  1.0 / 9,  1.0 / 11, 1.0 / 13,
                                            1.0 / 15, 1.0 / 17, 1.0 / 19, 1.0 / 21,
                                            1.0 / 23, 1.0 / 25, 1.0 / 27};

// log of a positive finite x to about 2^-66 relative: x = 2^k m, log m = 2 atanh((m-1)/(m+1)).
DoubleDouble log_of(double x) {
  int exponent = 0;
  double m = std::frexp(x, &exponent);  // [0.5, 1), exact
  constexpr double sqrt_half = 0x1.6a09e667f3bcdp-1;
  if (m < sqrt_half) {
    m *= 2;
    --exponent;
  }
  const double f = m - 1;
  const DoubleDouble s = DoubleDouble{f, 0} / two_sum(2, f);
  const DoubleDouble z = s * s;
  const DoubleDouble fifth = one_fifth + DoubleDouble{z.hi * horner(z.hi, atanh_tail), 0};
  const DoubleDouble third = one_third + z * fifth;
  const DoubleDouble half = s + s * (z * third);
  const double k = exponent;
  const DoubleDouble mid = two_product(k, ln2_mid);
  const DoubleDouble shift =
      DoubleDouble{k * ln2_hi, 0} + DoubleDouble{mid.hi, mid.lo + k * ln2_lo};
  return shift + DoubleDouble{2 * half.hi, 2 * half.lo};
}

bool is_integer(double y) {
  return std::floor(y) == y;
}
bool is_odd(double y) {
  return is_integer(y) && std::fabs(y) < 0x1p53 && !is_integer(y * 0.5);
}

}  // namespace

SinCos sin_cos(double x) {
  if (!(std::fabs(x) <= angle_limit)) return {not_a_number, not_a_number};
  if (std::fabs(x) < 0x1p-27) return {x, 1};
  const ReducedAngle angle = reduce_angle(x);
  const double s = sin_of_reduced(angle.r).hi;
  const double c = cos_of_reduced(angle.r).hi;
  switch (angle.quadrant) {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}

double sin(double x) {
  return sin_cos(x).sin;
}
double cos(double x) {
  return sin_cos(x).cos;
}
double tan(double x) {
  if (!(std::fabs(x) <= angle_limit)) return not_a_number;
  if (std::fabs(x) < 0x1p-27) return x;
  const ReducedAngle angle = reduce_angle(x);
  const DoubleDouble s = sin_of_reduced(angle.r);
  const DoubleDouble c = cos_of_reduced(angle.r);
  return angle.quadrant % 2 == 0 ? (s / c).hi : -(c / s).hi;
}

double atan2(double y, double x) {
  if (std::isnan(x) || std::isnan(y)) return not_a_number;
  double ay = std::fabs(y);
  if (std::isinf(x) || std::isinf(y)) {
    // Infinities act as ones beside zeros.
    ay = std::isinf(y) ? 1 : 0;
    x = std::isinf(x) ? std::copysign(1.0, x) : 0;
  }
  if (ay == 0) return std::copysign(std::signbit(x) ? pi : 0.0, y);
  const double largest = std::fmax(ay, std::fabs(x));
  // Exact scaling into the range of exact products; what underflows is then far below an ulp.
  const double scale = largest > 0x1p900 ? 0x1p-300 : largest < 0x1p-300 ? 0x1p600 : 1.0;
  ay *= scale;
  x *= scale;
  // Below 2^-30 atan(q) = q to half an ulp, and the quotient may be too small to have a pair.
  if (x > 0 && ay < x * 0x1p-30) return std::copysign(ay / x, y);
  return std::copysign(angle_of({ay, 0}, {x, 0}), y);
}

double asin(double x) {
  if (!(std::fabs(x) <= 1)) return not_a_number;
  if (std::fabs(x) < 0x1p-27) return x;
  return std::copysign(angle_of({std::fabs(x), 0}, cosine_of_sine(x)), x);
}

double acos(double x) {
  if (!(std::fabs(x) <= 1)) return not_a_number;
  if (x == 1) return 0;
  return angle_of(cosine_of_sine(x), {x, 0});
}

double exp(double x) {
  if (std::isnan(x)) return x;
  return exp_of({x, 0});
}

double log(double x) {
  if (std::isnan(x) || x < 0) return not_a_number;
  if (x == 0) return -infinity;
  if (std::isinf(x)) return x;
  const DoubleDouble l = log_of(x);
  return l.hi + l.lo;
}

double pow(double x, double y) {
  if (y == 0 || x == 1) return 1;
  if (std::isnan(x) || std::isnan(y)) return not_a_number;
  const double sign = std::signbit(x) && is_odd(y) ? -1.0 : 1.0;
  const double ax = std::fabs(x);
  if (std::isinf(y)) return ax == 1 ? 1 : (ax > 1) == (y > 0) ? infinity : 0;
  if (ax == 0 || std::isinf(ax)) return sign * ((ax == 0) == (y > 0) ? 0 : infinity);
  if (x < 0 && !is_integer(y)) return not_a_number;
  if (y == 1) return x;
  if (ax == 1) return sign;
  // |log ax| >= 2^-53 here, so these exponents over- or underflow whatever ax is.
  if (std::fabs(y) > 0x1p64) return (ax > 1) == (y > 0) ? infinity : 0;
  const DoubleDouble l = log_of(ax);
  if (std::fabs(l.hi * y) > 750) return sign * (l.hi * y > 0 ? infinity : 0);
  const DoubleDouble p = two_product(l.hi, y);
  return sign * exp_of(fast_two_sum(p.hi, p.lo + l.lo * y));
}

}  // namespace scenec
