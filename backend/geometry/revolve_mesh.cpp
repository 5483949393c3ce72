#include "backend/geometry/revolve_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "backend/geometry/profile_point.hpp"
#include "base/elementary.hpp"

namespace scenec::backend {
namespace {

// A step of a curve is never cut finer than this, whatever its bound asks for.
constexpr double max_cuts = 65536;

double largest_radius(const Revolve& revolve) {
  double radius = 0;
  for (const Revolve::Piece& p : revolve.pieces()) radius = std::fmax(radius, p.radius_max);
  return radius;
}

// How far a chord of one step round the axis is from its arc: r (1 - cos) = 2 r sin^2 of half.
double round_error(double radius, std::uint32_t steps) {
  const double s = sin(pi / (2 * static_cast<double>(steps)));
  return 2 * radius * s * s;
}

// The largest second derivative of a segment, from its second differences.
double bend_of(std::span<const ProfilePoint> p) {
  const auto n = static_cast<double>(p.size() - 1);
  double bend = 0;
  for (std::size_t i = 2; i < p.size(); ++i) {
    const double r = p[i].radius - 2 * p[i - 1].radius + p[i - 2].radius;
    const double h = p[i].height - 2 * p[i - 1].height + p[i - 2].height;
    bend = std::fmax(bend, n * (n - 1) * std::sqrt(r * r + h * h));
  }
  return bend;
}

// A chord over ds is within bend ds^2 / 8 of the curve.
std::uint32_t cuts_of(std::span<const ProfilePoint> control, double error) {
  const double bend = bend_of(control);
  if (!(bend > 0) || !(error > 0)) return 1;
  return static_cast<std::uint32_t>(
      std::clamp(std::ceil(std::sqrt(bend / (8 * error))), 1.0, max_cuts));
}

struct Ring {
  double s = 0;
  ProfilePoint point;    // radius >= 0
  ProfilePoint tangent;  // of the surface's meridian, radius growing outwards
};

Ring ring_at(std::span<const ProfilePoint> control, double s, double side) {
  const ProfileJet jet = evaluate_profile(control, s);
  const ProfilePoint tangent = profile_tangent(control, jet, s);
  return {
      s, {std::fabs(jet.point.radius), jet.point.height}, {side * tangent.radius, tangent.height}};
}

// Where the signed radius changes sign between two parameters.
double crossing(std::span<const ProfilePoint> control, double low, double high) {
  const bool rises = evaluate_profile(control, low).point.radius < 0;
  for (double middle = 0.5 * (low + high); middle > low && middle < high;
       middle = 0.5 * (low + high)) {
    const bool below = evaluate_profile(control, middle).point.radius < 0;
    (below == rises ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

std::vector<Ring> rings_of(std::span<const ProfilePoint> control, double error) {
  const std::uint32_t cuts = cuts_of(control, error);
  std::vector<Ring> rings;
  double before = 0;
  for (std::uint32_t i = 0; i <= cuts; ++i) {
    const double s = static_cast<double>(i) / cuts;
    const double radius = evaluate_profile(control, s).point.radius;
    double side = radius < 0 ? -1 : 1;
    if (i > 0 && ((before < 0 && radius > 0) || (before > 0 && radius < 0))) {
      const double at = crossing(control, static_cast<double>(i - 1) / cuts, s);
      // On the axis for both sides: the meridian comes in before it and goes out after it.
      Ring pole = ring_at(control, at, before < 0 ? -1 : 1);
      pole.point.radius = 0;
      rings.push_back(pole);
      pole.tangent.radius = -pole.tangent.radius;
      rings.push_back(pole);
    }
    if (radius == 0) {
      for (const ProfilePoint& p : control) side += p.radius;
      side = side - 1 < 0 ? -1 : 1;
    }
    rings.push_back(ring_at(control, s, side));
    before = radius;
  }
  return rings;
}

class Tessellation {
 public:
  Tessellation(const Revolve& revolve, std::uint32_t steps)
      : revolve_(revolve), steps_(steps), cos_(steps), sin_(steps) {
    for (std::uint32_t j = 0; j < steps; ++j) {
      const double angle = 2 * pi * j / steps;
      cos_[j] = cos(angle);
      sin_[j] = sin(angle);
    }
  }

  TriangleMesh run() {
    const double error = round_error(largest_radius(revolve_), steps_);
    for (std::size_t i = 0; i < revolve_.profile().size(); ++i) {
      const auto rings = rings_of(revolve_.profile().segment(i), error);
      std::uint32_t below = 0;
      std::uint32_t below_attributes = 0;
      for (std::size_t k = 0; k < rings.size(); ++k) {
        // A segment begins on the ring its neighbour ended on, if that is where it is.
        const bool joins = i > 0 && k == 0 && rings[0].point.radius == last_.radius &&
                           rings[0].point.height == last_.height;
        const std::uint32_t first = joins ? last_first_ : add_positions(rings[k].point);
        const std::uint32_t attributes = add_attributes(i, rings[k]);
        if (k > 0) add_band(rings[k - 1], below, below_attributes, rings[k], first, attributes);
        below = first;
        below_attributes = attributes;
      }
      last_ = rings.back().point;
      last_first_ = below;
    }
    return std::move(mesh_);
  }

 private:
  [[nodiscard]] Vector3 turned(const Vector3& v) const {
    return object_from_axis(v, revolve_.axis());
  }

  std::uint32_t add_positions(const ProfilePoint& p) {
    const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
    const std::uint32_t count = p.radius == 0 ? 1 : steps_;
    for (std::uint32_t j = 0; j < count; ++j)
      mesh_.positions.push_back(
          as_point(turned({p.radius * cos_[j], p.height, -p.radius * sin_[j]})));
    return first;
  }

  // steps + 1 normals and coordinates: the seam has u = 0 and u = 1.
  std::uint32_t add_attributes(std::size_t segment, const Ring& ring) {
    const auto first = static_cast<std::uint32_t>(mesh_.normals.size());
    const double v =
        (static_cast<double>(segment) + ring.s) / static_cast<double>(revolve_.profile().size());
    for (std::uint32_t j = 0; j <= steps_; ++j) {
      const double c = cos_[j % steps_];
      const double s = -sin_[j % steps_];
      mesh_.normals.push_back(as_normal(
          normalized(
              turned({ring.tangent.height * c, -ring.tangent.radius, ring.tangent.height * s}),
              normalized(turned({c, 0, s})))
              .vector()));
      mesh_.uvs.push_back({static_cast<double>(j) / steps_, v});
    }
    return first;
  }

  void add_face(const Face& at, const Face& attributes) {
    if (at[0] == at[1] || at[1] == at[2] || at[2] == at[0]) return;
    mesh_.faces.push_back(at);
    mesh_.normal_faces.push_back(attributes);
    mesh_.uv_faces.push_back(attributes);
  }

  // Counter-clockwise seen from where dp_du x dp_dv points.
  void add_band(const Ring& low, std::uint32_t low_at, std::uint32_t low_attributes,
                const Ring& high, std::uint32_t high_at, std::uint32_t high_attributes) {
    for (std::uint32_t j = 0; j < steps_; ++j) {
      const std::uint32_t next = (j + 1) % steps_;
      const auto vertex = [&](const Ring& ring, std::uint32_t first, std::uint32_t k) {
        return ring.point.radius == 0 ? first : first + k;
      };
      const std::uint32_t a = vertex(low, low_at, j);
      const std::uint32_t b = vertex(low, low_at, next);
      const std::uint32_t c = vertex(high, high_at, next);
      const std::uint32_t d = vertex(high, high_at, j);
      const std::uint32_t e = low_attributes + j;
      const std::uint32_t f = high_attributes + j;
      add_face({a, b, c}, {e, e + 1, f + 1});
      add_face({a, c, d}, {e, f + 1, f});
    }
  }

  const Revolve& revolve_;
  std::uint32_t steps_;
  std::vector<double> cos_;
  std::vector<double> sin_;
  TriangleMesh mesh_;
  ProfilePoint last_;
  std::uint32_t last_first_ = 0;
};

}  // namespace

TriangleMesh tessellate(const Revolve& revolve, std::uint32_t steps) {
  return Tessellation(revolve, steps).run();
}

std::uint64_t tessellated_face_count(const Revolve& revolve, std::uint32_t steps) {
  const double error = round_error(largest_radius(revolve), steps);
  std::uint64_t bands = 0;
  for (std::size_t i = 0; i < revolve.profile().size(); ++i)
    // A segment of degree n crosses the axis at most n times.
    bands += std::uint64_t{cuts_of(revolve.profile().segment(i), error)} +
             2 * revolve.profile().degrees[i];
  return 2 * bands * steps;
}

double chord_bound(const Revolve& revolve, std::uint32_t steps) {
  const double around = round_error(largest_radius(revolve), steps);
  double along = 0;
  for (std::size_t i = 0; i < revolve.profile().size(); ++i) {
    const auto control = revolve.profile().segment(i);
    const double cuts = cuts_of(control, around);
    along = std::fmax(along, bend_of(control) / (8 * cuts * cuts));
  }
  return around + along;
}

}  // namespace scenec::backend
