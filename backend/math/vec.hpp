// Points, vectors, normals and unit vectors of three doubles. They are four types because they
// transform differently and because "already unit" is worth knowing: a UnitVector3 is a Vector3,
// never the other way round without `normalized`.
#pragma once

#include <cmath>
#include <limits>

namespace scenec::backend {

// The unit round-off of double, and the usual bound (1 + u)^n - 1 <= gamma(n) of n roundings.
inline constexpr double unit_roundoff = std::numeric_limits<double>::epsilon() / 2;
[[nodiscard]] constexpr double gamma(int n) {
  return n * unit_roundoff / (1 - n * unit_roundoff);
}

struct Vector3 {
  double x = 0;
  double y = 0;
  double z = 0;
  friend constexpr bool operator==(const Vector3&, const Vector3&) = default;
};

struct Point3 {
  double x = 0;
  double y = 0;
  double z = 0;
  friend constexpr bool operator==(const Point3&, const Point3&) = default;
};

// A covector: what a transform maps by the transpose of its inverse. Not necessarily unit.
struct Normal3 {
  double x = 0;
  double y = 0;
  double z = 0;
  friend constexpr bool operator==(const Normal3&, const Normal3&) = default;
};

// Length 1 to 2 ulp. Made by `normalized`, or by `assume_unit` where the maths says so.
class UnitVector3 {
 public:
  constexpr UnitVector3() = default;  // +z
  [[nodiscard]] static constexpr UnitVector3 assume_unit(const Vector3& v) {
    return UnitVector3(v);
  }

  [[nodiscard]] constexpr double x() const { return v_.x; }
  [[nodiscard]] constexpr double y() const { return v_.y; }
  [[nodiscard]] constexpr double z() const { return v_.z; }
  [[nodiscard]] constexpr const Vector3& vector() const { return v_; }
  // NOLINTNEXTLINE(google-explicit-constructor): a unit vector is a vector
  constexpr operator const Vector3&() const { return v_; }
  [[nodiscard]] constexpr UnitVector3 operator-() const {
    return UnitVector3({-v_.x, -v_.y, -v_.z});
  }
  friend constexpr bool operator==(const UnitVector3&, const UnitVector3&) = default;

 private:
  constexpr explicit UnitVector3(const Vector3& v) : v_(v) {}
  Vector3 v_{0, 0, 1};
};

constexpr Vector3 operator+(const Vector3& a, const Vector3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
constexpr Vector3 operator-(const Vector3& a, const Vector3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
constexpr Vector3 operator-(const Vector3& a) {
  return {-a.x, -a.y, -a.z};
}
constexpr Vector3 operator*(const Vector3& a, double s) {
  return {a.x * s, a.y * s, a.z * s};
}
constexpr Vector3 operator*(double s, const Vector3& a) {
  return {a.x * s, a.y * s, a.z * s};
}
constexpr Vector3 operator/(const Vector3& a, double s) {
  return {a.x / s, a.y / s, a.z / s};
}
constexpr Vector3& operator+=(Vector3& a, const Vector3& b) {
  return a = a + b;
}
constexpr Point3 operator+(const Point3& p, const Vector3& v) {
  return {p.x + v.x, p.y + v.y, p.z + v.z};
}
constexpr Point3 operator-(const Point3& p, const Vector3& v) {
  return {p.x - v.x, p.y - v.y, p.z - v.z};
}
constexpr Vector3 operator-(const Point3& a, const Point3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
constexpr Normal3 operator-(const Normal3& a) {
  return {-a.x, -a.y, -a.z};
}

[[nodiscard]] constexpr double dot(const Vector3& a, const Vector3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
// a*b - c*d of products that nearly cancel loses relative accuracy; callers that need more use
// robust forms. Exactly antisymmetric: cross(a, b) == -cross(b, a).
[[nodiscard]] constexpr Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
[[nodiscard]] constexpr double length_squared(const Vector3& a) {
  return dot(a, a);
}

[[nodiscard]] constexpr Vector3 as_vector(const Point3& p) {
  return {p.x, p.y, p.z};
}
[[nodiscard]] constexpr Vector3 as_vector(const Normal3& n) {
  return {n.x, n.y, n.z};
}
[[nodiscard]] constexpr Point3 as_point(const Vector3& v) {
  return {v.x, v.y, v.z};
}
[[nodiscard]] constexpr Normal3 as_normal(const Vector3& v) {
  return {v.x, v.y, v.z};
}

[[nodiscard]] inline Vector3 abs(const Vector3& a) {
  return {std::fabs(a.x), std::fabs(a.y), std::fabs(a.z)};
}
// The larger of two numbers; with a NaN, the second. std::fmax is a call into libm.
[[nodiscard]] constexpr double larger(double a, double b) {
  return a > b ? a : b;
}
[[nodiscard]] constexpr double smaller(double a, double b) {
  return a < b ? a : b;
}
[[nodiscard]] inline double max_abs(const Vector3& a) {
  return larger(std::fabs(a.x), larger(std::fabs(a.y), std::fabs(a.z)));
}
[[nodiscard]] constexpr double component(const Vector3& a, int axis) {
  return axis == 0 ? a.x : axis == 1 ? a.y : a.z;
}
[[nodiscard]] constexpr double component(const Point3& a, int axis) {
  return axis == 0 ? a.x : axis == 1 ? a.y : a.z;
}
constexpr void set_component(Vector3& a, int axis, double value) {
  (axis == 0 ? a.x : axis == 1 ? a.y : a.z) = value;
}
constexpr void set_component(Point3& a, int axis, double value) {
  (axis == 0 ? a.x : axis == 1 ? a.y : a.z) = value;
}

[[nodiscard]] inline bool is_finite(const Vector3& a) {
  // One test for three: any inf or NaN makes the sum of a - a differ from 0.
  return (a.x - a.x) + (a.y - a.y) + (a.z - a.z) == 0;
}
[[nodiscard]] inline bool is_finite(const Point3& a) {
  return is_finite(as_vector(a));
}

// A power of two s such that the squares of a * s neither overflow nor lose bits to underflow.
// 1 for ordinary vectors; scaling by it is exact.
[[nodiscard]] inline double safe_scale(const Vector3& a) {
  const double m = max_abs(a);
  // The squares of [2^-400, 2^400] stay far inside the normal range.
  if ((m >= 0x1p-400 && m <= 0x1p400) || !(m > 0) || std::isinf(m)) return 1;
  // Subnormal input needs two steps; 2^600 reaches it and is enough for the squares.
  return m < 1 ? 0x1p600 : 0x1p-600;
}

[[nodiscard]] inline double length(const Vector3& a) {
  const double s = safe_scale(a);
  if (s == 1) return std::sqrt(dot(a, a));
  const Vector3 b = a * s;
  return std::sqrt(dot(b, b)) / s;
}
[[nodiscard]] inline double distance(const Point3& a, const Point3& b) {
  return length(a - b);
}

// The direction of `a`; the zero vector (and NaN) gives `fallback`.
[[nodiscard]] inline UnitVector3 normalized(const Vector3& a, const UnitVector3& fallback = {}) {
  const Vector3 b = a * safe_scale(a);
  const double l = std::sqrt(dot(b, b));
  if (!(l > 0) || std::isinf(l)) return fallback;
  return UnitVector3::assume_unit(b / l);
}
[[nodiscard]] inline UnitVector3 normalized(const Normal3& n, const UnitVector3& fallback = {}) {
  return normalized(as_vector(n), fallback);
}

[[nodiscard]] constexpr Point3 lerp(double t, const Point3& a, const Point3& b) {
  return {(1 - t) * a.x + t * b.x, (1 - t) * a.y + t * b.y, (1 - t) * a.z + t * b.z};
}

}  // namespace scenec::backend
