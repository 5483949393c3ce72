// One fixed slot of the sampler for every decision of a path. A decision that is not needed leaves
// its slot unused, so that leaving an effect out never changes the numbers of another one.
#pragma once

#include <cstdint>

namespace scenec::backend {

// Two-dimensional decisions take their slot and the next one.
namespace dimension {
inline constexpr std::uint32_t pixel_filter = 0;  // 2
inline constexpr std::uint32_t lens = 2;          // 2

// Per bounce, as offsets to `bounce(depth)`.
inline constexpr std::uint32_t direction = 0;     // 2
inline constexpr std::uint32_t light_point = 2;   // 2
inline constexpr std::uint32_t light_choice = 4;  // 1
inline constexpr std::uint32_t lobe = 5;          // 1
inline constexpr std::uint32_t roulette = 6;      // 1
inline constexpr std::uint32_t material_mix = 7;  // 1
inline constexpr std::uint32_t opacity = 8;       // keyed further by the surface hit
inline constexpr std::uint32_t caster = 9;        // 1
inline constexpr std::uint32_t per_bounce = 10;

[[nodiscard]] constexpr std::uint32_t bounce(std::uint32_t depth) {
  return 4 + depth * per_bounce;
}
}  // namespace dimension

}  // namespace scenec::backend
