// Colours as authors give them: sRGB-encoded values and temperatures, turned into linear Rec. 709.
#pragma once

#include "ir/values.hpp"

namespace scenec::frontend {

// Decodes one sRGB component (IEC 61966-2-1); 0 and 1 are exact.
[[nodiscard]] double srgb_decoded(double encoded);
// The colour of a black body, luminance 1. Components that lie outside the gamut are cut at 0.
// Precondition: temperature in [blackbody_coldest, blackbody_hottest].
[[nodiscard]] ir::Color blackbody(double kelvin);
inline constexpr double blackbody_coldest = 500;
inline constexpr double blackbody_hottest = 100'000;

}  // namespace scenec::frontend
