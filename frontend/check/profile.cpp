#include "frontend/check/profile.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace scenec::frontend {

namespace {

constexpr int points_a_span = 64;

// One Bezier curve at t (de Casteljau).
double bezier_at(std::span<const double> points, double t) {
  std::vector<double> level(points.begin(), points.end());
  for (std::size_t left = level.size(); left > 1; --left) {
    for (std::size_t i = 0; i + 1 < left; ++i) level[i] = (1 - t) * level[i] + t * level[i + 1];
  }
  return level[0];
}

// A cubic B-spline on its knots (de Boor), in the span that starts at knot `span`.
double bspline_at(std::span<const double> points, std::span<const double> knots, std::size_t span,
                  double t) {
  constexpr std::size_t degree = 3;
  std::array<double, degree + 1> d{};
  for (std::size_t i = 0; i <= degree; ++i) d[i] = points[span - degree + i];
  for (std::size_t r = 1; r <= degree; ++r) {
    for (std::size_t i = degree; i >= r; --i) {
      const double low = knots[span - degree + i], high = knots[span + 1 + i - r];
      const double share = high > low ? (t - low) / (high - low) : 0;
      d[i] = (1 - share) * d[i - 1] + share * d[i];
    }
  }
  return d[degree];
}

double smallest_of_bspline(const std::vector<double>& radii, bool clamped) {
  constexpr std::size_t degree = 3;
  std::vector<double> knots(radii.size() + degree + 1);
  for (std::size_t i = 0; i < knots.size(); ++i) {
    const std::size_t inner = clamped ? std::clamp(i, degree, radii.size()) : i;
    knots[i] = static_cast<double>(inner);
  }
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t span = degree; span < radii.size(); ++span) {
    for (int k = 0; k <= points_a_span; ++k) {
      const double t = knots[span] + (knots[span + 1] - knots[span]) * k / points_a_span;
      smallest = std::min(smallest, bspline_at(radii, knots, span, t));
    }
  }
  return smallest;
}

}  // namespace

double smallest_radius(const ir::Curve& curve) {
  if (curve.points.empty()) return 0;
  std::vector<double> radii;
  for (const ir::Vec2& point : curve.points) radii.push_back(point.x);
  const double lowest = *std::min_element(radii.begin(), radii.end());
  if (lowest >= 0 || curve.kind == ir::CurveKind::polyline) return lowest;
  if (curve.kind == ir::CurveKind::bspline && radii.size() >= 4)
    return smallest_of_bspline(radii, curve.clamped);
  const std::size_t degree = curve.kind == ir::CurveKind::beziers ? 3 : radii.size() - 1;
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t first = 0; degree > 0 && first + degree < radii.size(); first += degree) {
    for (int k = 0; k <= points_a_span; ++k) {
      const double t = static_cast<double>(k) / points_a_span;
      smallest = std::min(smallest, bezier_at(std::span(radii).subspan(first, degree + 1), t));
    }
  }
  return smallest;
}

}  // namespace scenec::frontend
