#include "backend/math/transform.hpp"

#include <cmath>
#include <cstddef>

namespace scenec::backend {
namespace {

using Matrix3 = std::array<std::array<double, 3>, 3>;

double determinant_of(const Matrix3& m) {
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

Matrix3 linear_part(const AffineRows& rows) {
  Matrix3 m{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) m[i][j] = rows[i][j];
  return m;
}

Matrix3 product(const Matrix3& a, const Matrix3& b) {
  Matrix3 c{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      c[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j];
  return c;
}

Matrix3 adjugate_inverse(const Matrix3& m, double determinant) {
  Matrix3 r{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t a = (j + 1) % 3;
      const std::size_t b = (j + 2) % 3;
      const std::size_t c = (i + 1) % 3;
      const std::size_t d = (i + 2) % 3;
      r[i][j] = (m[a][c] * m[b][d] - m[a][d] * m[b][c]) / determinant;
    }
  }
  return r;
}

// X (2I - M X): squares the relative residual of an approximate inverse.
Matrix3 newton_step(const Matrix3& m, const Matrix3& x) {
  Matrix3 residual = product(m, x);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) residual[i][j] = (i == j ? 1.0 : 0.0) - residual[i][j];
  const Matrix3 correction = product(x, residual);
  Matrix3 r = x;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) r[i][j] += correction[i][j];
  return r;
}

// The power of two just above |v|, so that dividing by it is exact; 0 for 0.
int exponent_of(double v) {
  int exponent = 0;
  std::frexp(v, &exponent);
  return exponent;
}

double row_norm(const AffineRows& m) {
  double norm = 0;
  for (const auto& row : m)
    norm = std::fmax(norm, std::fabs(row[0]) + std::fabs(row[1]) + std::fabs(row[2]));
  return norm;
}

bool all_finite(const AffineRows& rows) {
  for (const auto& row : rows)
    for (const double v : row)
      if (!std::isfinite(v)) return false;
  return true;
}

}  // namespace

std::optional<Transform> Transform::from_rows(const AffineRows& rows) {
  if (!all_finite(rows)) return std::nullopt;
  // Rows are scaled to largest entries in [0.5, 1): exact, and the determinant cannot under- or
  // overflow for matrices that merely scale much.
  Matrix3 m = linear_part(rows);
  std::array<int, 3> shift{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double largest = max_abs({m[i][0], m[i][1], m[i][2]});
    if (largest == 0) return std::nullopt;
    shift[i] = exponent_of(largest);
    for (double& v : m[i]) v = std::ldexp(v, -shift[i]);
  }
  const double determinant = determinant_of(m);
  if (!(determinant != 0)) return std::nullopt;
  const Matrix3 inverse = newton_step(m, adjugate_inverse(m, determinant));
  AffineRows backward{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) backward[i][j] = std::ldexp(inverse[i][j], -shift[j]);
    backward[i][3] =
        -(backward[i][0] * rows[0][3] + backward[i][1] * rows[1][3] + backward[i][2] * rows[2][3]);
  }
  if (!all_finite(backward)) return std::nullopt;
  return Transform(rows, backward);
}

std::optional<Transform> Transform::from_matrix(const std::array<double, 16>& rows) {
  if (rows[12] != 0 || rows[13] != 0 || rows[14] != 0 || rows[15] != 1) return std::nullopt;
  AffineRows affine{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 4; ++j) affine[i][j] = rows[4 * i + j];
  return from_rows(affine);
}

Transform Transform::translation(const Vector3& v) {
  return Transform({{{1, 0, 0, v.x}, {0, 1, 0, v.y}, {0, 0, 1, v.z}}},
                   {{{1, 0, 0, -v.x}, {0, 1, 0, -v.y}, {0, 0, 1, -v.z}}});
}

Transform Transform::scaling(const Vector3& s) {
  return Transform({{{s.x, 0, 0, 0}, {0, s.y, 0, 0}, {0, 0, s.z, 0}}},
                   {{{1 / s.x, 0, 0, 0}, {0, 1 / s.y, 0, 0}, {0, 0, 1 / s.z, 0}}});
}

bool Transform::is_identity() const {
  return forward_ == Transform().forward_;
}

double Transform::determinant() const {
  return determinant_of(linear_part(forward_));
}

double Transform::condition() const {
  return row_norm(forward_) * row_norm(backward_);
}

Bounds3 Transform::apply(const Bounds3& b) const {
  if (b.empty()) return b;
  if (is_identity()) return b;
  Bounds3 out;
  for (int corner = 0; corner < 8; ++corner) {
    const Point3 p{(corner & 1) != 0 ? b.max.x : b.min.x, (corner & 2) != 0 ? b.max.y : b.min.y,
                   (corner & 4) != 0 ? b.max.z : b.min.z};
    out.grow(outward({apply(p), apply(p)}, round_trip_error(p)));
  }
  return out;
}

Vector3 Transform::absolute(const AffineRows& m, const Vector3& v) {
  const Vector3 a = abs(v);
  const auto row = [&](std::size_t i) {
    return std::fabs(m[i][0]) * a.x + std::fabs(m[i][1]) * a.y + std::fabs(m[i][2]) * a.z;
  };
  return {row(0), row(1), row(2)};
}

Vector3 Transform::round_trip_error(const Point3& p) const {
  if (is_identity()) return {};
  const Vector3 forward =
      absolute(forward_, as_vector(p)) +
      Vector3{std::fabs(forward_[0][3]), std::fabs(forward_[1][3]), std::fabs(forward_[2][3])};
  const Vector3 back =
      absolute(backward_, forward) +
      Vector3{std::fabs(backward_[0][3]), std::fabs(backward_[1][3]), std::fabs(backward_[2][3])};
  return gamma(4) * forward + gamma(16) * absolute(forward_, back);
}

Transform operator*(const Transform& outer, const Transform& inner) {
  const auto multiply = [](const AffineRows& a, const AffineRows& b) {
    AffineRows c{};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 4; ++j) {
        c[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j];
        if (j == 3) c[i][j] += a[i][3];
      }
    }
    return c;
  };
  const AffineRows forward = multiply(outer.forward_, inner.forward_);
  // A fresh inverse is nearer to the product than the product of the inverses.
  if (const auto fresh = Transform::from_rows(forward)) return *fresh;
  return Transform(forward, multiply(inner.backward_, outer.backward_));
}

}  // namespace scenec::backend
