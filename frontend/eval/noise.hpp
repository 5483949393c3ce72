// The pure random functions of the language: the same value for the same arguments on every
// machine.
#pragma once

#include <array>
#include <cstdint>

namespace scenec::frontend {

// Mixes `value` into `state`; every bit of the result depends on every bit of both.
[[nodiscard]] std::uint64_t mixed_bits(std::uint64_t state, std::uint64_t value);
// The upper 53 bits as a number in [0, 1).
[[nodiscard]] double unit_interval(std::uint64_t bits);
// Gradient noise in [-1, 1], zero at points with whole coordinates.
// Method: Perlin, "Improving Noise", SIGGRAPH 2002, with hashed gradients in place of the table.
[[nodiscard]] double gradient_noise(const std::array<double, 3>& p);

}  // namespace scenec::frontend
