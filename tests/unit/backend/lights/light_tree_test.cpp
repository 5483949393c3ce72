// The choice among many lights: a probability that sums to 1, belongs to what is chosen, is above 0
// for whatever gives light, and brings less noise than choosing by power.
#include "backend/lights/light_tree.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "backend/lights/light_table.hpp"
#include "backend/math/rng.hpp"
#include "backend/math/sampling.hpp"

namespace scenec::backend {
namespace {

double draw(std::uint64_t i, std::uint32_t what) {
  return random_unit(77, i, 0, what);
}
Vector3 direction(std::uint64_t i, std::uint32_t what) {
  return sample_uniform_sphere({draw(i, what), draw(i, what + 1)}).vector();
}

// Points, spots, triangles, spheres; some with two sides, some at one place.
LightTable mixed_lights(std::uint64_t count, LightSelection selection) {
  LightTable table;
  for (std::uint64_t i = 0; i < count; ++i) {
    const Point3 at{4 * draw(i, 0), 4 * draw(i, 1), 4 * draw(i, 2)};
    if (i % 5 < 2) {
      DeltaLight l;
      l.position = i % 25 == 0 ? Point3{1, 1, 1} : at;
      l.value = Rgb::gray(0.01 + draw(i, 3));
      if (i % 5 == 1) {
        l.kind = DeltaLight::Kind::spot;
        l.direction = normalized(direction(i, 4));
        l.cos_full = 0.9;
        l.cos_edge = 0.6;
      }
      table.deltas.push_back(l);
      continue;
    }
    Emitter e;
    e.shape = i % 5 == 2 ? EmitterShape::sphere : EmitterShape::triangle;
    e.origin = at;
    e.a = direction(i, 6) * 0.2;
    e.b = direction(i, 8) * 0.2;
    e.radius = 0.1;
    e.two_sided = i % 2 == 0;
    e.radiance = Rgb::gray(0.1 + draw(i, 10));
    measure(e);
    table.emitters.push_back(e);
  }
  table.finish(4, selection);
  return table;
}

LitPlace place_of(std::uint64_t i) {
  return {{5 * draw(i, 20) - 0.5, 5 * draw(i, 21) - 0.5, 5 * draw(i, 22) - 0.5},
          i % 3 == 0 ? Vector3{0, 0, 0} : direction(i, 23)};
}

// What a place receives of a light, by a few fixed points of it: 0 only where nothing can arrive.
double received(const LightTable& table, std::size_t light, const LitPlace& place) {
  double sum = 0;
  for (int k = 0; k < 4; ++k) {
    LightSample s;
    if (!table.sample(light, place.point, {(k % 2 + 0.5) / 2, (k / 2 + 0.5) / 2}, s)) continue;
    const bool all_round = place.normal == Vector3{0, 0, 0};
    const double cosine = all_round ? 1 : dot(place.normal, s.wi);
    if (cosine > 0) sum += luminance(s.radiance) * cosine / s.pdf / 4;
  }
  return sum;
}

TEST(LightTree, ProbabilitiesSumToAtMostOneAndBelongToWhatIsChosen) {
  const LightTable table = mixed_lights(300, LightSelection::tree);
  double all = 0;
  for (std::uint64_t i = 0; i < 200; ++i) {
    const LitPlace place = place_of(i);
    double sum = 0;
    for (std::size_t light = 0; light < table.size(); ++light)
      sum += table.probability(light, place);
    // A cluster may be chosen in vain, when its bound is above what its parts can give.
    ASSERT_LE(sum, 1 + 1e-12) << i;
    all += sum / 200;
    for (std::uint64_t k = 0; k < 50; ++k) {
      const LightTable::Choice c = table.choose(draw(i, static_cast<std::uint32_t>(30 + k)), place);
      if (!(c.probability > 0)) continue;
      ASSERT_NEAR(c.probability, table.probability(c.light, place), 1e-14);
    }
  }
  EXPECT_GT(all, 0.7);  // a fifth in vain, for surfaces that face anywhere
}

TEST(LightTree, ChoosesAsOftenAsItSays) {
  const LightTable table = mixed_lights(40, LightSelection::tree);
  const LitPlace place{{2, 2, 2}, {0, 1, 0}};
  std::vector<double> share(table.size());
  constexpr int n = 200000;
  for (int k = 0; k < n; ++k) {
    const LightTable::Choice c = table.choose((k + 0.5) / n, place);
    if (c.probability > 0) share[c.light] += 1.0 / n;
  }
  // The numbers are equidistant: each light gets its interval to one of them a level.
  for (std::size_t light = 0; light < table.size(); ++light)
    EXPECT_NEAR(share[light], table.probability(light, place), 20.0 / n) << light;
}

TEST(LightTree, WhateverGivesLightCanBeChosen) {
  const LightTable table = mixed_lights(300, LightSelection::tree);
  int lit = 0;
  for (std::uint64_t i = 0; i < 300; ++i) {
    const LitPlace place = place_of(i);
    for (std::size_t light = 0; light < table.size(); ++light) {
      if (!(received(table, light, place) > 0)) continue;
      ++lit;
      ASSERT_GT(table.probability(light, place), 0) << "light " << light << " place " << i;
    }
  }
  EXPECT_GT(lit, 10000);
}

// The relative variance of one choice, exactly: the sum of c^2 / p over (sum of c)^2, less 1.
double noise_of(const LightTable& table, std::uint64_t places) {
  double sum = 0;
  int count = 0;
  for (std::uint64_t i = 0; i < places; ++i) {
    const LitPlace place = place_of(i);
    double mean = 0;
    double square = 0;
    for (std::size_t light = 0; light < table.size(); ++light) {
      const double c = received(table, light, place);
      if (!(c > 0)) continue;
      mean += c;
      square += c * c / table.probability(light, place);
    }
    if (!(mean > 0)) continue;
    sum += square / (mean * mean) - 1;
    ++count;
  }
  return sum / count;
}

TEST(LightTree, BringsLessNoiseThanChoosingByPower) {
  const double by_power = noise_of(mixed_lights(400, LightSelection::power), 100);
  const double by_tree = noise_of(mixed_lights(400, LightSelection::tree), 100);
  RecordProperty("power", std::to_string(by_power));
  RecordProperty("tree", std::to_string(by_tree));
  EXPECT_LT(4 * by_tree, by_power) << by_power << " and " << by_tree;
}

TEST(LightTree, HoldsAHundredThousandTriangles) {
  const LightTable table = mixed_lights(100000, LightSelection::tree);
  const LitPlace place{{2, 2, 2}, {0, 1, 0}};
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const LightTable::Choice c = table.choose(draw(i, 90), place);
    if (c.probability > 0) {
      ASSERT_NEAR(c.probability, table.probability(c.light, place), 1e-12 * c.probability);
    }
  }
}

TEST(LightTree, LightsAtOnePlaceAndFarLightsAreAllAsked) {
  LightTable table;
  for (int i = 0; i < 100; ++i) {
    DeltaLight l;
    l.position = {1, 2, 3};
    l.value = Rgb::gray(1);
    table.deltas.push_back(l);
  }
  DeltaLight sun;
  sun.kind = DeltaLight::Kind::directional;
  sun.value = Rgb::gray(1);
  table.deltas.push_back(sun);
  table.finish(10);
  const LitPlace place{{0, 0, 0}, {0, 0, 0}};
  for (std::size_t i = 0; i < 100; ++i) EXPECT_NEAR(table.probability(i, place), 0.005, 1e-12);
  EXPECT_EQ(table.probability(100, place), 0.5);
  EXPECT_EQ(table.choose(0.75, place).light, 100u);
  // On the lights themselves every one is as good.
  EXPECT_NEAR(table.probability(3, {{1, 2, 3}, {0, 0, 0}}), 0.005, 1e-12);
}

}  // namespace
}  // namespace scenec::backend
