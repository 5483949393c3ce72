// Vectors of any scalar, and quadruple precision for the oracles: what double kernels are judged
// by. Needs a compiler with __float128 (x86-64).
#pragma once

#include <quadmath.h>

#include <cmath>
#include <limits>

#include "backend/geometry/kernel.hpp"

namespace scenec::numerics {

__extension__ typedef __float128 Wide;

[[nodiscard]] inline float root(float v) {
  return std::sqrt(v);
}
[[nodiscard]] inline double root(double v) {
  return std::sqrt(v);
}
[[nodiscard]] inline long double root(long double v) {
  return std::sqrt(v);
}
[[nodiscard]] inline Wide root(Wide v) {
  return sqrtq(v);
}
template <class T>
[[nodiscard]] T magnitude(T v) {
  return v < 0 ? -v : v;
}

template <class T>
struct V3 {
  T x{};
  T y{};
  T z{};
};
template <class T>
V3<T> operator+(const V3<T>& a, const V3<T>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
V3<T> operator-(const V3<T>& a, const V3<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
V3<T> operator*(T s, const V3<T>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class T>
[[nodiscard]] T dot(const V3<T>& a, const V3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
[[nodiscard]] V3<T> cross(const V3<T>& a, const V3<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
[[nodiscard]] T length(const V3<T>& a) {
  return root(dot(a, a));
}

// The components in another scalar; from double to float they are rounded.
template <class T, class V>
[[nodiscard]] V3<T> as(const V& v) {
  return {static_cast<T>(v.x), static_cast<T>(v.y), static_cast<T>(v.z)};
}
template <class T>
[[nodiscard]] V3<T> as(const backend::UnitVector3& v) {
  return as<T>(v.vector());
}

[[nodiscard]] inline double ulp_of(double v) {
  const double a = std::fabs(v);
  return std::nextafter(a, std::numeric_limits<double>::infinity()) - a;
}
// How many ulps of the true value `got` is off.
[[nodiscard]] inline double ulps(double got, Wide want) {
  return static_cast<double>(magnitude(static_cast<Wide>(got) - want)) /
         ulp_of(static_cast<double>(want));
}

}  // namespace scenec::numerics
