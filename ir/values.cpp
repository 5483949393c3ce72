#include "ir/values.hpp"

namespace scenec::ir {

Transform multiply(const Transform& a, const Transform& b) {
  Transform product;
  for (std::size_t row = 0; row < 4; ++row) {
    for (std::size_t column = 0; column < 4; ++column) {
      double sum = 0;
      for (std::size_t k = 0; k < 4; ++k) sum += a.m[row * 4 + k] * b.m[k * 4 + column];
      product.m[row * 4 + column] = sum;
    }
  }
  return product;
}

Point3 apply(const Transform& transform, const Point3& point) {
  const auto& m = transform.m;
  return {m[0] * point.x + m[1] * point.y + m[2] * point.z + m[3],
          m[4] * point.x + m[5] * point.y + m[6] * point.z + m[7],
          m[8] * point.x + m[9] * point.y + m[10] * point.z + m[11]};
}

Vec3 apply_linear(const Transform& transform, const Vec3& vector) {
  const auto& m = transform.m;
  return {m[0] * vector.x + m[1] * vector.y + m[2] * vector.z,
          m[4] * vector.x + m[5] * vector.y + m[6] * vector.z,
          m[8] * vector.x + m[9] * vector.y + m[10] * vector.z};
}

double determinant(const Transform& transform) {
  const auto& m = transform.m;
  return m[0] * (m[5] * m[10] - m[6] * m[9]) - m[1] * (m[4] * m[10] - m[6] * m[8]) +
         m[2] * (m[4] * m[9] - m[5] * m[8]);
}

}  // namespace scenec::ir
