// The surface swept by a profile curve (radius, height) turning about an axis.
//
// Domain:     finite control points, Bezier segments of degree 1..15; any finite ray.
// Method:     on the surface rho(t)^2 = r(s)^2 and height(t) = h(s), in two unknowns: t along the
//             ray, s along the curve. s is halved (de Casteljau); a piece is dropped when the ray
//             misses the shell of its hull, and solved when one of two eliminations of t is proven
//             monotone on it: t from the radius (a branch before and one after the closest approach
//             to the axis, no division by the slope along the axis) or t from the height. The root
//             is found by Newton in a bracket and polished by two steps in (t, s).
// Error:      roots satisfy both equations to gamma(64) of the profile's size.
// Degenerate: tangent rays: a ray may hit that passes within 4 gamma(16) of the profile's and the
//             origin's size; a ray lying in the surface for a whole
//             interval reports a point near the interval's nearest end; at most 4096 pieces a
//             segment; negative radii count as their absolute value; a pole's normal is that of its
//             limit tangent. Hits for which no piece was proven monotone, and all of a ray whose
//             pieces ran out, say that they are not certified.
// Proof:      tests/numerics/revolve_cases.cpp (R01 - R19).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "backend/geometry/kernel.hpp"

namespace scenec::backend {

struct ProfilePoint {
  double radius = 0;
  double height = 0;
};

enum class Axis : std::uint8_t { x, y, z };

inline constexpr int max_profile_degree = 15;

// Curves as Bezier segments, all in one list of points; segment i takes degrees[i] + 1 points from
// starts[i] on. Consecutive segments of one curve repeat the shared point.
struct Profile {
  std::vector<ProfilePoint> points;
  std::vector<std::uint32_t> starts;
  std::vector<std::uint8_t> degrees;

  [[nodiscard]] std::size_t size() const { return starts.size(); }
  [[nodiscard]] std::span<const ProfilePoint> segment(std::size_t i) const {
    return std::span(points).subspan(starts[i], std::size_t{degrees[i]} + 1);
  }
  void add_segment(std::span<const ProfilePoint> control);
};

// At least 2 points: one line segment between each two.
[[nodiscard]] Profile polyline_profile(std::span<const ProfilePoint> points);
// 2 to 16 points: one segment.
[[nodiscard]] Profile bezier_profile(std::span<const ProfilePoint> points);
// 3k + 1 points: k cubics.
[[nodiscard]] Profile beziers_profile(std::span<const ProfilePoint> points);
enum class SplineEnds : std::uint8_t { clamped, uniform };
// At least 4 points; cubic. Clamped: passes through the ends; uniform: knots of step 1 on [t3, tn].
[[nodiscard]] Profile bspline_profile(std::span<const ProfilePoint> points, SplineEnds ends);

// How rays meet the surface. `newton` is the method of the course's ray casters, kept to be
// compared with (revolve_newton.cpp); it misses roots.
enum class RootFinder : std::uint8_t { certified, newton };

class Revolve {
 public:
  Revolve() = default;
  explicit Revolve(Profile profile, Axis axis = Axis::y, RootFinder finder = RootFinder::certified);

  [[nodiscard]] const Profile& profile() const { return profile_; }
  [[nodiscard]] RootFinder finder() const { return finder_; }
  [[nodiscard]] Axis axis() const { return axis_; }

  // Bounds of one segment: |r| and h of its control points.
  struct Piece {
    double radius_min = 0;
    double radius_max = 0;
    double height_min = 0;
    double height_max = 0;
  };
  [[nodiscard]] const std::vector<Piece>& pieces() const { return pieces_; }
  [[nodiscard]] std::uint64_t memory() const {
    return sizeof *this + pieces_.capacity() * sizeof(Piece) +
           profile_.points.capacity() * sizeof(ProfilePoint) +
           profile_.starts.capacity() * sizeof(std::uint32_t) + profile_.degrees.capacity();
  }

 private:
  Profile profile_;
  std::vector<Piece> pieces_;
  Axis axis_ = Axis::y;
  RootFinder finder_ = RootFinder::certified;
};

// `part` is the segment, `a` the curve parameter in [0, 1] within it, `b` is 0 where the root is
// certified and 1 where it is not.
[[nodiscard]] bool intersect(const Revolve& revolve, const Ray& ray, ShapeHit& out);
[[nodiscard]] inline bool is_certified(const ShapeHit& hit) {
  return hit.b == 0;
}
// As above by the damped Newton iteration, whatever the surface's own finder: see its file. No hit
// of it is certified.
[[nodiscard]] bool intersect_by_newton(const Revolve& revolve, const Ray& ray, ShapeHit& out);
// Every hit of the closed interval, sorted by t, whatever the surface's own finder.
void intersect_all(const Revolve& revolve, const Ray& ray, std::vector<ShapeHit>& out);
[[nodiscard]] Bounds3 bounds(const Revolve& revolve);
// u the angle about the axis / 2 pi (as on a sphere), v along the whole profile in [0, 1].
[[nodiscard]] Surface surface(const Revolve& revolve, const Ray& ray, const ShapeHit& hit);

}  // namespace scenec::backend
