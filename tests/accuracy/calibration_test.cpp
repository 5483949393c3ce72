// Whether the 95 % band of an error estimate holds the true error 95 times in 100, and whether
// `stop { error }` ends where it says. The true error of one render is measured against the mean of
// all the others of its scene, which have many times its samples; their own variance is subtracted.
// Seeds are 1, 2, 3, ...: what is printed can be repeated.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "backend/render_session.hpp"
#include "tests/accuracy/true_error.hpp"
#include "tests/support/built_scene.hpp"
#include "tests/support/paths.hpp"

namespace scenec {
namespace {

using test::Reference;
using test::true_error;
using test::TrueError;

namespace fs = std::filesystem;

constexpr std::int64_t side = 64;

struct Scene {
  std::string name;
  std::optional<test::BuiltScene> built;
  ir::RenderSettings settings;
};

Scene scene_of(const char* path, ThreadPool& pool) {
  Scene scene{path, test::build_file(test::source_directory() / path, pool), {}};
  if (scene.built) {
    scene.settings = scene.built->scene->render;
    scene.settings.size = {side, side};
    scene.settings.region.reset();
    scene.settings.aovs.clear();
  }
  return scene;
}

// Scenes whose light is found by all the ways there are.
constexpr const char* scenes[] = {
    "stdlib-scenes/showcase/cornell.sdl",   "stdlib-scenes/showcase/still-life.sdl",
    "stdlib-scenes/examples/buildings.sdl", "stdlib-scenes/examples/colonnade.sdl",
    "stdlib-scenes/examples/colors.sdl",    "stdlib-scenes/examples/daylight.sdl",
    "stdlib-scenes/examples/furniture.sdl", "stdlib-scenes/examples/glasses.sdl",
    "stdlib-scenes/examples/lights.sdl",    "stdlib-scenes/examples/materials.sdl",
    "stdlib-scenes/examples/shapes.sdl",    "stdlib-scenes/examples/vessels.sdl",
};

struct Case {
  backend::Picture picture;
  backend::ErrorEstimate estimate;
};

Case render_case(const Scene& scene, std::int64_t seed, std::int64_t samples, ThreadPool& pool) {
  ir::RenderSettings settings = scene.settings;
  settings.seed = seed;
  backend::RenderSession session(
      *scene.built->render_scene, settings,
      backend::find_effects(*scene.built->render_scene, settings).simulated(), pool);
  session.advance(samples);
  return {session.picture(), session.error()};
}

struct Coverage {
  int cases = 0;
  int inside = 0;
  int below = 0;  // true error below the band: the estimate was too high
  double log_ratio = 0;
  double mean = 0;  // true error
  void add(double error, const backend::ErrorBand& band) {
    ++cases;
    inside += error >= band.low && error <= band.high ? 1 : 0;
    below += error < band.low ? 1 : 0;
    log_ratio += std::log(band.value / error);
  }
  [[nodiscard]] double part() const { return static_cast<double>(inside) / cases; }
};

// Where `stop { error }` ends against what it was asked for.
struct Stops {
  int cases = 0;
  int kept = 0;     // true error within [0.7, 1.15] of what was asked for
  int too_few = 0;  // samples below the floor
};

Stops stops_of(const Scene& scene, const Reference& reference, double error, int seeds,
               ThreadPool& pool) {
  Stops stops;
  double sum = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    ir::RenderSettings settings = scene.settings;
    settings.seed = 1000 + seed;  // none of the reference's
    settings.samples.reset();
    settings.stop = {};
    settings.stop.error = error;
    settings.stop.samples = 4096;
    const backend::Picture picture =
        backend::render(*scene.built->render_scene, settings, pool, {}, {});
    const double truth = true_error(picture.rgb, reference, false).error;
    ++stops.cases;
    stops.kept += truth >= 0.7 * error && truth <= 1.15 * error ? 1 : 0;
    stops.too_few += picture.samples < 64 ? 1 : 0;
    sum += truth / seeds;
  }
  std::printf("    stop at %.3f %%: true error %.3f %% on average, kept %d of %d\n", 100 * error,
              100 * sum, stops.kept, stops.cases);
  std::fflush(stdout);
  return stops;
}

Coverage coverage_of(const Scene& scene, int seeds, std::int64_t samples, ThreadPool& pool,
                     Reference& reference) {
  std::vector<Case> cases;
  for (int seed = 1; seed <= seeds; ++seed) {
    cases.push_back(render_case(scene, seed, samples, pool));
    reference.add(cases.back().picture.rgb);
  }
  Coverage coverage;
  double width = 0;
  for (const Case& c : cases) {
    const TrueError truth = true_error(c.picture.rgb, reference, true);
    coverage.add(truth.error, c.estimate.relative);
    coverage.mean += truth.error / seeds;
    width += (c.estimate.relative.high - c.estimate.relative.low) / 2 / seeds;
  }
  std::printf(
      "%-40s %5lld spp  error %7.3f %%  band +-%6.3f %%  estimate/true %.4f  inside %3d "
      "below %3d above %3d of %d\n",
      scene.name.c_str(), static_cast<long long>(samples), 100 * coverage.mean, 100 * width,
      std::exp(coverage.log_ratio / coverage.cases), coverage.inside, coverage.below,
      coverage.cases - coverage.inside - coverage.below, coverage.cases);
  std::fflush(stdout);
  return coverage;
}

void expect_coverage(int seeds, std::int64_t samples, int stop_seeds) {
  ThreadPool pool;
  Coverage all;
  Stops stops;
  for (const char* const path : scenes) {
    const Scene scene = scene_of(path, pool);
    ASSERT_TRUE(scene.built) << path;
    Reference reference;
    const Coverage one = coverage_of(scene, seeds, samples, pool, reference);
    all.cases += one.cases;
    all.inside += one.inside;
    all.below += one.below;
    // What some 130 samples reach.
    const Stops held = stops_of(scene, reference, 0.7 * one.mean, stop_seeds, pool);
    stops.cases += held.cases;
    stops.kept += held.kept;
    stops.too_few += held.too_few;
  }
  std::printf("%lld spp: inside %d below %d of %d: %.2f %%\n", static_cast<long long>(samples),
              all.inside, all.below, all.cases, 100 * all.part());
  std::printf("stops kept %d of %d\n", stops.kept, stops.cases);
  // Of all scenes together; docs/accuracy.md says which hold less.
  EXPECT_GE(all.part(), 0.93);
  EXPECT_LE(all.part(), 0.97);
  EXPECT_GE(stops.kept, 0.95 * stops.cases);
  EXPECT_EQ(stops.too_few, 0);
}

TEST(Calibration, BandHoldsTheTrueErrorInShort) {
  ThreadPool pool;
  const Scene scene = scene_of("stdlib-scenes/showcase/cornell.sdl", pool);
  ASSERT_TRUE(scene.built);
  Reference reference;
  const Coverage coverage = coverage_of(scene, 24, 32, pool, reference);
  // 95 % of 24; fewer than 17 is a chance of 1 in 100,000. The seeds are fixed.
  EXPECT_GE(coverage.inside, 17);
}

TEST(Calibration, SlowBandHoldsTheTrueErrorAndStopsKeepTheirWord) {
  expect_coverage(100, 64, 20);
}

}  // namespace
}  // namespace scenec
