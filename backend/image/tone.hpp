// Between linear light and 8-bit samples: the sRGB curve (IEC 61966-2-1, exact piecewise form) and
// the course's linear bytes. Tables are built by the compiler; run time only compares and loads,
// so every CPU gives the same bytes.
//
// Numerics.
// Domain: any double, NaN and infinities too. Method: encoding searches the 255 linear values at
// which the rounded sRGB byte changes; x^2.4 is x^2 times the fifth root of x^2 by
// Newton's iteration in long double. Error: a byte differs from exact rounding only for inputs
// within one ulp of a threshold; decoded values within one ulp. Degenerate: NaN and values below 0
// give 0, values above 1 give 255. Proof: tone_test (against powl, all thresholds and bytes).
#pragma once

#include <cstdint>

namespace scenec::backend {

// The byte nearest to 255 times the sRGB encoding of `linear`.
[[nodiscard]] std::uint8_t srgb8_of(double linear);
// int(255 * c) in single precision after clamping to [0, 1]: what the course's programs write.
[[nodiscard]] std::uint8_t course8_of(float linear);
// The linear value of an sRGB byte (table) or of an sRGB value in [0, 1] (clamped).
[[nodiscard]] double linear_of_srgb8(std::uint8_t encoded);
[[nodiscard]] double linear_of_srgb(double encoded);

}  // namespace scenec::backend
