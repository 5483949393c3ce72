#include "backend/image/tone.hpp"

#include <array>
#include <cstddef>

namespace scenec::backend {
namespace {

// Newton's iteration for r^5 = a, a in (0, 1]: from above it falls monotonically, so the first
// step that does not fall is the end.
constexpr long double fifth_root(long double a) {
  long double root = 1;
  while (true) {
    const long double square = root * root;
    const long double next = (4 * root + a / (square * square)) / 5;
    if (!(next < root)) return root;
    root = next;
  }
}

constexpr double decoded(long double encoded) {
  if (encoded <= 0.04045L) return static_cast<double>(encoded / 12.92L);
  const long double base = (encoded + 0.055L) / 1.055L;
  const long double square = base * base;
  return static_cast<double>(square * fifth_root(square));
}

constexpr std::array<double, 256> make_decode_table() {
  std::array<double, 256> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    table[i] = decoded(static_cast<long double>(i) / 255);
  }
  return table;
}

// thresholds[k]: from here on the byte is k + 1.
constexpr std::array<double, 255> make_thresholds() {
  std::array<double, 255> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    table[i] = decoded((2 * static_cast<long double>(i) + 1) / 510);
  }
  return table;
}

constexpr std::array<double, 256> decode_table = make_decode_table();
constexpr std::array<double, 255> thresholds = make_thresholds();

}  // namespace

std::uint8_t srgb8_of(double linear) {
  // 255 = 128 + 64 + ... + 1: eight halvings without a branch on the data. NaN fails them all.
  std::size_t below = 0;
  for (std::size_t step = 128; step != 0; step /= 2) {
    below += linear >= thresholds[below + step - 1] ? step : 0;
  }
  return static_cast<std::uint8_t>(below);
}

std::uint8_t course8_of(float linear) {
  if (!(linear > 0)) return 0;
  if (linear >= 1) return 255;
  return static_cast<std::uint8_t>(linear * 255.0f);
}

double linear_of_srgb8(std::uint8_t encoded) {
  return decode_table[encoded];
}

double linear_of_srgb(double encoded) {
  if (!(encoded > 0)) return 0;
  return encoded >= 1 ? 1 : decoded(encoded);
}

}  // namespace scenec::backend
