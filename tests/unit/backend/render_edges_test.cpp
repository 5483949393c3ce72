// Whole renders at the edges: glass by the closed form of each order, absorption without length and
// without end, ten thousand cut-outs in a row, the circle of confusion, the seam of a sphere.
#include <array>
#include <cmath>
#include <vector>

#include "backend/cameras/camera.hpp"
#include "backend/geometry/sphere.hpp"
#include "backend/materials/bsdf.hpp"
#include "backend/math/rng.hpp"
#include "tests/unit/backend/scene_kit.hpp"

namespace scenec::backend::test {
namespace {

constexpr double ior = 1.5;
constexpr double r0 = (ior - 1) * (ior - 1) / ((ior + 1) * (ior + 1));

ir::Quad square(double height, double half) {
  return {{-half, height, half}, {2 * half, 0, 0}, {0, 0, -2 * half}};
}
void look_down(SceneKit& kit, double height) {
  kit.settings.size = {1, 1};
  kit.pinhole({0, height, 0}, {0, 0, 0}, 1e-4, {0, 0, -1});
}

// X04: the ray through the middle of a ball of glass, order by order. Pictures are float, so 1e-7
// stands where the kernels' own error is far smaller.
TEST(RenderEdges, CentralRayThroughAGlassBallHasTheClosedForm) {
  const auto through = [](std::optional<std::int64_t> depth, int samples) {
    SceneKit kit;
    look_down(kit, 5);
    ir::Dielectric glass;
    glass.ior = ior;
    kit.place(ir::Sphere{{0, 2, 0}, {1}}, kit.material(glass));
    kit.place(square(0, 1), kit.glowing(1));
    kit.settings.method = ir::Method::whitted;
    kit.settings.max_depth = depth;
    kit.settings.samples = samples;
    return mean(render(kit)).g;
  };
  EXPECT_NEAR(through(2, 1), (1 - r0) * (1 - r0), 1e-7);
  EXPECT_NEAR(through({}, 16384), (1 - r0) / (1 + r0), 5e-4);
}

// S04: what leaves a slab is parallel to what entered, and shifted as Snell says.
TEST(RenderEdges, RaysLeaveASlabParallel) {
  Bsdf in;
  in.kind = BsdfKind::glass;
  in.specular = {1, 1, 1};
  in.ior = ior;
  for (int i = 0; i < 1000; ++i) {
    const double cosine = (i + 0.5) / 1000;
    in.wo = {std::sqrt(1 - cosine * cosine), 0, cosine};
    const BsdfSample a = sample_bsdf(in, 1 - 0x1p-53, {});
    ASSERT_TRUE(a.transmitted);
    Bsdf out = in;
    out.ior = 1 / ior;
    // From within: the frame turned round its x axis.
    out.wo = {-a.wi.x, 0, -a.wi.z};
    const BsdfSample b = sample_bsdf(out, 1 - 0x1p-53, {});
    ASSERT_TRUE(b.transmitted) << cosine;
    EXPECT_NEAR(b.wi.x, -in.wo.x, 1e-12);
    EXPECT_NEAR(b.wi.z, -in.wo.z, 1e-12);
  }
}

// S05: no way within, and a way after which nothing is left.
TEST(RenderEdges, AbsorptionIsOneWithoutLengthAndNothingInTheEnd) {
  const auto seen = [](double sigma, double thickness) {
    SceneKit kit;
    look_down(kit, 3);
    ir::Dielectric glass;
    glass.ior = 1;
    glass.absorption = {sigma, sigma, sigma};
    kit.place(ir::Box{{-5, 0.5, -5}, {5, 0.5 + thickness, 5}}, kit.material(glass));
    kit.place(square(0, 1), kit.glowing(1));
    return mean(render(kit)).g;
  };
  EXPECT_NEAR(seen(1, 1e-9), 1, 1e-7);
  EXPECT_EQ(seen(1e6, 1), 0);
  EXPECT_NEAR(seen(1e6, 1e-6), std::exp(-1), 1e-6);
}

// P15: no recursion, and what each lets through is multiplied.
TEST(RenderEdges, TenThousandCutOutsInARowLetThroughTheirProduct) {
  const auto seen = [](double opacity, int samples) {
    SceneKit kit;
    ir::MaterialCommon common;
    common.opacity.value = opacity;
    const ir::MaterialId thin = kit.material(ir::Diffuse{{ir::black, {}}}, common);
    for (int i = 0; i < 10000; ++i) kit.place(square(1 + i * 1e-4, 1), thin);
    kit.place(square(0, 1), kit.glowing(1));
    look_down(kit, 5);
    kit.settings.samples = samples;
    return mean(render(kit)).g;
  };
  EXPECT_NEAR(seen(0, 1), 1, 1e-7);
  const double expected = std::exp(10000 * std::log1p(-1e-4));
  EXPECT_NEAR(seen(1e-4, 1024), expected, 4 * std::sqrt(expected * (1 - expected) / 1024));
}

// P15: the texture's own case: three quarters pass.
TEST(RenderEdges, AQuarterOfOpacityLetsThreeQuartersThrough) {
  SceneKit kit;
  ir::MaterialCommon common;
  common.opacity.texture = kit.texture(ir::ConstantTexture{{0.25, 0.25, 0.25}});
  kit.place(square(1, 1), kit.material(ir::Diffuse{{ir::black, {}}}, common));
  kit.place(square(0, 1), kit.glowing(1));
  look_down(kit, 3);
  kit.settings.samples = 8192;
  EXPECT_NEAR(mean(render(kit)).g, 0.75, 4 * std::sqrt(0.75 * 0.25 / 8192));
}

// S12, S13: a triangle whose vertex normals lie 85 degrees off its plane's, or cancel each other,
// lit from the other side, and seen from where its shading normal looks away.
TEST(RenderEdges, NoLightPassesASurfaceWhateverItsVertexNormals) {
  const double tilt = 85 * pi / 180;
  const ir::Direction leaning{std::sin(tilt), std::cos(tilt), 0};
  const ir::Direction up{0, 1, 0};
  const ir::Direction down{0, -1, 0};
  const ir::Direction flat{1, 0, 0};
  const ir::Direction back{-1, 0, 0};
  const std::array<std::array<ir::Direction, 3>, 4> normals{
      {{leaning, leaning, leaning}, {up, down, up}, {flat, back, flat}, {down, down, down}}};
  for (const auto& set : normals)
    for (const double light : {-1.0, 1.0})
      for (const double eye : {-1.0, 0.02}) {
        SceneKit kit;
        ir::Triangle t;
        t.vertices = {ir::Point3{-9, 0, -9}, ir::Point3{-9, 0, 9}, ir::Point3{18, 0, 0}};
        t.normals = set;
        ir::Ggx coat;
        coat.base.value = {0.5, 0.5, 0.5};
        coat.roughness.value = 0.4;
        kit.place(t, kit.material(coat));
        kit.light(ir::PointLight{{0.5, light, 0}, 50.0, {}, ir::Decay::inverse_square, ir::white});
        kit.pinhole({3, eye, 0}, {0, 0, 0}, 5);
        const Picture picture = render(kit);
        EXPECT_EQ(picture.dropped_samples, 0u);
        if (light * eye < 0) {
          EXPECT_EQ(mean(picture).g, 0);
        }
      }
}

// C05: a point at distance z is seen through a lens of radius a focused at f over a disk of
// diameter 2 a |z - f| / f in the plane at z.
TEST(RenderEdges, BlurHasTheDiameterOfTheCircleOfConfusion) {
  constexpr double aperture = 0.2;
  for (const double focus : {0.5, 4.0, 1e6})
    for (const double z : {0.25, 2.0, 8.0}) {
      ir::ThinLens lens;
      lens.eye = {0, 0, 0};
      lens.direction = ir::Direction{0, 0, -1};
      lens.fov = Angle{pi / 3};
      lens.aperture = Length{aperture};
      lens.focus.distance = Length{focus};
      const CameraSampler camera({lens}, {64, 64});
      double low = 1e300;
      double high = -1e300;
      for (int i = 0; i < 65 * 65; ++i) {
        const auto corner = [](int k) { return std::fmin(k / 64.0, 1 - 0x1p-53); };
        const Ray ray = camera.ray(32, 32, {corner(i % 65), corner(i / 65)});
        const double x = ray.at((-z - ray.origin.z) / ray.direction.z).x;
        low = std::fmin(low, x);
        high = std::fmax(high, x);
      }
      const double diameter = 2 * aperture * std::fabs(z - focus) / focus;
      const double pixel_pitch = 2 * z * std::tan(pi / 6) / 64;
      EXPECT_NEAR(high - low, diameter, pixel_pitch) << focus << " " << z;
    }
}

// C09: from a column to the widest picture there is; 0x0 does not pass the front end.
TEST(RenderEdges, OddSizesAreRendered) {
  for (const ir::ImageSize size : {ir::ImageSize{1, 300}, {300, 1}, {65535, 1}, {1, 65535}}) {
    SceneKit kit;
    kit.place(ir::Sphere{{0, 0, 0}, {1}}, kit.glowing(1));
    kit.pinhole({0, 0, 4}, {0, 0, 0}, 20);
    kit.settings.size = size;
    kit.settings.samples = 1;
    const Picture picture = render(kit);
    EXPECT_EQ(picture.width, size.width);
    EXPECT_EQ(picture.height, size.height);
    EXPECT_TRUE(picture.complete);
    EXPECT_EQ(pixel(picture, picture.width / 2, picture.height / 2).g, 1);
  }
}

// T03: points on and just off the surface at the poles and on both sides of the seam.
TEST(RenderEdges, TheSeamAndThePolesOfASphereStayWithinTheTexture) {
  constexpr int width = 1024;
  const Sphere sphere{{0.3, -2, 5}, 1.7};
  int seam = 0;
  for (std::uint64_t i = 0; i < 1000000; ++i) {
    // Half near the seam, half near a pole; the offset from 1e-18 to 1.
    const double offset = std::pow(10, -18 * random_unit(41, i, 0, 0)) * (i % 2 == 0 ? 1 : -1);
    const double across = random_unit(41, i, 0, 1);
    Vector3 n;
    if (i % 4 < 2) {
      const double y = 2 * across - 1;
      const double r = std::sqrt(1 - y * y);
      n = {r * std::cos(offset), y, r * std::sin(offset)};
    } else {
      const double turn = 2 * pi * across;
      n = normalized(Vector3{std::fabs(offset) * std::cos(turn), i % 8 < 4 ? 1.0 : -1.0,
                             std::fabs(offset) * std::sin(turn)})
              .vector();
    }
    const Point3 eye = sphere.center + n * 5;
    ShapeHit hit;
    const Ray ray{eye, -n};
    if (!intersect(sphere, ray, hit)) continue;
    const Surface s = surface(sphere, ray, hit);
    ASSERT_TRUE(s.u >= 0 && s.u <= 1 && s.v >= 0 && s.v <= 1) << s.u << " " << s.v;
    if (i % 4 >= 2 || std::fabs(offset) > 1e-6) continue;
    ++seam;
    // The seam looks along +x. However near, a point is on its own side or the other: never more
    // than two texels from where it belongs, round the sphere.
    const double exact = -offset / (2 * pi);
    const double apart = std::fabs(s.u - exact) * width;
    ASSERT_LE(std::fmin(apart, std::fabs(apart - width)), 2) << offset;
  }
  EXPECT_GT(seam, 100000);
}

}  // namespace
}  // namespace scenec::backend::test
