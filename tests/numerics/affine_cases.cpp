// Placed by affine maps: G23, G24.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <memory>

#include "backend/accel/scene_accel.hpp"
#include "tests/numerics/finding.hpp"
#include "tests/numerics/meshes.hpp"
#include "tests/numerics/wide.hpp"

namespace scenec::numerics {
namespace {

using namespace backend;
using backend::testing_support::Draw;

struct Matrix {
  V3<Wide> x, y, z;  // rows
  V3<Wide> t;
  [[nodiscard]] V3<Wide> times(const V3<Wide>& v) const {
    return {dot(x, v), dot(y, v), dot(z, v)};
  }
};

Matrix wide_matrix(const Transform& transform) {
  const AffineRows& r = transform.rows();
  const auto row = [&](std::size_t i) { return V3<Wide>{r[i][0], r[i][1], r[i][2]}; };
  return {row(0), row(1), row(2), {r[0][3], r[1][3], r[2][3]}};
}

Matrix inverse_of(const Matrix& m) {
  const V3<Wide> a = cross(m.y, m.z);
  const V3<Wide> b = cross(m.z, m.x);
  const V3<Wide> c = cross(m.x, m.y);
  const Wide d = 1 / dot(m.x, a);
  return {d * V3<Wide>{a.x, b.x, c.x}, d * V3<Wide>{a.y, b.y, c.y}, d * V3<Wide>{a.z, b.z, c.z},
          m.t};
}

// A shear and a scale an axis of 10^U[-spread, spread], every other one mirrored.
Transform affine(Draw& draw, double spread, bool mirrored) {
  const Transform t = draw.affine(spread);
  AffineRows shear{{{1, draw.between(-1, 1), 0, 0}, {0, 1, draw.between(-1, 1), 0}, {0, 0, 1, 0}}};
  if (mirrored) shear[0][0] = -1;
  return t * Transform::from_rows(shear).value();
}

class G23Spread : public testing::TestWithParam<double> {};
TEST_P(G23Spread, EllipsoidsMatchTheirClosedForm) {
  constexpr int shapes = 2'000;
  constexpr int rays_each = 50;
  Draw draw(23);
  ThreadPool pool(1);
  std::uint64_t rays = 0;
  std::uint64_t wrong = 0;
  double t_share = 0;
  double n_share = 0;
  for (int i = 0; i < shapes; ++i) {
    const Transform place = affine(draw, GetParam(), i % 2 == 0);
    const double condition = place.condition();
    const Matrix inverse = inverse_of(wide_matrix(place));
    SceneAccel accel;
    accel.add(0, Sphere{{0, 0, 0}, 1}, accel.add_transform(place));
    accel.build(pool);
    for (int k = 0; k < rays_each; ++k) {
      const Point3 from = place.apply(draw.point(3));
      const Ray ray{from, place.apply(draw.point(0.7)) - from};
      // |M^-1 (o + t d)| = 1.
      const V3<Wide> o = inverse.times(as<Wide>(ray.origin) - inverse.t);
      const V3<Wide> d = inverse.times(as<Wide>(ray.direction));
      const Wide a = dot(d, d);
      const Wide b = -dot(o, d);
      const V3<Wide> nearest = o + (b / a) * d;
      const Wide square = 1 - dot(nearest, nearest);
      if (magnitude(square) < Wide(1e-3) || dot(o, o) < Wide(1.01)) continue;  // tangent, within
      ++rays;
      Hit hit;
      const bool got = accel.intersect(ray, hit);
      const Wide want = square > 0 ? (b - root(a * square)) / a : Wide(-1);
      if (got != (want >= 0)) ++wrong;
      if (!got || want < 0) continue;
      t_share = std::fmax(
          t_share, static_cast<double>(magnitude(Wide(hit.t) - want) / want) / (1e-12 * condition));
      // The normal is a covector: no image of a tangent may have a part along it.
      const V3<Wide> q = o + want * d;
      const V3<Wide> other = cross(q, d);  // tangent at q
      const Matrix m = wide_matrix(place);
      const V3<Wide> image = m.times(other);
      const Wide off = magnitude(dot(as<Wide>(hit.geometric_normal), image)) / length(image);
      n_share = std::fmax(n_share, static_cast<double>(off) / (1e-12 * condition));
      if (dot(hit.geometric_normal, ray.direction) > 0) ++wrong;  // outside stays outside
    }
  }
  EXPECT_EQ(wrong, 0U);
  EXPECT_LE(t_share, 1);
  EXPECT_LE(n_share, 1);
  record({"G23", fmt::format("scales of 10^U[-{0},{0}], shear, half of them mirrored", GetParam()),
          rays,
          fmt::format("{} wrong; t {}, normal {} of the bound", wrong, short_number(t_share),
                      short_number(n_share)),
          ""});
}
INSTANTIATE_TEST_SUITE_P(G23, G23Spread, testing::Values(0.0, 1.0, 4.0));

TEST(G23, MirroredMeshesKeepTheirOutside) {
  constexpr std::uint64_t rays = 100'000;
  ThreadPool pool(1);
  Draw draw(230);
  const auto mesh = std::make_shared<const MeshAccel>(icosphere(3, 0), pool);
  std::uint64_t wrong = 0;
  for (const double sign : {1.0, -1.0}) {
    SceneAccel accel;
    const Transform place = Transform::scaling({sign * 2, 0.5, 1});
    accel.add_mesh(0, mesh, accel.add_transform(place));
    accel.build(pool);
    for (std::uint64_t i = 0; i < rays / 2; ++i) {
      const Point3 from = place.apply(as_point(5 * draw.direction().vector()));
      const Ray ray{from, place.apply(draw.point(0.4)) - from};
      Hit hit;
      if (!accel.intersect(ray, hit) || !(dot(hit.geometric_normal, ray.direction) < 0)) ++wrong;
    }
  }
  EXPECT_EQ(wrong, 0U);
  record(
      {"G23", "mesh, plain and mirrored, from outside", rays, fmt::format("{} wrong", wrong), ""});
}

TEST(G24, NestedRotationsCloseTheCircle) {
  Draw draw(24);
  double worst = 0;
  constexpr int axes = 3'125;
  for (int n = 0; n < axes; ++n) {
    const Frame f = frame_about(draw.direction());
    const double angle = 2 * pi / 32;
    const double c = cos(angle);
    const double s = sin(angle);
    // Rodrigues' formula about f.z.
    AffineRows rows{};
    const std::array<Vector3, 3> unit{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    for (std::size_t j = 0; j < 3; ++j) {
      const Vector3 local = f.local_of(unit[j]);
      const Vector3 image =
          f.world_of(Vector3{c * local.x - s * local.y, s * local.x + c * local.y, local.z});
      for (std::size_t i = 0; i < 3; ++i) rows[i][j] = component(image, static_cast<int>(i));
    }
    const Transform step = Transform::from_rows(rows).value();
    Transform all;
    for (int i = 0; i < 32; ++i) all = all * step;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        worst = std::fmax(worst, std::fabs(all.rows()[i][j] - (i == j ? 1 : 0)));
  }
  EXPECT_LE(worst, 64 * 3 * unit_roundoff);
  record({"G24", "about 3125 random axes, 32 turns each", 32 * axes,
          fmt::format("{} u off the identity", short_number(worst / unit_roundoff)), ""});
}

TEST(G24, NestedRotationsAboutAnAxisCloseTheCircle) {
  double worst = 0;
  const double angle = 2 * pi / 32;
  const Transform step =
      Transform::from_rows(
          {{{cos(angle), -sin(angle), 0, 0}, {sin(angle), cos(angle), 0, 0}, {0, 0, 1, 0}}})
          .value();
  Transform all;
  for (int i = 0; i < 32; ++i) all = all * step;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      worst = std::fmax(worst, std::fabs(all.rows()[i][j] - (i == j ? 1 : 0)));
  EXPECT_LE(worst, 64 * unit_roundoff);
  record({"G24", "about a coordinate axis", 32,
          fmt::format("{} u off the identity", short_number(worst / unit_roundoff)), ""});
}

}  // namespace
}  // namespace scenec::numerics
