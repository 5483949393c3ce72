// What a hit says of its surface: the point within its error, inside the bounds, coordinates and
// their derivatives (G27 - G29).
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "backend/accel/scene_accel.hpp"
#include "backend/geometry/profile_point.hpp"
#include "tests/numerics/finding.hpp"
#include "tests/numerics/meshes.hpp"
#include "tests/numerics/wide.hpp"

namespace scenec::numerics {
namespace {

using namespace backend;
using backend::testing_support::Draw;
using Point = V3<Wide>;

const Wide wide_pi = acosq(-1);

Point about(const Frame& f, Wide x, Wide y, Wide z) {
  return x * as<Wide>(f.x) + y * as<Wide>(f.y) + z * as<Wide>(f.z);
}

// Each surface as the map from (u, v) its header promises, and the distance of a point from it.
Point map_of(const Sphere& s, const ShapeHit&, Wide u, Wide v) {
  const Wide turn = 2 * wide_pi * u;
  const Wide rise = wide_pi * (v - Wide(0.5));
  const Wide r = s.radius;
  return as<Wide>(s.center) +
         Point{r * cosq(rise) * cosq(turn), r * sinq(rise), -r * cosq(rise) * sinq(turn)};
}
Wide off(const Sphere& s, const ShapeHit&, const Point& p) {
  return length(p - as<Wide>(s.center)) - Wide(s.radius);
}

Point map_of(const Plane& plane, const ShapeHit&, Wide u, Wide v) {
  const Frame f = frame_about(normalized(plane.normal));
  const Point n = as<Wide>(plane.normal);
  // The frame's axes are unit and orthogonal to rounding only.
  return about(f, u, v, 0) + (Wide(plane.offset) / dot(n, n)) * n;
}
Wide off(const Plane& plane, const ShapeHit&, const Point& p) {
  const Point n = as<Wide>(plane.normal);
  return (dot(n, p) - Wide(plane.offset)) / length(n);
}

Point map_of(const Triangle& t, const ShapeHit&, Wide u, Wide v) {
  return as<Wide>(t.a) + u * (as<Wide>(t.b) - as<Wide>(t.a)) + v * (as<Wide>(t.c) - as<Wide>(t.a));
}
Wide off(const Triangle& t, const ShapeHit&, const Point& p) {
  const Point n = cross(as<Wide>(t.b) - as<Wide>(t.a), as<Wide>(t.c) - as<Wide>(t.a));
  return dot(n, p - as<Wide>(t.a)) / length(n);
}

Point map_of(const Quad& q, const ShapeHit&, Wide u, Wide v) {
  return as<Wide>(q.corner) + u * as<Wide>(q.edge_u) + v * as<Wide>(q.edge_v);
}
Wide off(const Quad& q, const ShapeHit&, const Point& p) {
  const Point n = cross(as<Wide>(q.edge_u), as<Wide>(q.edge_v));
  return dot(n, p - as<Wide>(q.corner)) / length(n);
}

Point map_of(const Disk& d, const ShapeHit&, Wide u, Wide v) {
  const Wide turn = 2 * wide_pi * u;
  const Wide r = Wide(d.radius) * (1 - v);
  return as<Wide>(d.center) + about(frame_about(d.normal), r * cosq(turn), r * sinq(turn), 0);
}
Wide off(const Disk& d, const ShapeHit&, const Point& p) {
  return dot(as<Wide>(d.normal), p - as<Wide>(d.center)) / length(as<Wide>(d.normal));
}

// u x v points outwards, v is up on the sides.
Point map_of(const Box& b, const ShapeHit& hit, Wide u, Wide v) {
  const int axis = static_cast<int>(hit.part / 2);
  const bool high = hit.part % 2 == 1;
  const Point low = as<Wide>(b.min);
  const Point size = as<Wide>(b.max) - low;
  std::array<Wide, 3> f{};
  f[static_cast<std::size_t>(axis)] = high ? 1 : 0;
  if (axis == 0) f[2] = high ? 1 - u : u, f[1] = v;
  if (axis == 2) f[0] = high ? u : 1 - u, f[1] = v;
  if (axis == 1) f[0] = u, f[2] = high ? 1 - v : v;
  return low + Point{f[0] * size.x, f[1] * size.y, f[2] * size.z};
}
Wide off(const Box& b, const ShapeHit& hit, const Point& p) {
  const Point side = as<Wide>(hit.part % 2 == 1 ? b.max : b.min);
  const int axis = static_cast<int>(hit.part / 2);
  return axis == 0 ? p.x - side.x : axis == 1 ? p.y - side.y : p.z - side.z;
}

Point map_of(const Cylinder& c, const ShapeHit& hit, Wide u, Wide v) {
  // The lower cap is seen from below: its angle runs the other way.
  const Wide turn = 2 * wide_pi * u;
  const Wide r = hit.part == 0 ? Wide(c.radius) : Wide(c.radius) * (1 - v);
  const Wide z = hit.part == 0 ? v * Wide(c.height) : hit.part == 1 ? Wide(0) : Wide(c.height);
  const Wide side = hit.part == 1 ? -1 : 1;
  return as<Wide>(c.base) + about(c.frame, r * cosq(turn), side * r * sinq(turn), z);
}
Wide off(const Cylinder& c, const ShapeHit& hit, const Point& p) {
  const Point z = as<Wide>(c.frame.z);
  const Point rel = p - as<Wide>(c.base);
  const Wide along = dot(rel, z) / length(z);
  if (hit.part != 0) return along - (hit.part == 1 ? Wide(0) : Wide(c.height));
  return length(rel - (along / length(z)) * z) - Wide(c.radius);
}

struct WideProfilePoint {
  Wide radius;
  Wide height;
};
WideProfilePoint profile_at(std::span<const ProfilePoint> control, Wide s) {
  std::vector<WideProfilePoint> p;
  for (const ProfilePoint& c : control) p.push_back({c.radius, c.height});
  for (std::size_t level = p.size() - 1; level > 0; --level)
    for (std::size_t i = 0; i < level; ++i)
      p[i] = {(1 - s) * p[i].radius + s * p[i + 1].radius,
              (1 - s) * p[i].height + s * p[i + 1].height};
  return p[0];
}
Point map_of(const Revolve& r, const ShapeHit& hit, Wide u, Wide v) {
  const Wide s = v * Wide(r.profile().size()) - Wide(hit.part);
  const WideProfilePoint p = profile_at(r.profile().segment(hit.part), s);
  const Wide turn = 2 * wide_pi * u;
  const Wide radius = magnitude(p.radius);
  return {radius * cosq(turn), p.height, -radius * sinq(turn)};
}
Wide off(const Revolve& r, const ShapeHit& hit, const Point& p) {
  const WideProfilePoint q = profile_at(r.profile().segment(hit.part), hit.a);
  const Wide rho = root(p.x * p.x + p.z * p.z) - magnitude(q.radius);
  const Wide rise = p.y - q.height;
  return root(rho * rho + rise * rise);
}

void make(Draw& d, Sphere& s) {
  s = {d.point(4), d.power_of_ten(-2, 2)};
}
void make(Draw& d, Plane& p) {
  p = {as_normal(d.power_of_ten(-3, 3) * d.direction().vector()), d.between(-3, 3)};
}
void make(Draw& d, Triangle& t) {
  t = {d.point(3), d.point(3), d.point(3)};
}
void make(Draw& d, Quad& q) {
  q = {d.point(3), as_vector(d.point(3)), as_vector(d.point(3))};
}
void make(Draw& d, Disk& disk) {
  disk = {d.point(2), d.direction(), d.between(0.2, 3)};
}
void make(Draw& d, Box& b) {
  Bounds3 box;
  box.grow(d.point(3));
  box.grow(d.point(3));
  b = {box.min, box.max};
}
void make(Draw& d, Cylinder& c) {
  const Point3 base = d.point(3);
  c = Cylinder(base, base + as_vector(d.point(3)), d.between(0.2, 2), d.unit() < 0.7);
}
void make(Draw& d, Revolve& r) {
  std::vector<ProfilePoint> p;
  for (int i = 0; i < 4; ++i) p.push_back({d.between(0.1, 2), d.between(0, 3)});
  r = Revolve(bezier_profile(p));
}

Point3 within(const Bounds3& b, Draw& draw) {
  if (!b.finite()) return draw.point(5);
  return {draw.between(b.min.x, b.max.x), draw.between(b.min.y, b.max.y),
          draw.between(b.min.z, b.max.z)};
}

struct Tally {
  std::uint64_t hits = 0;
  std::uint64_t outside = 0;  // of the bounds
  double point_share = 0;     // of the error bound
  double uv = 0;              // distance of the map's point from the hit's, u of the size
  double derivative = 0;      // relative, in u
  std::uint64_t left_handed = 0;
};

// Central differences in quadruple precision: exact to 1e-20, far beyond double.
template <class Shape>
void check_derivatives(const Shape& shape, const ShapeHit& hit, const Surface& s, Tally& tally) {
  const Wide h = 1e-10;
  const Wide u = s.u;
  const Wide v = s.v;
  const Point du = (1 / (2 * h)) * (map_of(shape, hit, u + h, v) - map_of(shape, hit, u - h, v));
  const Point dv = (1 / (2 * h)) * (map_of(shape, hit, u, v + h) - map_of(shape, hit, u, v - h));
  const Wide scale = std::max(length(du), length(dv));
  const Wide error = std::max(length(du - as<Wide>(s.dp_du)), length(dv - as<Wide>(s.dp_dv)));
  tally.derivative =
      std::fmax(tally.derivative, static_cast<double>(error / scale) / unit_roundoff);
  const Point at = map_of(shape, hit, u, v);
  const Wide size = scale + length(at);
  tally.uv = std::fmax(tally.uv,
                       static_cast<double>(length(at - as<Wide>(s.point)) / size) / unit_roundoff);
  if (!(dot(cross(s.dp_du, s.dp_dv), as_vector(s.geometric_normal)) > 0)) ++tally.left_handed;
}

template <class Shape>
Tally measure() {
  constexpr int shapes = 10'000;
  Draw draw(27);
  Tally tally;
  for (int i = 0; i < shapes; ++i) {
    Shape shape;
    make(draw, shape);
    const Bounds3 box = bounds(shape);
    for (int k = 0; k < 10; ++k) {
      const Point3 target = within(box, draw);
      const Point3 origin = target + draw.power_of_ten(-1, 3) * draw.direction().vector();
      const Ray ray{origin, target - origin};
      ShapeHit hit;
      if (!intersect(shape, ray, hit)) continue;
      const Surface s = surface(shape, ray, hit);
      ++tally.hits;
      if (!box.contains(s.point)) ++tally.outside;
      const UnitVector3 n = normalized(s.geometric_normal);
      const auto away = static_cast<double>(magnitude(off(shape, hit, as<Wide>(s.point))));
      tally.point_share = std::fmax(tally.point_share, away / dot(abs(n), s.error));
      if (k == 0) check_derivatives(shape, hit, s, tally);
    }
  }
  return tally;
}

struct Kind {
  const char* name;
  Tally (*run)();
};

class G27Surface : public testing::TestWithParam<Kind> {};
TEST_P(G27Surface, IsWhatItSays) {
  const Tally t = GetParam().run();
  EXPECT_GT(t.hits, 2'000U);
  EXPECT_LE(t.point_share, 1);
  EXPECT_EQ(t.outside, 0U);
  EXPECT_EQ(t.left_handed, 0U);
  record({"G27", GetParam().name, t.hits, short_number(t.point_share) + " of the error bound", ""});
  record({"G28", GetParam().name, t.hits, fmt::format("{} points outside", t.outside), ""});
  EXPECT_LE(t.derivative, 16);
  EXPECT_LE(t.uv, 16);
  record({"G29", GetParam().name, t.hits,
          fmt::format("derivatives {} u; point of (u, v) {} u; {} left-handed",
                      short_number(t.derivative), short_number(t.uv), t.left_handed),
          ""});
}
INSTANTIATE_TEST_SUITE_P(
    G27G28G29, G27Surface,
    testing::Values(Kind{"sphere", measure<Sphere>}, Kind{"plane", measure<Plane>},
                    Kind{"triangle", measure<Triangle>}, Kind{"quad", measure<Quad>},
                    Kind{"disk", measure<Disk>}, Kind{"box", measure<Box>},
                    Kind{"cylinder", measure<Cylinder>}, Kind{"revolve", measure<Revolve>}));

// The tangents of a mesh follow its texture coordinates: along an edge they add up to it.
TEST(G29, MeshTangentsFollowTheTexture) {
  constexpr std::uint64_t faces = 100'000;
  Draw draw(29);
  double worst = 0;
  for (std::uint64_t i = 0; i < faces; ++i) {
    TriangleMesh mesh;
    for (int k = 0; k < 3; ++k) {
      mesh.positions.push_back(draw.point(3));
      mesh.uvs.push_back({draw.unit(), draw.unit()});
    }
    mesh.faces = {{0, 1, 2}};
    const Surface s = surface(mesh, {1, 0, 0.25, 0.25});
    const auto& uv = mesh.uvs;
    const double du1 = uv[1].u - uv[0].u;
    const double dv1 = uv[1].v - uv[0].v;
    const double du2 = uv[2].u - uv[0].u;
    const double dv2 = uv[2].v - uv[0].v;
    const double condition = (std::fabs(du1) + std::fabs(du2)) * (std::fabs(dv1) + std::fabs(dv2)) /
                             std::fabs(du1 * dv2 - dv1 * du2);
    const Vector3 edge = mesh.positions[1] - mesh.positions[0];
    const Vector3 back = s.dp_du * du1 + s.dp_dv * dv1;
    worst = std::fmax(worst, length(back - edge) / (6 * condition * unit_roundoff));
  }
  EXPECT_LE(worst, 16);
  record({"G29", "mesh with texture coordinates", faces,
          short_number(worst) + " u of size times condition", ""});
}

}  // namespace
}  // namespace scenec::numerics
