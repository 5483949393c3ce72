// Sums of doubles that do not depend on the order of the terms: 128-bit fixed point.
//
// Domain:     finite terms.
// Method:     each term is rounded towards zero to a multiple of 2^-64 and added as an integer.
// Error:      2^-64 a term; nothing is lost in the addition.
// Degenerate: terms beyond 2^42 in magnitude are saturated there (and reported), so that 2^20 of
//             them cannot overflow.
// Proof:      tests/unit/backend/film/film_test.cpp.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace scenec::backend {

__extension__ using Int128 = __int128;

class FixedSum {
 public:
  static constexpr double largest_term = 0x1p42;

  // False when the term was saturated. Precondition: `term` is finite.
  bool add(double term) {
    const bool fits = std::fabs(term) <= largest_term;
    value_ += fixed_of(fits ? term : std::copysign(largest_term, term));
    return fits;
  }
  FixedSum& operator+=(const FixedSum& other) {
    value_ += other.value_;
    return *this;
  }
  friend bool operator==(const FixedSum&, const FixedSum&) = default;

  // The nearest double or its neighbour: two exact parts, one rounded addition.
  [[nodiscard]] double value() const {
    const bool negative = value_ < 0;
    const Int128 magnitude = negative ? -value_ : value_;
    const double high = static_cast<double>(static_cast<std::uint64_t>(magnitude >> 64));
    const double low = static_cast<double>(static_cast<std::uint64_t>(magnitude)) * 0x1p-64;
    return negative ? -(high + low) : high + low;
  }

 private:
  [[nodiscard]] static Int128 fixed_of(double term) {
    const auto bits = std::bit_cast<std::uint64_t>(term);
    const int exponent = static_cast<int>((bits >> 52) & 0x7ff);
    if (exponent == 0) return 0;  // zero and subnormals are far below 2^-64
    const auto mantissa = static_cast<Int128>((bits & 0xfffffffffffffULL) | 0x10000000000000ULL);
    // term = mantissa * 2^(exponent - 1075); in units of 2^-64 the shift is exponent - 1011.
    const int shift = exponent - 1011;
    if (shift <= -53) return 0;
    const Int128 magnitude = shift >= 0 ? mantissa << shift : mantissa >> -shift;
    return (bits >> 63) != 0 ? -magnitude : magnitude;
  }
  Int128 value_ = 0;
};

}  // namespace scenec::backend
