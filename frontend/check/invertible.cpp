#include "frontend/check/invertible.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>

#include "base/text.hpp"

namespace scenec::frontend {

namespace {

using Linear = std::array<double, 9>;

// The linear part divided by its largest entry, so that no product below overflows or underflows.
std::optional<Linear> normalised_linear(const ir::Transform& transform) {
  Linear linear{};
  double largest = 0;
  for (std::size_t i = 0; i < 9; ++i) {
    linear[i] = transform.m[(i / 3) * 4 + i % 3];
    if (!std::isfinite(linear[i])) return std::nullopt;
    largest = std::fmax(largest, std::fabs(linear[i]));
  }
  if (largest == 0) return std::nullopt;
  for (double& entry : linear) entry /= largest;
  return linear;
}

double frobenius(const Linear& m) {
  double sum = 0;
  for (double entry : m) sum += entry * entry;
  return std::sqrt(sum);
}

Linear cofactors(const Linear& m) {
  return {m[4] * m[8] - m[5] * m[7], m[5] * m[6] - m[3] * m[8], m[3] * m[7] - m[4] * m[6],
          m[2] * m[7] - m[1] * m[8], m[0] * m[8] - m[2] * m[6], m[1] * m[6] - m[0] * m[7],
          m[1] * m[5] - m[2] * m[4], m[2] * m[3] - m[0] * m[5], m[0] * m[4] - m[1] * m[3]};
}

// The most frequent transform of all needs no measuring.
bool is_pure_move(const ir::Transform& transform) {
  const auto& m = transform.m;
  return m[0] == 1 && m[1] == 0 && m[2] == 0 && m[4] == 0 && m[5] == 1 && m[6] == 0 && m[8] == 0 &&
         m[9] == 0 && m[10] == 1;
}

std::string matrix_text(const ir::Transform& transform) {
  std::string text = "matrix([";
  for (std::size_t i = 0; i < 16; ++i) {
    if (i > 0) text += ", ";
    text += short_number_text(transform.m[i]);
  }
  return text + "])";
}

}  // namespace

double condition_number(const ir::Transform& transform) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const auto linear = normalised_linear(transform);
  if (!linear) return infinite;
  const Linear adjoint = cofactors(*linear);
  const double determinant =
      (*linear)[0] * adjoint[0] + (*linear)[1] * adjoint[1] + (*linear)[2] * adjoint[2];
  // The scene's own check takes the determinant of the matrix as it is, which may underflow sooner.
  if (determinant == 0 || ir::determinant(transform) == 0) return infinite;
  return frobenius(*linear) * frobenius(adjoint) / std::fabs(determinant);
}

bool check_invertible(Session& session, const ir::Transform& transform, Span span) {
  for (double entry : transform.m) {
    if (std::isfinite(entry)) continue;
    session.error(Diagnostic(DiagnosticKind::singular_transform, span,
                             "the accumulated transform is beyond the largest number")
                      .note(matrix_text(transform)));
    return false;
  }
  if (is_pure_move(transform)) return true;
  const double condition = condition_number(transform);
  if (condition > flat_condition && condition <= max_condition) {
    session.lint(Diagnostic(DiagnosticKind::nearly_singular_transform, span,
                            fmt::format("the transform flattens: its condition number is {}",
                                        short_number_text(condition)))
                     .note("accumulated: " + matrix_text(transform))
                     .hint("keep the largest stretch below 8e6 times the smallest, or give the "
                           "shape its flat form by its own keys"));
  }
  if (condition <= max_condition) return true;
  session.error(Diagnostic(DiagnosticKind::singular_transform, span,
                           std::isinf(condition)
                               ? std::string("the transform cannot be inverted")
                               : fmt::format("the transform is nearly singular: its condition "
                                             "number is {}; needs at most 1e12",
                                             short_number_text(condition)))
                    .note("accumulated: " + matrix_text(transform)));
  return false;
}

std::optional<double> uniform_scale(const ir::Transform& transform) {
  const auto& m = transform.m;
  const auto product = [&](std::size_t a, std::size_t b) {
    return m[a] * m[b] + m[a + 4] * m[b + 4] + m[a + 8] * m[b + 8];
  };
  const double xx = product(0, 0), yy = product(1, 1), zz = product(2, 2);
  const double mean = (xx + yy + zz) / 3;
  // A product of up to some thousand rotations stays below this relative error of its columns.
  constexpr double tolerance = 0x1p-36;
  const auto near_zero = [&](double value) { return std::fabs(value) <= tolerance * mean; };
  if (!near_zero(xx - mean) || !near_zero(yy - mean) || !near_zero(zz - mean)) return std::nullopt;
  if (!near_zero(product(0, 1)) || !near_zero(product(0, 2)) || !near_zero(product(1, 2)))
    return std::nullopt;
  return std::sqrt(mean);
}

}  // namespace scenec::frontend
