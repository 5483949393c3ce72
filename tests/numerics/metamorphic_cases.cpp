// Changes of the input that must not change one bit of the output: scaling by powers of two,
// translation by dyadic numbers, mirroring, permuting the axes (G02, R17). Closed ends of the
// interval for every shape (G09).
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "backend/geometry/box.hpp"
#include "backend/geometry/cylinder.hpp"
#include "backend/geometry/disk.hpp"
#include "backend/geometry/plane.hpp"
#include "backend/geometry/quad.hpp"
#include "backend/geometry/revolve.hpp"
#include "backend/geometry/sphere.hpp"
#include "backend/geometry/triangle.hpp"
#include "tests/numerics/finding.hpp"
#include "tests/unit/backend/geometry/random_rays.hpp"

namespace scenec::numerics {
namespace {

using namespace backend;
using backend::testing_support::Draw;

// Coordinate i of the image: sign[i] * scale * source[from[i]] + shift[i].
struct Change {
  std::array<int, 3> from{0, 1, 2};
  std::array<double, 3> sign{1, 1, 1};
  double scale = 1;
  Vector3 shift{};

  [[nodiscard]] Vector3 direction(const Vector3& v) const {
    return {sign[0] * component(v, from[0]), sign[1] * component(v, from[1]),
            sign[2] * component(v, from[2])};
  }
  [[nodiscard]] Vector3 vector(const Vector3& v) const { return scale * direction(v); }
  [[nodiscard]] Point3 point(const Point3& p) const {
    return as_point(vector(as_vector(p)) + shift);
  }
};

Sphere changed(const Sphere& s, const Change& c) {
  return {c.point(s.center), c.scale * s.radius};
}
Plane changed(const Plane& p, const Change& c) {
  const Vector3 n = c.direction(as_vector(p.normal));
  return {as_normal(n), c.scale * p.offset + dot(n, c.shift)};
}
Triangle changed(const Triangle& t, const Change& c) {
  return {c.point(t.a), c.point(t.b), c.point(t.c)};
}
Quad changed(const Quad& q, const Change& c) {
  return {c.point(q.corner), c.vector(q.edge_u), c.vector(q.edge_v)};
}
Disk changed(const Disk& d, const Change& c) {
  return {c.point(d.center), UnitVector3::assume_unit(c.direction(d.normal)), c.scale * d.radius};
}
Box changed(const Box& b, const Change& c) {
  Bounds3 out;
  out.grow(c.point(b.min));
  out.grow(c.point(b.max));
  return {out.min, out.max};
}
Cylinder changed(const Cylinder& source, const Change& c) {
  // Scaling and translation only: the frame about another axis is another frame.
  Cylinder out = source;
  out.base = c.point(source.base);
  out.height = c.scale * source.height;
  out.radius = c.scale * source.radius;
  return out;
}
Revolve changed(const Revolve& source, const Change& c) {
  Profile profile = source.profile();
  for (ProfilePoint& p : profile.points) p = {c.scale * p.radius, c.sign[1] * c.scale * p.height};
  return Revolve(profile);
}

// How coordinates are drawn: any double, or so few bits that the sums of the test itself are exact.
enum class Grid : std::uint8_t { any, dyadic, coarse };

class Maker {
 public:
  Maker(Draw& draw, Grid grid) : draw_(draw), grid_(grid) {}
  double number(double size) {
    const double v = draw_.between(-size, size);
    if (grid_ == Grid::any) return v;
    const double steps = grid_ == Grid::dyadic ? 1024 : 16;
    return std::floor(v * steps) / steps;
  }
  double positive(double size) { return std::fabs(number(size)) + 0.25; }
  Point3 point(double size) { return {number(size), number(size), number(size)}; }
  Vector3 vector(double size) { return as_vector(point(size)); }
  UnitVector3 unit() {
    // Exactly unit on a grid, so that its bits are few too.
    if (grid_ == Grid::any) return draw_.direction();
    const std::array<Vector3, 4> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, -1}, {0, -1, 0}}};
    return UnitVector3::assume_unit(axes[static_cast<std::size_t>(draw_.unit() * 4)]);
  }

 private:
  Draw& draw_;
  Grid grid_;
};

void make(Maker& m, Sphere& s) {
  s = {m.point(4), m.positive(3)};
}
void make(Maker& m, Plane& p) {
  p = {as_normal(m.vector(2)), m.number(3)};
}
void make(Maker& m, Triangle& t) {
  t = {m.point(3), m.point(3), m.point(3)};
}
void make(Maker& m, Quad& q) {
  q = {m.point(3), m.vector(3), m.vector(3)};
}
void make(Maker& m, Disk& d) {
  d = {m.point(2), m.unit(), m.positive(3)};
}
void make(Maker& m, Box& b) {
  Bounds3 box;
  box.grow(m.point(3));
  box.grow(m.point(3));
  b = {box.min, box.max};
}
void make(Maker& m, Cylinder& c) {
  const Point3 base = m.point(3);
  c = Cylinder(base, base + m.unit().vector() * m.positive(3), m.positive(2), m.number(1) > 0);
}
void make(Maker& m, Revolve& r) {
  const std::array<ProfilePoint, 4> p{{{m.positive(1), 0},
                                       {m.positive(2), m.positive(1)},
                                       {m.number(1), m.positive(2)},
                                       {m.positive(1), 2}}};
  r = Revolve(bezier_profile(p));
}

struct Tally {
  std::uint64_t rays = 0;
  std::uint64_t hits = 0;
  std::uint64_t different = 0;
};

template <class Shape>
Tally compare(Grid grid, const std::vector<Change>& changes, std::uint64_t seed) {
  constexpr std::uint64_t shapes = 10'000;
  constexpr int rays_each = 10;
  Draw draw(seed);
  Maker maker(draw, grid);
  Tally tally;
  for (std::uint64_t i = 0; i < shapes; ++i) {
    Shape shape;
    make(maker, shape);
    const Change& change = changes[i % changes.size()];
    const Shape other = changed(shape, change);
    for (int k = 0; k < rays_each; ++k) {
      const Point3 origin = maker.point(6);
      const Ray ray{origin, k % 2 == 0 ? maker.point(2) - origin : maker.vector(1)};
      if (ray.direction == Vector3{0, 0, 0}) continue;
      const Ray ray2{change.point(ray.origin), change.direction(ray.direction)};
      ShapeHit a;
      ShapeHit b;
      const bool got = intersect(shape, ray, a);
      const bool got2 = intersect(other, ray2, b);
      ++tally.rays;
      if (got) ++tally.hits;
      if (got != got2 || (got && b.t != change.scale * a.t)) ++tally.different;
    }
  }
  return tally;
}

std::vector<Change> scalings() {
  std::vector<Change> out;
  for (const int k : {-40, -20, -1, 7, 20, 40}) out.push_back({.scale = std::ldexp(1.0, k)});
  return out;
}
std::vector<Change> translations() {
  return {{.shift = {0x1p20, 0, 0}}, {.shift = {0x1p20, -0x1p20, 0x1p20}}};
}
std::vector<Change> mirrors() {
  return {{.sign = {-1, 1, 1}}, {.sign = {1, -1, 1}}, {.sign = {-1, -1, -1}}};
}
std::vector<Change> permutations() {
  return {{.from = {1, 2, 0}}, {.from = {2, 0, 1}}, {.from = {1, 0, 2}}, {.from = {0, 2, 1}}};
}

enum class Kind : std::uint8_t { scaled, translated, mirrored, permuted };

struct Metamorphosis {
  const char* shape;
  Kind kind;
  Tally (*run)();
};

constexpr std::array<const char*, 4> kind_names{"scaled by 2^k, k = ±1..±40", "moved by 2^20",
                                                "mirrored", "axes permuted"};

template <class Shape, Grid grid>
Tally scaled() {
  return compare<Shape>(grid, scalings(), 1);
}
template <class Shape, Grid grid>
Tally translated() {
  return compare<Shape>(grid, translations(), 2);
}
template <class Shape, Grid grid>
Tally mirrored() {
  return compare<Shape>(grid, mirrors(), 3);
}
template <class Shape, Grid grid>
Tally permuted() {
  return compare<Shape>(grid, permutations(), 4);
}
Tally mirrored_revolve() {
  return compare<Revolve>(Grid::any,
                          {{.sign = {-1, 1, 1}}, {.sign = {1, 1, -1}}, {.sign = {1, -1, 1}}}, 5);
}
Tally swapped_revolve() {
  return compare<Revolve>(Grid::any, {{.from = {2, 1, 0}}}, 6);
}

class G02Metamorphic : public testing::TestWithParam<Metamorphosis> {};
TEST_P(G02Metamorphic, KeepsEveryBit) {
  const Metamorphosis& m = GetParam();
  const Tally tally = m.run();
  EXPECT_EQ(tally.different, 0U);
  EXPECT_GT(tally.hits, tally.rays / 40);
  record({"G02", fmt::format("{}, {}", m.shape, kind_names[static_cast<std::size_t>(m.kind)]),
          tally.rays, fmt::format("{} different of {} hits", tally.different, tally.hits), ""});
}
INSTANTIATE_TEST_SUITE_P(
    G02, G02Metamorphic,
    testing::Values(Metamorphosis{"sphere", Kind::scaled, scaled<Sphere, Grid::any>},
                    Metamorphosis{"sphere", Kind::translated, translated<Sphere, Grid::dyadic>},
                    Metamorphosis{"sphere", Kind::mirrored, mirrored<Sphere, Grid::any>},
                    Metamorphosis{"plane", Kind::scaled, scaled<Plane, Grid::any>},
                    Metamorphosis{"plane", Kind::translated, translated<Plane, Grid::coarse>},
                    Metamorphosis{"plane", Kind::mirrored, mirrored<Plane, Grid::any>},
                    Metamorphosis{"plane", Kind::permuted, permuted<Plane, Grid::coarse>},
                    Metamorphosis{"triangle", Kind::scaled, scaled<Triangle, Grid::any>},
                    Metamorphosis{"triangle", Kind::translated, translated<Triangle, Grid::dyadic>},
                    Metamorphosis{"triangle", Kind::mirrored, mirrored<Triangle, Grid::any>},
                    Metamorphosis{"triangle", Kind::permuted, permuted<Triangle, Grid::any>},
                    Metamorphosis{"quad", Kind::scaled, scaled<Quad, Grid::any>},
                    Metamorphosis{"quad", Kind::translated, translated<Quad, Grid::dyadic>},
                    Metamorphosis{"quad", Kind::mirrored, mirrored<Quad, Grid::any>},
                    Metamorphosis{"quad", Kind::permuted, permuted<Quad, Grid::coarse>},
                    Metamorphosis{"disk", Kind::scaled, scaled<Disk, Grid::any>},
                    Metamorphosis{"disk", Kind::translated, translated<Disk, Grid::dyadic>},
                    Metamorphosis{"disk", Kind::mirrored, mirrored<Disk, Grid::any>},
                    Metamorphosis{"box", Kind::scaled, scaled<Box, Grid::any>},
                    Metamorphosis{"box", Kind::translated, translated<Box, Grid::dyadic>},
                    Metamorphosis{"box", Kind::mirrored, mirrored<Box, Grid::any>},
                    Metamorphosis{"box", Kind::permuted, permuted<Box, Grid::any>},
                    Metamorphosis{"cylinder", Kind::scaled, scaled<Cylinder, Grid::any>},
                    Metamorphosis{"cylinder", Kind::translated, translated<Cylinder, Grid::dyadic>},
                    Metamorphosis{"revolve", Kind::scaled, scaled<Revolve, Grid::any>},
                    Metamorphosis{"revolve", Kind::mirrored, mirrored_revolve},
                    Metamorphosis{"revolve", Kind::permuted, swapped_revolve}));

TEST(R17, RevolveScalesByPowersOfTwo) {
  const Tally tally = compare<Revolve>(Grid::any, {{.scale = 0x1p-20}, {.scale = 0x1p20}}, 17);
  EXPECT_EQ(tally.different, 0U);
  record({"R17", "2^±20", tally.rays,
          fmt::format("{} different of {} hits", tally.different, tally.hits), ""});
}

struct Interval {
  const char* shape;
  Tally (*run)();
};

// A hit at t is found by every interval that has t as an end, and by none that ends just before.
template <class Shape>
Tally closed_ends() {
  Draw draw(9);
  Maker maker(draw, Grid::any);
  Tally tally;
  for (int i = 0; i < 10'000; ++i) {
    Shape shape;
    make(maker, shape);
    for (int k = 0; k < 10; ++k) {
      const Point3 origin = maker.point(6);
      const Ray ray{origin, k % 2 == 0 ? maker.point(2) - origin : maker.vector(1)};
      ShapeHit hit;
      ++tally.rays;
      if (!intersect(shape, ray, hit)) continue;
      ++tally.hits;
      const double t = hit.t;
      const auto finds = [&](double low, double high) {
        return intersect(shape, Ray{ray.origin, ray.direction, low, high}, hit);
      };
      const bool right = finds(0, t) && hit.t == t && finds(t, t) && hit.t == t &&
                         !finds(0, next_down(t)) && (!finds(next_up(t), 1e300) || hit.t > t);
      if (!right) ++tally.different;
    }
  }
  return tally;
}

class G09Interval : public testing::TestWithParam<Interval> {};
TEST_P(G09Interval, IsClosed) {
  const Tally tally = GetParam().run();
  EXPECT_EQ(tally.different, 0U);
  record({"G09", GetParam().shape, tally.hits, fmt::format("{} wrong", tally.different), ""});
}
INSTANTIATE_TEST_SUITE_P(
    G09, G09Interval,
    testing::Values(Interval{"sphere", closed_ends<Sphere>}, Interval{"plane", closed_ends<Plane>},
                    Interval{"triangle", closed_ends<Triangle>},
                    Interval{"quad", closed_ends<Quad>}, Interval{"disk", closed_ends<Disk>},
                    Interval{"box", closed_ends<Box>}, Interval{"cylinder", closed_ends<Cylinder>},
                    Interval{"revolve", closed_ends<Revolve>}));

}  // namespace
}  // namespace scenec::numerics
