// Affine maps with their inverse. Named target-from-source where used: `world_from_object`.
//
// Domain:     finite 3x4 matrices with non-zero determinant.
// Method:     inverse by adjugate of the power-of-two equilibrated matrix, one Newton step.
// Error:      the round trip inverse(apply(p)) differs from p by at most
//             gamma(16) |M^-1| (|M| |p| + |t|), which `round_trip_error` returns.
// Degenerate: `from_rows` refuses singular and non-finite matrices.
// Proof:      tests/unit/backend/math/transform_test.cpp.
#pragma once

#include <array>
#include <optional>

#include "backend/math/bounds.hpp"
#include "backend/math/vec.hpp"

namespace scenec::backend {

// Rows of the linear part with the translation as fourth column.
using AffineRows = std::array<std::array<double, 4>, 3>;

class Transform {
 public:
  Transform() = default;  // the identity

  [[nodiscard]] static std::optional<Transform> from_rows(const AffineRows& rows);
  // Sixteen numbers, row-major; the last row must be 0 0 0 1.
  [[nodiscard]] static std::optional<Transform> from_matrix(const std::array<double, 16>& rows);
  [[nodiscard]] static Transform translation(const Vector3& v);
  // No factor may be 0.
  [[nodiscard]] static Transform scaling(const Vector3& s);

  [[nodiscard]] const AffineRows& rows() const { return forward_; }
  [[nodiscard]] const AffineRows& inverse_rows() const { return backward_; }
  [[nodiscard]] Transform inverse() const { return Transform(backward_, forward_); }
  [[nodiscard]] bool is_identity() const;
  [[nodiscard]] double determinant() const;
  // ||M|| ||M^-1|| of the linear part in the maximum row sum norm; 1 at best.
  [[nodiscard]] double condition() const;
  // True when it mirrors (the determinant is negative).
  [[nodiscard]] bool flips() const { return determinant() < 0; }

  [[nodiscard]] Point3 apply(const Point3& p) const { return point(forward_, p); }
  [[nodiscard]] Vector3 apply(const Vector3& v) const { return vector(forward_, v); }
  // The covector of a surface: not unit even if `n` is; its side of the surface is kept.
  [[nodiscard]] Normal3 apply(const Normal3& n) const { return normal(backward_, n); }
  [[nodiscard]] Bounds3 apply(const Bounds3& b) const;

  [[nodiscard]] Point3 apply_inverse(const Point3& p) const { return point(backward_, p); }
  [[nodiscard]] Vector3 apply_inverse(const Vector3& v) const { return vector(backward_, v); }

  // |M| e: what a box of errors of a source point becomes, without new rounding.
  [[nodiscard]] Vector3 apply_abs(const Vector3& error) const { return absolute(forward_, error); }
  // A bound, in target space, of all that can separate a source point `p` from what comes back
  // when apply(p) is rounded, mapped back by the inverse and looked at from target space.
  [[nodiscard]] Vector3 round_trip_error(const Point3& p) const;

  friend Transform operator*(const Transform& outer, const Transform& inner);
  friend bool operator==(const Transform& a, const Transform& b) {
    return a.forward_ == b.forward_;
  }

 private:
  Transform(const AffineRows& forward, const AffineRows& backward)
      : forward_(forward), backward_(backward) {}

  [[nodiscard]] static Point3 point(const AffineRows& m, const Point3& p) {
    return {m[0][0] * p.x + m[0][1] * p.y + m[0][2] * p.z + m[0][3],
            m[1][0] * p.x + m[1][1] * p.y + m[1][2] * p.z + m[1][3],
            m[2][0] * p.x + m[2][1] * p.y + m[2][2] * p.z + m[2][3]};
  }
  [[nodiscard]] static Vector3 vector(const AffineRows& m, const Vector3& v) {
    return {m[0][0] * v.x + m[0][1] * v.y + m[0][2] * v.z,
            m[1][0] * v.x + m[1][1] * v.y + m[1][2] * v.z,
            m[2][0] * v.x + m[2][1] * v.y + m[2][2] * v.z};
  }
  [[nodiscard]] static Normal3 normal(const AffineRows& inverse, const Normal3& n) {
    return {inverse[0][0] * n.x + inverse[1][0] * n.y + inverse[2][0] * n.z,
            inverse[0][1] * n.x + inverse[1][1] * n.y + inverse[2][1] * n.z,
            inverse[0][2] * n.x + inverse[1][2] * n.y + inverse[2][2] * n.z};
  }
  [[nodiscard]] static Vector3 absolute(const AffineRows& m, const Vector3& v);

  AffineRows forward_{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
  AffineRows backward_{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
};

}  // namespace scenec::backend
