// Clear bodies in each other against stacks of layers (S15): a liquid that reaches a little into
// its glass, one that fits exactly, and one with a gap of air.
#include <vector>

#include "tests/unit/backend/scene_kit.hpp"

namespace scenec::backend::test {
namespace {

struct Layer {
  double reflectance;
  double transmittance;
};

// Two stacks behind each other, light between them reflected back and forth without end.
Layer behind(const Layer& a, const Layer& b) {
  const double between = 1 / (1 - a.reflectance * b.reflectance);
  return {a.reflectance + a.transmittance * a.transmittance * b.reflectance * between,
          a.transmittance * b.transmittance * between};
}

// Straight through interfaces between media of these indices.
double transmittance_of(const std::vector<double>& indices) {
  Layer stack{0, 1};
  for (std::size_t i = 0; i + 1 < indices.size(); ++i) {
    const double r = (indices[i] - indices[i + 1]) / (indices[i] + indices[i + 1]);
    stack = behind(stack, {r * r, 1 - r * r});
  }
  return stack.transmittance;
}

// A lamp seen through glass that holds a liquid; `reach`: how far the liquid goes into the glass.
double seen_through(double reach, ir::Method method) {
  SceneKit kit;
  ir::Dielectric glass;
  glass.ior = 1.5;
  ir::Dielectric water;
  water.ior = 1.33;
  const ir::MaterialId glass_id = kit.material(glass);
  const ir::MaterialId water_id = kit.material(water);
  kit.place(ir::Quad{{-1, 0, 1}, {2, 0, 0}, {0, 0, -2}}, kit.glowing(1));
  // Two panes and the liquid between them.
  kit.place(ir::Box{{-1, 1, -1}, {1, 1.1, 1}}, glass_id);
  kit.place(ir::Box{{-1, 1.3, -1}, {1, 1.4, 1}}, glass_id);
  kit.place(ir::Box{{-0.9, 1.1 - reach, -0.9}, {0.9, 1.3 + reach, 0.9}}, water_id);
  kit.settings.size = {1, 1};
  kit.pinhole({0, 2, 0}, {0, 0, 0}, 0.01, {0, 0, -1});
  kit.settings.method = method;
  kit.settings.samples = 16384;
  return mean(render(kit)).r;
}

TEST(NestedMedia, LiquidInGlassIsAStackOfLayers) {
  const double fitting = transmittance_of({1, 1.5, 1.33, 1.5, 1});
  const double with_gaps = transmittance_of({1, 1.5, 1, 1.33, 1, 1.5, 1});
  ASSERT_GT(fitting, with_gaps + 0.02);
  for (const ir::Method method : {ir::Method::path, ir::Method::whitted}) {
    EXPECT_NEAR(seen_through(1e-6, method), fitting, 0.005);
    EXPECT_NEAR(seen_through(0.05, method), fitting, 0.005);
    EXPECT_NEAR(seen_through(-1e-6, method), with_gaps, 0.005);
  }
}

TEST(NestedMedia, BodyOfAirInGlassReflects) {
  SceneKit kit;
  ir::Dielectric glass;
  glass.ior = 1.5;
  ir::Dielectric air;
  air.ior = 1;
  kit.place(ir::Quad{{-1, 0, 1}, {2, 0, 0}, {0, 0, -2}}, kit.glowing(1));
  kit.place(ir::Box{{-1, 1, -1}, {1, 2, 1}}, kit.material(glass));
  kit.place(ir::Box{{-0.9, 1.4, -0.9}, {0.9, 1.6, 0.9}}, kit.material(air));
  kit.settings.size = {1, 1};
  kit.pinhole({0, 3, 0}, {0, 0, 0}, 0.01, {0, 0, -1});
  kit.settings.samples = 16384;
  EXPECT_NEAR(mean(render(kit)).r, transmittance_of({1, 1.5, 1, 1.5, 1}), 0.006);
}

// Foam in glass: its index is that of air, so it is smooth and unseen outside, and rough within.
// The same boundary from the other side is rough glass round a cavity.
TEST(NestedMedia, RoughBodyOfAirInGlassIsRough) {
  const auto seen = [](double roughness) {
    SceneKit kit;
    ir::Dielectric glass;
    glass.ior = 1.5;
    ir::Dielectric air;
    air.ior = 1;
    air.roughness.value = roughness;
    kit.place(ir::Quad{{-0.3, 0, 0.3}, {0.6, 0, 0}, {0, 0, -0.6}}, kit.glowing(1));
    kit.place(ir::Box{{-1, 1, -1}, {1, 2, 1}}, kit.material(glass));
    kit.place(ir::Box{{-0.9, 1.4, -0.9}, {0.9, 1.6, 0.9}}, kit.material(air));
    kit.settings.size = {1, 1};
    kit.pinhole({0, 3, 0}, {0, 0, 0}, 0.01, {0, 0, -1});
    kit.settings.samples = 4096;
    return mean(render(kit)).r;
  };
  const double smooth = seen(0);
  EXPECT_GT(smooth, 0.8);
  // Scattered past the small lamp.
  EXPECT_LT(seen(0.8), 0.7 * smooth);
}

TEST(NestedMedia, MoreThanEightRoundAPlaceAreCounted) {
  SceneKit kit;
  ir::Dielectric glass;
  glass.ior = 1;  // straight through, so every shell is entered
  for (int i = 0; i < 10; ++i)
    kit.place(ir::Sphere{{0, 0, 0}, {2.0 - 0.1 * i}}, kit.material(glass));
  kit.light(ir::PointLight{});
  kit.settings.size = {1, 1};
  kit.pinhole({0, 0, 5}, {0, 0, 0}, 0.01);
  kit.settings.method = ir::Method::whitted;  // no path ends by chance so early
  kit.settings.samples = 4;
  EXPECT_EQ(render(kit).forgotten_media, 2u * 4u);
}

}  // namespace
}  // namespace scenec::backend::test
