// Counter-based random numbers: value = f(seed, pixel, sample, dimension). No state, so an image
// cannot depend on the order in which pixels, samples or decisions are worked on.
//
// Domain:     every 64-bit seed, pixel and sample, every 32-bit dimension.
// Method:     each coordinate is absorbed by one round of a 64-bit bijective mixer (Stafford's
//             variant 13 of the MurmurHash3 finaliser, multiplier constants of splitmix64).
// Error:      doubles are multiples of 2^-53 in [0, 1), each equally likely; 1 never comes.
// Degenerate: none; seed 0, pixel 0, sample 0, dimension 0 is as good as any.
// Proof:      tests/unit/backend/math/rng_test.cpp.
#pragma once

#include <cstdint>

namespace scenec::backend {

[[nodiscard]] constexpr std::uint64_t mix_bits(std::uint64_t v) {
  v = (v ^ (v >> 30)) * 0xbf58476d1ce4e5b9ULL;
  v = (v ^ (v >> 27)) * 0x94d049bb133111ebULL;
  return v ^ (v >> 31);
}

// The top 53 bits as a double in [0, 1).
[[nodiscard]] constexpr double unit_double(std::uint64_t bits) {
  return static_cast<double>(bits >> 11) * 0x1p-53;
}

// The numbers of one sample of one pixel, addressed by dimension.
class SampleRandom {
 public:
  constexpr SampleRandom(std::uint64_t seed, std::uint64_t pixel, std::uint64_t sample)
      : key_(absorb(absorb(absorb(0, seed), pixel), sample)) {}

  [[nodiscard]] constexpr std::uint64_t bits(std::uint32_t dimension) const {
    return absorb(key_, dimension);
  }
  [[nodiscard]] constexpr double unit(std::uint32_t dimension) const {
    return unit_double(bits(dimension));
  }

 private:
  // Injective in `value` for a fixed key; the odd constant keeps (0, 0) from being a fixed point.
  [[nodiscard]] static constexpr std::uint64_t absorb(std::uint64_t key, std::uint64_t value) {
    return mix_bits(mix_bits(value + 0x9e3779b97f4a7c15ULL) ^
                    (key * 0xd1342543de82ef95ULL + 0x2545f4914f6cdd1dULL));
  }
  std::uint64_t key_;
};

[[nodiscard]] constexpr double random_unit(std::uint64_t seed, std::uint64_t pixel,
                                           std::uint64_t sample, std::uint32_t dimension) {
  return SampleRandom(seed, pixel, sample).unit(dimension);
}

}  // namespace scenec::backend
