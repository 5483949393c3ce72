// Every sampler against the density it claims (P01): lobes of materials, visible facets down to
// alpha 0.01, lights as seen from a place, the environment, pixel filters. Fixed seeds; level 0.01
// for all tests of a kind together (Sidak); a failure counts when a second seed confirms it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "backend/accel/scene_accel.hpp"
#include "backend/film/filter.hpp"
#include "backend/lights/emitter.hpp"
#include "backend/lights/environment.hpp"
#include "backend/materials/bsdf.hpp"
#include "backend/materials/matt.hpp"
#include "backend/materials/microfacet.hpp"
#include "tests/unit/backend/chi_square.hpp"

namespace scenec::backend::test {
namespace {

double sidak(int trials) {
  return 1 - std::pow(1 - 0.01, 1.0 / trials);
}

void expect_sound(const ChiSquareCase& c, int trials, const std::string& name) {
  const ChiSquareResult r = confirmed_chi_square(c, sidak(trials));
  EXPECT_GT(r.tail, sidak(trials)) << name;
  // A sample on the very edge may round to where nothing is.
  EXPECT_LE(r.outside, 2) << name;
  EXPECT_LT(r.total_density, 1.005) << name;
}

const GgxAlbedo& table() {
  static const GgxAlbedo albedo;
  return albedo;
}

ChiSquareCase lobe_case(const Bsdf& b) {
  ChiSquareCase c;
  c.sample = [b](Sample2 u, double lobe, Sample2& cell) {
    const BsdfSample s = sample_bsdf(b, lobe, u);
    if (is_black(s.weight)) return false;
    cell = cell_of(s.wi);
    return true;
  };
  c.density = [b](Sample2 cell) { return evaluate(b, direction_at(cell)).pdf * sphere_area; };
  c.rows = 40;
  c.draws = 100000;
  return c;
}

TEST(ChiSquare, LobesOfMaterials) {
  constexpr int trials = 65;
  int done = 0;
  for (const double cosine : {0.95, 0.7, 0.45, 0.2, 0.06}) {
    const auto check = [&](Bsdf b, const std::string& name) {
      b.albedo = &table();
      b.wo = {std::sqrt(1 - cosine * cosine), 0, cosine};
      finish(b);
      ChiSquareCase c = lobe_case(b);
      if (cosine < 0.1) c.steps = 36;  // the lobe is narrow along the horizon
      expect_sound(c, trials, name + " cosine " + std::to_string(cosine));
      ++done;
    };
    Bsdf b;
    b.kind = BsdfKind::diffuse;
    b.diffuse = {0.8, 0.5, 0.2};
    check(b, "diffuse");
    b.kind = BsdfKind::phong;
    b.specular = {0.2, 0.3, 0.1};
    b.exponent = 12;
    check(b, "phong");
    for (const double alpha : {0.2, 0.6, 1.0}) {
      Bsdf f;
      f.alpha = alpha;
      f.specular = {0.9, 0.7, 0.3};
      f.kind = BsdfKind::rough_metal;
      check(f, "metal " + std::to_string(alpha));
      f.kind = BsdfKind::coat;
      f.specular = {0.04, 0.05, 0.06};
      f.diffuse = {0.8, 0.5, 0.2};
      check(f, "coat " + std::to_string(alpha));
      f.kind = BsdfKind::rough_glass;
      f.specular = {1, 1, 1};
      for (const double ior : {1.5, 1 / 1.5}) {
        f.ior = ior;
        if (alpha > 0.5 || ior > 1) check(f, "glass " + std::to_string(alpha));
      }
    }
  }
  EXPECT_LE(done, trials);
}

TEST(ChiSquare, MattSurface) {
  MattSurface s;
  s.albedo = {0.5, 0.5, 0.5};
  s.shading = normalized(Vector3{0.3, -0.2, 0.9});
  s.geometric = s.shading;
  ChiSquareCase c;
  c.sample = [&](Sample2 u, double, Sample2& cell) {
    const BsdfSample sample = sample_bsdf(s, 0, u);
    cell = cell_of(sample.wi);
    return !is_black(sample.weight);
  };
  c.density = [&](Sample2 cell) { return evaluate(s, direction_at(cell)).pdf * sphere_area; };
  c.rows = 40;
  expect_sound(c, 1, "matt");
}

// Cells adapted to the lobe: the facet's slope in units of alpha, folded into the unit square.
TEST(ChiSquare, VisibleFacetsDownToAlphaOfAHundredth) {
  constexpr int trials = 20;
  for (const double cosine : {1.0, 0.8, 0.5, 0.2, 0.05})
    for (const double alpha : {0.01, 0.1, 0.5, 1.0}) {
      const Vector3 wo{std::sqrt(1 - cosine * cosine), 0, cosine};
      ChiSquareCase c;
      c.sample = [=](Sample2 u, double, Sample2& cell) {
        const Vector3 m = sample_ggx_normal(wo, alpha, u);
        if (!(m.z > 0)) return false;
        const double slope = std::sqrt(m.x * m.x + m.y * m.y) / m.z / alpha;
        const double turn = std::atan2(m.y, m.x) / (2 * pi);
        cell = {turn < 0 ? turn + 1 : turn, std::fmin(slope / (1 + slope), 1 - 0x1p-53)};
        return true;
      };
      c.density = [=](Sample2 cell) {
        const double slope = cell.v / (1 - cell.v);
        const double tangent = slope * alpha;
        const double z = 1 / std::sqrt(1 + tangent * tangent);
        const double phi = 2 * pi * cell.u;
        const Vector3 m{z * tangent * std::cos(phi), z * tangent * std::sin(phi), z};
        // d(direction) = sin d(theta) d(phi), and tan(theta) = alpha v / (1 - v).
        const double turn_of_theta = alpha / ((1 - cell.v) * (1 - cell.v)) * z * z;
        return pdf_ggx_normal(wo, m, alpha) * z * tangent * turn_of_theta * 2 * pi;
      };
      expect_sound(c, trials,
                   "alpha " + std::to_string(alpha) + " cosine " + std::to_string(cosine));
    }
}

TEST(ChiSquare, LightsSeenFromAPlace) {
  constexpr int trials = 5;
  ThreadPool pool(1);
  const Point3 from{0.3, -0.4, 0.2};
  const auto check = [&](Emitter e, const auto& shape, const std::string& name,
                         const Plane& wall = {{0, 1, 0}, 50}) {
    measure(e);
    SceneAccel world;
    world.add(0, shape);
    world.add(1, wall);
    world.build(pool);
    ChiSquareCase c;
    c.sample = [&](Sample2 u, double, Sample2& cell) {
      const auto s = sample_emitter(e, from, u);
      if (!s) return false;
      cell = cell_of(s->wi);
      return true;
    };
    c.density = [&](Sample2 cell) {
      Hit hit;
      const Vector3 d = direction_at(cell);
      if (!world.intersect({from, d}, hit) || hit.item != 0) return 0.0;
      return pdf_emitter(e, from, hit.point, hit.geometric_normal) * sphere_area;
    };
    c.columns = 40;
    c.rows = 40;
    c.steps = 40;  // edges of lights cut through cells
    expect_sound(c, trials, name);
  };
  Emitter e;
  e.origin = {0.2, 1.5, -0.6};
  e.radius = 0.7;
  e.shape = EmitterShape::sphere;
  check(e, Sphere{e.origin, e.radius}, "sphere");
  // What a plane leaves of a ball: its cap, all of whose points face this place.
  Emitter cut = e;
  const Plane ceiling{{0, 1, 0}, 0.9};
  cut_by_plane(cut, as_vector(ceiling.normal), ceiling.offset);
  EXPECT_EQ(cut.shape, EmitterShape::cut_sphere);
  check(cut, Sphere{e.origin, e.radius}, "cut sphere", ceiling);
  e.a = {1.5, 0.1, 0.2};
  e.b = {-0.1, 0.4, 1.6};
  e.shape = EmitterShape::parallelogram;
  check(e, Quad{e.origin, e.a, e.b}, "quad");
  e.shape = EmitterShape::triangle;
  check(e, Triangle{e.origin, e.origin + e.a, e.origin + e.b}, "triangle");
  e.shape = EmitterShape::ellipse;
  const UnitVector3 normal = normalized(Vector3{0.2, -1, 0.3});
  const Frame frame = frame_about(normal);
  e.a = frame.x.vector() * 0.9;
  e.b = frame.y.vector() * 0.9;
  check(e, Disk{e.origin, normal, 0.9}, "disk");
}

TEST(ChiSquare, Environment) {
  DecodedImage image;
  image.width = 24;
  image.height = 12;
  image.channels = 1;
  image.encoding = SampleEncoding::linear;
  std::vector<float> samples;
  for (std::uint64_t i = 0; i < 24 * 12; ++i)
    samples.push_back(static_cast<float>(i == 100 ? 40 : 0.2 + random_unit(3, i, 0, 0)));
  image.samples = std::move(samples);
  ir::EnvironmentLight light;
  light.rotation = Angle{0.4};
  const backend::Environment sky(light, std::make_shared<DecodedImage>(std::move(image)));
  ChiSquareCase c;
  c.sample = [&](Sample2 u, double, Sample2& cell) {
    const auto s = sky.sample(u);
    cell = cell_of(s.wi);
    return s.pdf > 0;
  };
  c.density = [&](Sample2 cell) { return sky.pdf(direction_at(cell)) * sphere_area; };
  c.steps = 40;
  c.draws = 100000;
  expect_sound(c, 1, "environment");
}

TEST(ChiSquare, PixelFilters) {
  constexpr int trials = 5;
  for (const ir::FilterKind kind :
       {ir::FilterKind::tent, ir::FilterKind::box, ir::FilterKind::gaussian,
        ir::FilterKind::mitchell, ir::FilterKind::blackman_harris}) {
    ir::PixelFilter filter;
    filter.kind = kind;
    filter.radius = 1.5;
    const FilterSampler sampler(filter);
    double integral = 0;
    constexpr int n = 20000;
    for (int i = 0; i < n; ++i)
      integral += std::fabs(filter_value(filter, (2 * (i + 0.5) / n - 1) * filter.radius)) / n;
    ChiSquareCase c;
    c.sample = [&](Sample2 u, double, Sample2& cell) {
      const FilterSample s = sampler.sample(u);
      const auto share = [&](double d) {
        return std::clamp((d / filter.radius + 1) / 2, 0.0, 1 - 0x1p-53);
      };
      cell = {share(s.dx), share(s.dy)};
      return true;
    };
    c.density = [&](Sample2 cell) {
      const auto f = [&](double x) {
        return std::fabs(filter_value(filter, (2 * x - 1) * filter.radius)) / integral;
      };
      return f(cell.u) * f(cell.v);
    };
    expect_sound(c, trials, "filter " + std::to_string(static_cast<int>(kind)));
  }
}

TEST(ChiSquare, FindsAWrongDensity) {  // the power of the test itself
  ChiSquareCase c;
  c.sample = [](Sample2 u, double, Sample2& cell) {
    cell = cell_of(sample_uniform_hemisphere(u).vector());
    return true;
  };
  // 4 % too much light towards the axis.
  c.density = [](Sample2 cell) {
    const double z = direction_at(cell).z;
    return z > 0 ? (1 + 0.04 * (2 * z - 1)) / (2 * pi) * sphere_area : 0;
  };
  EXPECT_LT(chi_square(c, 1).tail, 1e-4);
}

}  // namespace
}  // namespace scenec::backend::test
