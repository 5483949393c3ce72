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

// Smooth spheres that throw light on a matt floor: what is aimed at by way of them.
std::vector<Make> thrown() {
  const auto quad = [](double radiance) {
    return ir::QuadLight{{-0.5, 3, -0.5}, {1, 0, 0}, {0, 0, 1}, radiance, {}, true, ir::white};
  };
  const auto tinted = [](SceneKit& kit) {
    ir::Dielectric glass;
    glass.tint.value = {0.9, 0.7, 0.8};
    glass.absorption = {0.1, 0.4, 0.2};
    return kit.material(glass);
  };
  return {
      [=](SceneKit& kit) {  // a mirror ball on the floor, two lamps of unlike shapes and powers
        kit.place(ir::Sphere{{0, 0.8, 0}, {0.8}}, kit.material(ir::Mirror{}));
        kit.light(quad(3));
        kit.light(ir::SphereLight{{1.5, 1.5, 1}, {0.4}, 5.0, {}, true, ir::white});
      },
      [=](SceneKit& kit) {  // tinted glass, another glass and a gold ball beside it
        kit.place(ir::Sphere{{-0.7, 0.6, 0}, {0.6}}, tinted(kit));
        kit.place(ir::Sphere{{0.6, 0.9, 0.2}, {0.5}}, kit.material(ir::Dielectric{}));
        ir::Conductor gold;
        gold.preset = ir::ConductorPreset::gold;
        gold.roughness.value = 0;
        kit.place(ir::Sphere{{0.2, 0.3, 1.1}, {0.3}}, kit.material(gold));
        kit.light(quad(4));
      },
      [=](SceneKit& kit) {  // matt things in and before the glass, a lamp that is passed unseen
        kit.place(ir::Sphere{{0, 1, 0}, {0.8}}, tinted(kit));
        kit.place(ir::Sphere{{0.2, 1.1, 0.1}, {0.2}}, kit.matt(0.7));
        kit.place(ir::Sphere{{0.5, 0.4, 0.7}, {0.25}}, kit.matt(0.7));
        kit.light(quad(4));
        kit.light(ir::SphereLight{{1.5, 2.5, 1}, {0.5}, 3.0, {}, false, ir::white});
      },
      [=](SceneKit& kit) {  // spheres that overlap, one moved and scaled; an emissive item as lamp
        const ir::MaterialId glass = kit.material(ir::Dielectric{});
        kit.place(ir::Sphere{{-0.3, 0.7, 0}, {0.6}}, glass);
        kit.place(ir::Sphere{{0, 0, 0}, {1}}, glass,
                  kit.transform({0.5, 0, 0, 0.4, 0, 0.5, 0, 0.7, 0, 0, 0.5, 0.1, 0, 0, 0, 1}));
        kit.place(ir::Quad{{-1, 2.5, 1}, {0, 0, -1}, {1.5, 0, 0}}, kit.glowing(4));
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

TEST(LightFinding, LightThrownBySpheresHasTheSameMeanAndLessNoise) {
  const std::vector<Make> all = thrown();
  const double level = 1 - std::pow(1 - 0.01, 1 / static_cast<double>(all.size() * tiles * tiles));
  const auto noise = [](const std::vector<Moments>& moments) {
    double sum = 0;
    for (const Moments& m : moments) sum += m.variance_of_mean;
    return sum;
  };
  double log_ratios = 0;
  for (std::size_t number = 0; number < all.size(); ++number) {
    SceneKit kit;
    kit.place(floor_quad(), kit.matt(0.6));
    all[number](kit);
    finish_scene(kit);
    // The floor beside the spheres, where what they throw is most of the noise.
    kit.pinhole({2.4, 1.6, 2.2}, {0.9, 0, 0.9}, 30);
    kit.settings.samples = 128;
    Ready ready(kit.finish());
    ASSERT_FALSE(ready.built->casters.empty()) << "scene " << number;
    const auto aimed = tile_moments(ready, 0);
    ready.built->casters = {};
    const auto met = tile_moments(ready, 50);
    expect_same_means(aimed, met, level, "thrown, scene " + std::to_string(number));
    const double ratio = noise(met) / noise(aimed);
    std::printf("scene %zu: variance %.1f times where it is met by chance\n", number, ratio);
    log_ratios += std::log(ratio);
  }
  // Over all, as other noise than that of thrown light is in every picture.
  EXPECT_GT(log_ratios / static_cast<double>(all.size()), std::log(1.3));
}

// What a picture is simulated without comes by no other way either.
TEST(LightFinding, NothingIsThrownWithoutTheEffectsThatThrow) {
  for (const ir::Effect left_out :
       {ir::Effect::area_lights, ir::Effect::caustics, ir::Effect::reflection}) {
    SceneKit kit;
    kit.place(floor_quad(), kit.matt(0.6));
    thrown().front()(kit);
    finish_scene(kit);
    Ready ready(kit.finish());
    ThreadPool pool(1);
    ir::EffectSet effects = find_effects(*ready.built, ready.scene.render).simulated();
    effects.remove(left_out);
    const auto picture = [&] {
      return render(*ready.built, ready.scene.render, effects, pool, {}, {});
    };
    ASSERT_FALSE(ready.built->casters.empty());
    const Picture aimed = picture();
    EXPECT_EQ(aimed.effect_runs[static_cast<std::size_t>(left_out)], 0u);
    ready.built->casters = {};
    EXPECT_EQ(aimed.rgb, picture().rgb) << name_of(left_out);
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
