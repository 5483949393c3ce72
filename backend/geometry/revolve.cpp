// Profiles, bounds and the surface of revolutions; the root finder is in revolve_solve.cpp.
#include "backend/geometry/revolve.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "backend/geometry/angle.hpp"
#include "backend/geometry/profile_point.hpp"
#include "base/assert.hpp"

namespace scenec::backend {
namespace {

ProfilePoint mix(const ProfilePoint& a, const ProfilePoint& b, double t) {
  return {(1 - t) * a.radius + t * b.radius, (1 - t) * a.height + t * b.height};
}

// The blossom of span [knot(3 + i), knot(4 + i)] of a cubic B-spline at three arguments.
ProfilePoint blossom(std::span<const ProfilePoint> points, std::span<const double> knots,
                     std::size_t i, const std::array<double, 3>& args) {
  std::array<ProfilePoint, 4> p{points[i], points[i + 1], points[i + 2], points[i + 3]};
  for (std::size_t level = 0; level < 3; ++level) {
    for (std::size_t j = 0; j + level < 3; ++j) {
      const double low = knots[i + j + level + 1];
      const double high = knots[i + j + 4];
      p[j] = mix(p[j], p[j + 1], (args[level] - low) / (high - low));
    }
  }
  return p[0];
}

std::vector<double> spline_knots(std::size_t count, SplineEnds ends) {
  std::vector<double> knots(count + 4);
  for (std::size_t i = 0; i < knots.size(); ++i) {
    const double uniform = static_cast<double>(i) - 3;
    knots[i] = ends == SplineEnds::uniform
                   ? uniform
                   : std::clamp(uniform, 0.0, static_cast<double>(count) - 3);
  }
  return knots;
}

}  // namespace

void Profile::add_segment(std::span<const ProfilePoint> control) {
  SCENEC_ASSERT(control.size() >= 2 && control.size() <= max_profile_degree + 1);
  starts.push_back(static_cast<std::uint32_t>(points.size()));
  degrees.push_back(static_cast<std::uint8_t>(control.size() - 1));
  points.insert(points.end(), control.begin(), control.end());
}

Profile polyline_profile(std::span<const ProfilePoint> points) {
  SCENEC_ASSERT(points.size() >= 2);
  Profile p;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) p.add_segment(points.subspan(i, 2));
  return p;
}

Profile bezier_profile(std::span<const ProfilePoint> points) {
  Profile p;
  p.add_segment(points);
  return p;
}

Profile beziers_profile(std::span<const ProfilePoint> points) {
  SCENEC_ASSERT(points.size() >= 4 && points.size() % 3 == 1);
  Profile p;
  for (std::size_t i = 0; i + 3 < points.size(); i += 3) p.add_segment(points.subspan(i, 4));
  return p;
}

Profile bspline_profile(std::span<const ProfilePoint> points, SplineEnds ends) {
  SCENEC_ASSERT(points.size() >= 4);
  const std::vector<double> knots = spline_knots(points.size(), ends);
  Profile p;
  ProfilePoint joint = blossom(points, knots, 0, {knots[3], knots[3], knots[3]});
  for (std::size_t i = 0; i + 3 < points.size(); ++i) {
    const double a = knots[i + 3];
    const double b = knots[i + 4];
    // The joint is handed on, so both spans have the same bits there.
    const std::array<ProfilePoint, 4> control{joint, blossom(points, knots, i, {a, a, b}),
                                              blossom(points, knots, i, {a, b, b}),
                                              blossom(points, knots, i, {b, b, b})};
    p.add_segment(control);
    joint = control[3];
  }
  return p;
}

Revolve::Revolve(Profile profile, Axis axis, RootFinder finder)
    : profile_(std::move(profile)), axis_(axis), finder_(finder) {
  pieces_.reserve(profile_.size());
  for (std::size_t i = 0; i < profile_.size(); ++i) {
    const std::span<const ProfilePoint> control = profile_.segment(i);
    double low = control[0].radius;
    double high = low;
    Piece piece{0, 0, control[0].height, control[0].height};
    for (const ProfilePoint& p : control) {
      low = std::min(low, p.radius);
      high = std::max(high, p.radius);
      piece.height_min = std::min(piece.height_min, p.height);
      piece.height_max = std::max(piece.height_max, p.height);
    }
    piece.radius_max = std::max(std::fabs(low), std::fabs(high));
    piece.radius_min = low <= 0 && high >= 0 ? 0 : std::min(std::fabs(low), std::fabs(high));
    pieces_.push_back(piece);
  }
}

Bounds3 bounds(const Revolve& revolve) {
  Bounds3 local;
  for (const Revolve::Piece& p : revolve.pieces()) {
    local.grow(Point3{-p.radius_max, p.height_min, -p.radius_max});
    local.grow(Point3{p.radius_max, p.height_max, p.radius_max});
  }
  if (local.empty()) return local;
  // The root finder lets rays hit that pass by within gamma(64) of the size.
  const double slack = gamma(64) * (max_abs(as_vector(local.min)) + max_abs(as_vector(local.max)));
  const Bounds3 grown = outward(local, {slack, slack, slack});
  Bounds3 out;
  out.grow(as_point(object_from_axis(as_vector(grown.min), revolve.axis())));
  out.grow(as_point(object_from_axis(as_vector(grown.max), revolve.axis())));
  return out;
}

Surface surface(const Revolve& revolve, const Ray& ray, const ShapeHit& hit) {
  const std::span<const ProfilePoint> control = revolve.profile().segment(hit.part);
  const ProfileJet jet = evaluate_profile(control, hit.a);
  const ProfilePoint tangent = profile_tangent(control, jet, hit.a);
  // |r| has slope sign(r) r'; at the axis itself the side is that of the segment.
  double side = jet.point.radius;
  if (side == 0)
    for (const ProfilePoint& p : control) side += p.radius;
  const double mirror = side < 0 ? -1 : 1;
  const double radius = std::fabs(jet.point.radius);
  const double radius_slope = mirror * tangent.radius;

  const Vector3 at = axis_from_object(as_vector(ray.origin), revolve.axis()) +
                     hit.t * axis_from_object(ray.direction, revolve.axis());
  const double rho = std::sqrt(at.x * at.x + at.z * at.z);
  const double c = rho > 0 ? at.x / rho : 1;
  const double n = rho > 0 ? at.z / rho : 0;
  const auto outer = [&](const Vector3& v) { return object_from_axis(v, revolve.axis()); };

  Surface s;
  s.point = as_point(outer({radius * c, jet.point.height, radius * n}));
  Vector3 normal{tangent.height * c, -radius_slope, tangent.height * n};
  if (normal == Vector3{0, 0, 0}) normal = {c, 0, n};  // the whole segment is one point
  s.geometric_normal = s.shading_normal = as_normal(outer(normal));
  const auto segments = static_cast<double>(revolve.profile().size());
  s.u = turn_fraction(-n, c);
  s.v = (hit.part + hit.a) / segments;
  s.dp_du = outer(2 * pi * Vector3{radius * n, 0, -radius * c});
  s.dp_dv = outer(segments * Vector3{radius_slope * c, tangent.height, radius_slope * n});
  // What the root finder may be off by, in every direction: see `Solver::slack`.
  double size = 0;
  for (const ProfilePoint& p : control)
    size = std::max({size, std::fabs(p.radius), std::fabs(p.height)});
  const double e = gamma(256) * size;
  s.error = Vector3{e, e, e} + gamma(4) * abs(as_vector(s.point));
  return s;
}

}  // namespace scenec::backend
