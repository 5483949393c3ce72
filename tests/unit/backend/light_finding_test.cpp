// Aiming at lights, meeting them by chance, and both weighed together have one mean (X01). Each
// picture is rendered from independent seeds; the means of its tiles are compared by Welch's test,
// 0.01 for all tiles of all scenes together (Sidak).
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "backend/render_scene.hpp"
#include "tests/unit/backend/scene_kit.hpp"

namespace scenec::backend::test {
namespace {

constexpr int tiles = 4;  // an axis
constexpr int seeds = 12;

struct Moments {
  double mean = 0;
  double variance_of_mean = 0;
};

std::vector<Moments> tile_moments(Ready& ready, int first_seed) {
  std::vector<double> sum(tiles * tiles);
  std::vector<double> square(tiles * tiles);
  for (int seed = 0; seed < seeds; ++seed) {
    ready.scene.render.seed = first_seed + seed;
    const Picture picture = ready.render();
    const int side = picture.width / tiles;
    for (int t = 0; t < tiles * tiles; ++t) {
      double mean = 0;
      for (int k = 0; k < side * side; ++k)
        mean +=
            luminance(pixel(picture, t % tiles * side + k % side, t / tiles * side + k / side)) /
            (side * side);
      sum[static_cast<std::size_t>(t)] += mean / seeds;
      square[static_cast<std::size_t>(t)] += mean * mean / seeds;
    }
  }
  std::vector<Moments> out;
  for (std::size_t t = 0; t < sum.size(); ++t)
    out.push_back({sum[t], std::fmax(0, square[t] - sum[t] * sum[t]) / (seeds - 1)});
  return out;
}

std::vector<Moments> tile_moments(Ready& ready, LightFinding finding) {
  ready.built->lights.finding = finding;
  return tile_moments(ready, 100 * static_cast<int>(finding));
}

void expect_same_means(const std::vector<Moments>& a, const std::vector<Moments>& b, double level,
                       const std::string& what) {
  for (std::size_t t = 0; t < a.size(); ++t) {
    const double spread = std::sqrt(a[t].variance_of_mean + b[t].variance_of_mean);
    if (!(spread > 0)) {
      EXPECT_EQ(a[t].mean, b[t].mean);
      continue;
    }
    // With 22 degrees of freedom Student's tail is fatter than the normal one: z is shrunk as by
    // Wallace 1959.
    const double x = std::fabs(a[t].mean - b[t].mean) / spread;
    const double freedom = 2 * seeds - 2;
    const double z = std::sqrt(freedom * std::log1p(x * x / freedom)) * (1 - 3 / (4 * freedom));
    EXPECT_GT(std::erfc(z / std::sqrt(2.0)), level)
        << what << " tile " << t << ": " << a[t].mean << " and " << b[t].mean;
  }
}

ir::Quad floor_quad() {
  return {{-4, 0, 4}, {8, 0, 0}, {0, 0, -8}};
}

void finish_scene(SceneKit& kit) {
  kit.pinhole({0, 2, 4}, {0, 0.4, 0}, 50);
  kit.settings.sampler = ir::SamplerKind::independent;
  kit.settings.samples = 64;
}

using Make = std::function<void(SceneKit&)>;

std::vector<Make> scenes() {
  const auto ball = [](SceneKit& kit, ir::MaterialId m) {
    kit.place(ir::Sphere{{0, 0.8, 0}, {0.8}}, m);
  };
  const auto lamp = [](double radius) {
    return ir::SphereLight{{1.5, 2.5, 1}, {radius}, 5.0, {}, true, ir::white};
  };
  const auto ggx = [](SceneKit& kit, double roughness) {
    return kit.material(ir::Ggx{{{0.6, 0.3, 0.2}, {}}, {{0.04, 0.04, 0.04}, {}}, {roughness, {}}});
  };
  return {
      [=](SceneKit& kit) {  // matt under a lamp
        ball(kit, kit.matt(0.7));
        kit.light(lamp(0.7));
      },
      [=](SceneKit& kit) {  // coated, two lamps of different size: a choice of lights
        ball(kit, ggx(kit, 0.4));
        kit.light(lamp(0.6));
        kit.light(ir::QuadLight{{-2, 3, -1}, {2, 0, 0}, {0, 0, 2}, 2.0, {}, true, ir::white});
      },
      [=](SceneKit& kit) {  // rough metal and an emissive item beside it
        ir::Conductor metal;
        metal.preset = ir::ConductorPreset::gold;
        metal.roughness.value = 0.5;
        ball(kit, kit.material(metal));
        kit.place(ir::Sphere{{-1.6, 1, 0.6}, {0.5}}, kit.glowing(4));
      },
      [=](SceneKit& kit) {  // rough glass before a lamp
        ir::Dielectric glass;
        glass.roughness.value = 0.6;
        ball(kit, kit.material(glass));
        kit.light(lamp(0.8));
      },
      [=](SceneKit& kit) {  // many lamps
        ball(kit, kit.matt(0.5));
        for (int i = 0; i < 20; ++i)
          kit.light(ir::SphereLight{{-2 + 0.2 * i, 1.8 + 0.1 * (i % 3), -1.0 + 0.13 * i},
                                    {0.15},
                                    4.0 + i,
                                    {},
                                    true,
                                    ir::white});
      },
      [=](SceneKit& kit) {  // a ball of which a wall hides all but a cap
        ball(kit, kit.matt(0.8));
        kit.place(ir::Plane{{0, -1, 0}, {-2.5}}, kit.matt(0.5));
        kit.place(ir::Sphere{{0.5, 12.3, 0}, {10}}, kit.glowing(6));
      },
      [=](SceneKit& kit) {  // a disk close to the floor, light between surfaces
        ball(kit, kit.matt(0.9));
        kit.light(ir::DiskLight{{1.2, 0.7, 1}, {-0.3, -1, 0}, {0.5}, 3.0, {}, true, ir::white});
      },
  };
}

TEST(LightFinding, EveryWayHasTheSameMean) {
  const std::vector<Make> all = scenes();
  const double trials = static_cast<double>(all.size()) * 2 * tiles * tiles;
  const double level = 1 - std::pow(1 - 0.01, 1 / trials);
  for (std::size_t number = 0; number < all.size(); ++number) {
    SceneKit kit;
    kit.place(floor_quad(), kit.matt(0.6));
    all[number](kit);
    finish_scene(kit);
    Ready ready(kit.finish());
    const auto both = tile_moments(ready, LightFinding::both);
    for (const LightFinding one : {LightFinding::aiming, LightFinding::chance}) {
      const auto other = tile_moments(ready, one);
      expect_same_means(
          both, other, level,
          "scene " + std::to_string(number) + " way " + std::to_string(static_cast<int>(one)));
    }
  }
}

// How many bounces are sure costs time and noise, no light.
TEST(Roulette, HasNoInfluenceOnTheMean) {
  const double level = 1 - std::pow(1 - 0.01, 1.0 / (2 * tiles * tiles));
  SceneKit kit;
  kit.place(floor_quad(), kit.matt(0.8));
  kit.place(ir::Sphere{{0, 0.8, 0}, {0.8}}, kit.matt(0.9));
  kit.light(ir::SphereLight{{1.5, 2.5, 1}, {0.7}, 5.0, {}, true, ir::white});
  finish_scene(kit);
  kit.settings.max_depth = 8;
  Ready ready(kit.finish());
  const auto usual = tile_moments(ready, 1000);
  for (const std::uint32_t sure : {0U, 1000U}) {
    ready.built->sure_bounces = sure;
    expect_same_means(usual, tile_moments(ready, 2000 + static_cast<int>(sure)), level,
                      "sure bounces: " + std::to_string(sure));
  }
}

}  // namespace
}  // namespace scenec::backend::test
