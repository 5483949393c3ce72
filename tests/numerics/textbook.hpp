// The formulas of textbooks and of the course's ray casters, kept to be measured beside ours: the
// quadratic b^2 - 4ac, Moller-Trumbore, a plane with a fixed threshold. The Newton iteration for
// surfaces of revolution is part of the language (`solver = .newton`, revolve_newton.hpp).
#pragma once

#include "tests/numerics/wide.hpp"

namespace scenec::numerics::textbook {

// Both roots of |o + t d - c| = r by the school formula.
template <class T>
[[nodiscard]] bool sphere(const V3<T>& o, const V3<T>& d, const V3<T>& c, T r, T& t) {
  const V3<T> oc = o - c;
  const T a = dot(d, d);
  const T b = 2 * dot(oc, d);
  const T e = dot(oc, oc) - r * r;
  const T discriminant = b * b - 4 * a * e;
  if (!(discriminant >= 0)) return false;
  const T s = root(discriminant);
  const T near = (-b - s) / (2 * a);
  const T far = (-b + s) / (2 * a);
  t = near >= 0 ? near : far;
  return t >= 0;
}

inline constexpr double parallel_threshold = 1e-8;

template <class T>
[[nodiscard]] bool plane(const V3<T>& n, T offset, const V3<T>& o, const V3<T>& d, T& t) {
  const T slope = dot(n, d);
  if (magnitude(slope) < static_cast<T>(parallel_threshold)) return false;
  t = (offset - dot(n, o)) / slope;
  return t >= 0;
}

// Moller and Trumbore 1997, with the usual threshold on the determinant.
template <class T>
[[nodiscard]] bool triangle(const V3<T>& a, const V3<T>& b, const V3<T>& c, const V3<T>& o,
                            const V3<T>& d, T& t, double threshold = parallel_threshold) {
  const V3<T> e1 = b - a;
  const V3<T> e2 = c - a;
  const V3<T> p = cross(d, e2);
  const T determinant = dot(e1, p);
  if (magnitude(determinant) < static_cast<T>(threshold)) return false;
  const V3<T> s = o - a;
  const T u = dot(s, p) / determinant;
  if (u < 0 || u > 1) return false;
  const V3<T> q = cross(s, e1);
  const T v = dot(d, q) / determinant;
  if (v < 0 || u + v > 1) return false;
  t = dot(e2, q) / determinant;
  return t >= 0;
}

}  // namespace scenec::numerics::textbook
