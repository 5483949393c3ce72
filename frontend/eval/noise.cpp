#include "frontend/eval/noise.hpp"

#include <algorithm>
#include <cmath>

namespace scenec::frontend {

std::uint64_t mixed_bits(std::uint64_t state, std::uint64_t value) {
  // SplitMix64: Steele, Lea and Flood, "Fast Splittable Pseudorandom Number Generators", 2014.
  std::uint64_t z = state + value * 0x9E3779B97F4A7C15u + 0x9E3779B97F4A7C15u;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return z ^ (z >> 31);
}

double unit_interval(std::uint64_t bits) {
  return static_cast<double>(bits >> 11) * 0x1p-53;
}

namespace {

double faded(double t) {
  return t * t * t * (t * (t * 6 - 15) + 10);
}
double blended(double t, double a, double b) {
  return a + t * (b - a);
}

// The twelve edge directions of a cube (four of them twice).
double gradient(std::uint64_t hash, double x, double y, double z) {
  const std::uint64_t h = hash & 15;
  const double u = h < 8 ? x : y;
  const double v = h < 4 ? y : (h == 12 || h == 14) ? x : z;
  return ((h & 1) != 0 ? -u : u) + ((h & 2) != 0 ? -v : v);
}

}  // namespace

double gradient_noise(const std::array<double, 3>& p) {
  std::array<double, 3> fraction{};
  std::array<std::uint64_t, 3> cell{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double whole = std::floor(p[i]);
    fraction[i] = p[i] - whole;
    // Beyond 2^62 every coordinate is whole and the noise is zero anyway.
    cell[i] =
        static_cast<std::uint64_t>(static_cast<std::int64_t>(std::clamp(whole, -0x1p62, 0x1p62)));
  }
  const auto corner = [&](std::uint64_t dx, std::uint64_t dy, std::uint64_t dz) {
    const std::uint64_t hash =
        mixed_bits(mixed_bits(mixed_bits(0, cell[0] + dx), cell[1] + dy), cell[2] + dz) >> 32;
    return gradient(hash, fraction[0] - static_cast<double>(dx),
                    fraction[1] - static_cast<double>(dy), fraction[2] - static_cast<double>(dz));
  };
  const double u = faded(fraction[0]), v = faded(fraction[1]), w = faded(fraction[2]);
  const auto layer = [&](std::uint64_t dz) {
    return blended(v, blended(u, corner(0, 0, dz), corner(1, 0, dz)),
                   blended(u, corner(0, 1, dz), corner(1, 1, dz)));
  };
  return std::clamp(blended(w, layer(0), layer(1)), -1.0, 1.0);
}

}  // namespace scenec::frontend
