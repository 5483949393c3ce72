// The numbers of one sample of one pixel: value = f(seed, pixel, sample, dimension), either
// independent random numbers or Owen-scrambled Sobol points.
//
// Domain:     pixel and seed any 64 bits; sample below 2^32; any dimension.
// Method:     Sobol: pairs of dimensions are padded: each pair takes the first two Sobol dimensions
//             with its own Owen scramble of the order of samples and of each coordinate (Burley
//             2020, "Practical Hash-based Owen Scrambling", with Vegdahl's constants for the
//             Laine-Karras permutation). Every prefix of 2^k samples of a pair is a (0, k, 2)-net.
//             One mixer a decision gives all three scrambles; numbers are handled with their bits
//             reversed, as the permutation wants them, and turned round once at the end.
// Error:      multiples of 2^-53 in [0, 1): 32 bits of the net, the rest random; 1 never comes.
// Degenerate: none.
// Proof:      tests/unit/backend/samplers/sampler_test.cpp.
#pragma once

#include <array>
#include <cstdint>

#include "backend/math/rng.hpp"
#include "backend/math/sampling.hpp"
#include "ir/render_settings.hpp"

namespace scenec::backend {

[[nodiscard]] constexpr std::uint32_t reversed_bits(std::uint32_t v) {
  v = ((v >> 1) & 0x55555555U) | ((v & 0x55555555U) << 1);
  v = ((v >> 2) & 0x33333333U) | ((v & 0x33333333U) << 2);
  v = ((v >> 4) & 0x0f0f0f0fU) | ((v & 0x0f0f0f0fU) << 4);
  return __builtin_bswap32(v);
}

// A permutation in which bit k of the result depends on bits 0..k of the argument only: an Owen
// scramble of a number whose bits are reversed.
[[nodiscard]] constexpr std::uint32_t owen_permutation(std::uint32_t reversed, std::uint32_t seed) {
  std::uint32_t x = reversed;
  x ^= x * 0x3d20adeaU;
  x += seed;
  x *= (seed >> 16) | 1U;
  x ^= x * 0x05526c56U;
  x ^= x * 0x53a22864U;
  return x;
}

namespace sobol_detail {
// The second Sobol dimension (primitive polynomial x + 1) of each byte of the index, bits reversed.
[[nodiscard]] constexpr std::array<std::array<std::uint32_t, 256>, 4> second_dimension() {
  std::array<std::array<std::uint32_t, 256>, 4> table{};
  std::array<std::uint32_t, 32> direction{};
  std::uint32_t v = 0x80000000U;
  for (std::size_t bit = 0; bit < 32; ++bit, v ^= v >> 1) direction[bit] = v;
  for (std::size_t byte = 0; byte < 4; ++byte) {
    for (std::size_t value = 0; value < 256; ++value) {
      for (std::size_t bit = 0; bit < 8; ++bit) {
        if (((value >> bit) & 1U) != 0)
          table[byte][value] ^= reversed_bits(direction[8 * byte + bit]);
      }
    }
  }
  return table;
}
inline constexpr std::array<std::array<std::uint32_t, 256>, 4> second = second_dimension();
}  // namespace sobol_detail

// Bits reversed.
[[nodiscard]] constexpr std::uint32_t sobol_second(std::uint32_t index) {
  const auto& table = sobol_detail::second;
  return table[0][index & 255U] ^ table[1][(index >> 8) & 255U] ^ table[2][(index >> 16) & 255U] ^
         table[3][index >> 24];
}

class Sampler {
 public:
  Sampler(ir::SamplerKind kind, std::uint64_t seed, std::uint64_t pixel, std::uint64_t sample)
      : independent_(kind == ir::SamplerKind::independent),
        reversed_index_(reversed_bits(static_cast<std::uint32_t>(sample))),
        pixel_key_(SampleRandom(seed, pixel, ~std::uint64_t{0}).bits(0)),
        sample_random_(seed, pixel, sample) {}

  [[nodiscard]] double get_1d(std::uint32_t dimension) const {
    if (independent_) return sample_random_.unit(dimension);
    const std::uint64_t key = key_of(dimension);
    // The first Sobol coordinate is the bit-reversed index: with its bits reversed, the index.
    const std::uint32_t index =
        reversed_bits(owen_permutation(reversed_index_, static_cast<std::uint32_t>(key)));
    return scrambled(index, static_cast<std::uint32_t>(key >> 32), key);
  }
  [[nodiscard]] Sample2 get_2d(std::uint32_t dimension) const {
    if (independent_) {
      return {sample_random_.unit(dimension), sample_random_.unit(dimension + 1)};
    }
    const std::uint64_t key = key_of(dimension);
    const std::uint64_t more = key * 0xd1342543de82ef95ULL;
    const std::uint32_t index =
        reversed_bits(owen_permutation(reversed_index_, static_cast<std::uint32_t>(key)));
    return {scrambled(index, static_cast<std::uint32_t>(key >> 32), key),
            scrambled(sobol_second(index), static_cast<std::uint32_t>(more >> 32), more)};
  }
  // A random number of its own for decisions of unknown number, told apart by `what`.
  [[nodiscard]] double random(std::uint32_t dimension, std::uint64_t what) const {
    return unit_double(mix_bits(sample_random_.bits(dimension) ^ mix_bits(what)));
  }

 private:
  [[nodiscard]] std::uint64_t key_of(std::uint32_t dimension) const {
    return mix_bits(pixel_key_ + dimension * 0x9e3779b97f4a7c15ULL);
  }
  // `value_reversed`: the coordinate's bits in reverse order.
  [[nodiscard]] static double scrambled(std::uint32_t value_reversed, std::uint32_t seed,
                                        std::uint64_t key) {
    const std::uint32_t value = reversed_bits(owen_permutation(value_reversed, seed));
    // Bits below the net's resolution are random; they must differ between samples.
    const std::uint64_t low = ((key ^ value) * 0x9e3779b97f4a7c15ULL) >> 43;
    return static_cast<double>((static_cast<std::uint64_t>(value) << 21) | low) * 0x1p-53;
  }

  bool independent_;
  std::uint32_t reversed_index_;
  std::uint64_t pixel_key_;
  SampleRandom sample_random_;
};

}  // namespace scenec::backend
