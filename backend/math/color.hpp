// Linear RGB (Rec. 709 primaries) in double: radiance, reflectance, throughput.
#pragma once

#include <cmath>

namespace scenec::backend {

struct Rgb {
  double r = 0;
  double g = 0;
  double b = 0;

  constexpr Rgb() = default;
  constexpr Rgb(double red, double green, double blue) : r(red), g(green), b(blue) {}
  [[nodiscard]] static constexpr Rgb gray(double value) { return {value, value, value}; }
  friend constexpr bool operator==(const Rgb&, const Rgb&) = default;

  constexpr Rgb& operator+=(const Rgb& o) { return *this = Rgb(r + o.r, g + o.g, b + o.b); }
  constexpr Rgb& operator*=(const Rgb& o) { return *this = Rgb(r * o.r, g * o.g, b * o.b); }
  constexpr Rgb& operator*=(double s) { return *this = Rgb(r * s, g * s, b * s); }
};

constexpr Rgb operator+(Rgb a, const Rgb& b) {
  return a += b;
}
constexpr Rgb operator-(const Rgb& a, const Rgb& b) {
  return {a.r - b.r, a.g - b.g, a.b - b.b};
}
constexpr Rgb operator*(Rgb a, const Rgb& b) {
  return a *= b;
}
constexpr Rgb operator*(Rgb a, double s) {
  return a *= s;
}
constexpr Rgb operator*(double s, Rgb a) {
  return a *= s;
}
constexpr Rgb operator/(const Rgb& a, double s) {
  return {a.r / s, a.g / s, a.b / s};
}

[[nodiscard]] constexpr double luminance(const Rgb& c) {
  return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;
}
[[nodiscard]] constexpr double max_component(const Rgb& c) {
  const double m = c.r > c.g ? c.r : c.g;
  return m > c.b ? m : c.b;
}
[[nodiscard]] constexpr bool is_black(const Rgb& c) {
  return c.r == 0 && c.g == 0 && c.b == 0;
}
[[nodiscard]] inline bool is_finite(const Rgb& c) {
  return std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b);
}

}  // namespace scenec::backend
