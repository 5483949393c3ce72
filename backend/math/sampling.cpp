#include "backend/math/sampling.hpp"

#include <cmath>

namespace scenec::backend {
namespace {

double positive_root(double x) {
  return x > 0 ? std::sqrt(x) : 0.0;
}

// The angle of (x, y) as a fraction of the circle in [0, 1).
double turn_of(double y, double x) {
  const double turn = atan2(y, x) / (2 * pi);
  const double wrapped = turn < 0 ? turn + 1 : turn;
  return wrapped < 1 ? wrapped : 0.0;
}

// cos theta = 1 - k, with sin theta from k itself so that small angles keep their digits.
UnitVector3 direction_of(double k, double turn) {
  const double sin_theta = positive_root(k * (2 - k));
  const SinCos phi = sin_cos_of_turns(turn);
  return UnitVector3::assume_unit({sin_theta * phi.cos, sin_theta * phi.sin, 1 - k});
}

// 1 - cos theta of a unit vector, from its sine where that is small.
double one_minus_z(const UnitVector3& w) {
  const double sin_squared = w.x() * w.x() + w.y() * w.y();
  return w.z() > 0 ? sin_squared / (1 + w.z()) : 1 - w.z();
}

}  // namespace

Sample2 invert_concentric_disk(Sample2 point) {
  const double x = point.u;
  const double y = point.v;
  const double r = std::sqrt(x * x + y * y);
  if (r == 0) return {0.5, 0.5};
  double a = 0;
  double b = 0;
  if (std::fabs(x) > std::fabs(y)) {
    a = std::copysign(r, x);
    b = a * (atan2(y, x * std::copysign(1.0, x)) * std::copysign(1.0, x) / (pi / 4));
  } else {
    b = std::copysign(r, y);
    a = b * (atan2(x, y * std::copysign(1.0, y)) * std::copysign(1.0, y) / (pi / 4));
  }
  return {0.5 * (a + 1), 0.5 * (b + 1)};
}

Sample2 invert_cosine_hemisphere(const UnitVector3& w) {
  return invert_concentric_disk({w.x(), w.y()});
}

UnitVector3 sample_uniform_hemisphere(Sample2 s) {
  return direction_of(s.u, s.v);
}
Sample2 invert_uniform_hemisphere(const UnitVector3& w) {
  return {one_minus_z(w), turn_of(w.y(), w.x())};
}

UnitVector3 sample_uniform_sphere(Sample2 s) {
  return direction_of(2 * s.u, s.v);
}
Sample2 invert_uniform_sphere(const UnitVector3& w) {
  return {0.5 * one_minus_z(w), turn_of(w.y(), w.x())};
}

double one_minus_cos(double sin_squared) {
  return sin_squared / (1 + positive_root(1 - sin_squared));
}

UnitVector3 sample_uniform_cone(Sample2 s, double sin_squared_max) {
  return direction_of(s.u * one_minus_cos(sin_squared_max), s.v);
}

double pdf_uniform_cone(double sin_squared_max) {
  return 1 / (2 * pi * one_minus_cos(sin_squared_max));
}

Sample2 invert_uniform_cone(const UnitVector3& w, double sin_squared_max) {
  return {one_minus_z(w) / one_minus_cos(sin_squared_max), turn_of(w.y(), w.x())};
}

}  // namespace scenec::backend
