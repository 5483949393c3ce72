// Sums and products of two doubles with their rounding errors, as unevaluated pairs.
//
// Domain:     no intermediate overflow; two_product: factors below 2^996 and products not so small
//             that their error underflows.
// Method:     Dekker 1971 and Knuth; the product splits its factors instead of fusing.
// Error:      two_sum and two_product exact; add, multiply, divide within 2^-100 relative unless
//             the sum cancels.
// Degenerate: infinities and NaN give NaN.
// Proof:      tests/unit/base/elementary_test.cpp, through the functions built on it.
#pragma once

namespace scenec {

struct DoubleDouble {
  double hi = 0;
  double lo = 0;
};

// Needs |a| >= |b| or a = 0.
[[nodiscard]] constexpr DoubleDouble fast_two_sum(double a, double b) {
  const double s = a + b;
  return {s, b - (s - a)};
}

[[nodiscard]] constexpr DoubleDouble two_sum(double a, double b) {
  const double s = a + b;
  const double b_part = s - a;
  const double a_part = s - b_part;
  return {s, (a - a_part) + (b - b_part)};
}

[[nodiscard]] constexpr DoubleDouble two_product(double a, double b) {
  constexpr double splitter = 134217729;  // 2^27 + 1: halves of 26 bits
  const double ca = splitter * a;
  const double a_hi = ca - (ca - a);
  const double a_lo = a - a_hi;
  const double cb = splitter * b;
  const double b_hi = cb - (cb - b);
  const double b_lo = b - b_hi;
  const double p = a * b;
  return {p, ((a_hi * b_hi - p) + a_hi * b_lo + a_lo * b_hi) + a_lo * b_lo};
}

[[nodiscard]] constexpr DoubleDouble operator-(const DoubleDouble& a) {
  return {-a.hi, -a.lo};
}

[[nodiscard]] constexpr DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble s = two_sum(a.hi, b.hi);
  const DoubleDouble t = two_sum(a.lo, b.lo);
  const DoubleDouble r = fast_two_sum(s.hi, s.lo + t.hi);
  return fast_two_sum(r.hi, r.lo + t.lo);
}

[[nodiscard]] constexpr DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble p = two_product(a.hi, b.hi);
  return fast_two_sum(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}

[[nodiscard]] constexpr DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
  const double q = a.hi / b.hi;
  const DoubleDouble p = two_product(q, b.hi);
  const double rest = ((a.hi - p.hi) - p.lo) + (a.lo - q * b.lo);
  return fast_two_sum(q, rest / b.hi);
}

}  // namespace scenec
