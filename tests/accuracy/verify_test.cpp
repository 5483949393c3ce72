// Whether `verify` lets honest pictures pass and finds out the others. Seeds are 1, 2, 3, ...: what
// is printed can be repeated.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "backend/render_session.hpp"
#include "backend/verification.hpp"
#include "tests/support/built_scene.hpp"
#include "tests/support/paths.hpp"

namespace scenec {
namespace {

using backend::PictureClaim;
using backend::Verification;

struct Scene {
  test::BuiltScene built;
  ir::RenderSettings settings;
  ir::EffectSet effects;
};

std::optional<Scene> scene_of(const std::filesystem::path& path, ThreadPool& pool,
                              ir::ImageSize size) {
  auto built = test::build_file(path, pool);
  if (!built) return std::nullopt;
  ir::RenderSettings settings = built->scene->render;
  settings.size = size;
  settings.region.reset();
  settings.stop = {};
  settings.aovs = {ir::Aov::variance};
  const ir::EffectSet effects = backend::find_effects(*built->render_scene, settings).simulated();
  return Scene{std::move(*built), settings, effects};
}

PictureClaim picture_of(const Scene& scene, std::int64_t seed, std::int64_t samples,
                        ThreadPool& pool) {
  ir::RenderSettings settings = scene.settings;
  settings.seed = seed;
  backend::RenderSession session(*scene.built.render_scene, settings, scene.effects, pool);
  session.advance(samples);
  return {backend::noisy_picture_of(session.picture())};
}

Verification verify(const Scene& scene, const PictureClaim& claim, std::uint64_t seed,
                    ThreadPool& pool) {
  return *backend::verify_picture(*scene.built.render_scene, scene.settings, scene.effects, claim,
                                  pool, {.seed = seed, .progress = {}}, {});
}

void print(const char* name, std::int64_t seed, const Verification& v) {
  std::printf("%-44s seed %3lld  p %9.2e", name, static_cast<long long>(seed), std::exp(v.log_p));
  for (const auto& q : v.questions) std::printf("  %.*s %.1e", 6, q.name.data(), std::exp(q.log_p));
  std::printf("\n");
  std::fflush(stdout);
}

constexpr const char* scenes[] = {
    "stdlib-scenes/showcase/caustic-glass.sdl",  "stdlib-scenes/showcase/cornell.sdl",
    "stdlib-scenes/showcase/depth-of-field.sdl", "stdlib-scenes/showcase/glossy-row.sdl",
    "stdlib-scenes/showcase/leaves.sdl",         "stdlib-scenes/showcase/many-lights.sdl",
    "stdlib-scenes/showcase/still-life.sdl",     "stdlib-scenes/showcase/vases.sdl",
    "stdlib-scenes/showcase/whitted.sdl",        "stdlib-scenes/examples/colonnade.sdl",
};

// Honest pictures, with and without the layer `variance`.
void expect_acceptance(int seeds, std::int64_t samples, ir::ImageSize size) {
  ThreadPool pool;
  int pictures = 0;
  int refused = 0;
  std::vector<double> lowest;
  for (const char* const path : scenes) {
    const auto scene = scene_of(test::source_directory() / path, pool, size);
    ASSERT_TRUE(scene) << path;
    for (int seed = 1; seed <= seeds; ++seed) {
      PictureClaim claim = picture_of(*scene, seed, samples, pool);
      if (seed % 3 == 0) claim.picture.variance.clear();
      const Verification v = verify(*scene, claim, 7777u + static_cast<std::uint64_t>(seed), pool);
      ++pictures;
      refused += v.accepted() ? 0 : 1;
      lowest.push_back(v.log_p);
      EXPECT_TRUE(v.accepted()) << path << " seed " << seed;
      if (!v.accepted() || seed <= 2) print(path, seed, v);
    }
  }
  std::sort(lowest.begin(), lowest.end());
  std::printf("%d pictures, %d refused; lowest p %.1e %.1e %.1e\n", pictures, refused,
              std::exp(lowest[0]), std::exp(lowest[1]), std::exp(lowest[2]));
}

// A scene's text with a word replaced, beside the files it uses.
class ChangedScene {
 public:
  ChangedScene(const char* path, const std::string& from, const std::string& to) {
    const std::filesystem::path source = test::source_directory() / path;
    std::ifstream stream(source);
    std::string text{std::istreambuf_iterator<char>(stream), {}};
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    if (at != std::string::npos) text.replace(at, from.size(), to);
    path_ = std::filesystem::path(testing::TempDir()) / "changed-scene.sdl";
    std::ofstream(path_) << text;
  }
  ~ChangedScene() { std::filesystem::remove(path_); }
  ChangedScene(const ChangedScene&) = delete;
  ChangedScene& operator=(const ChangedScene&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

// The share of pixels that a change moves by more than three times their band, 1.96 standard
// deviations: of the means of several pictures, whose variances are known that much better.
double changed_share(const std::vector<PictureClaim>& a, const std::vector<PictureClaim>& b) {
  const std::size_t values = a[0].picture.rgb.size();
  const auto mean = [](const std::vector<PictureClaim>& all, std::size_t i, auto part) {
    double sum = 0;
    for (const PictureClaim& one : all) sum += static_cast<double>((one.picture.*part)[i]);
    return sum / static_cast<double>(all.size());
  };
  std::size_t changed = 0;
  for (std::size_t i = 0; i < values; i += 3) {
    bool is_changed = false;
    for (std::size_t c = i; c < i + 3; ++c) {
      const double moved =
          mean(a, c, &backend::NoisyPicture::rgb) - mean(b, c, &backend::NoisyPicture::rgb);
      const double band = 1.96 * std::sqrt(mean(b, c, &backend::NoisyPicture::variance));
      is_changed = is_changed || std::abs(moved) > 3 * band;
    }
    changed += is_changed ? 1 : 0;
  }
  return 3 * static_cast<double>(changed) / static_cast<double>(values);
}

struct Forgeries {
  int tried = 0;
  int found = 0;
  double changed = 0;  // share of the pixels
  void add(const char* what, int seed, const Verification& v) {
    ++tried;
    found += v.accepted() ? 0 : 1;
    print(what, seed, v);
  }
};

Forgeries exposures(const char* path, int seeds, std::int64_t samples, ir::ImageSize size) {
  ThreadPool pool;
  Forgeries result;
  const auto scene = scene_of(test::source_directory() / path, pool, size);
  for (int seed = 1; scene && seed <= seeds; ++seed) {
    PictureClaim claim = picture_of(*scene, seed, samples, pool);
    for (float& value : claim.picture.rgb) value *= 1.01f;
    result.add(path, seed, verify(*scene, claim, 99u + static_cast<std::uint64_t>(seed), pool));
  }
  return result;
}

// `has_layer`: the forged file holds the layer `variance` of the picture with fewer samples.
Forgeries sample_counts(const char* path, int seeds, ir::ImageSize size, bool has_layer) {
  ThreadPool pool;
  Forgeries result;
  const auto scene = scene_of(test::source_directory() / path, pool, size);
  for (int seed = 1; scene && seed <= seeds; ++seed) {
    PictureClaim claim = picture_of(*scene, seed, 64, pool);
    claim.picture.samples = 256;
    if (!has_layer) claim.picture.variance.clear();
    result.add(path, seed, verify(*scene, claim, 99u + static_cast<std::uint64_t>(seed), pool));
  }
  return result;
}

Forgeries moved_objects(const char* path, const std::string& from, const std::string& to, int seeds,
                        std::int64_t samples, ir::ImageSize size) {
  ThreadPool pool;
  Forgeries result;
  const ChangedScene changed(path, from, to);
  const auto scene = scene_of(test::source_directory() / path, pool, size);
  const auto other = scene_of(changed.path(), pool, size);
  EXPECT_TRUE(scene && other);
  std::vector<PictureClaim> before;
  std::vector<PictureClaim> after;
  for (int seed = 1; scene && other && seed <= seeds; ++seed) {
    before.push_back(picture_of(*scene, seed, samples, pool));
    after.push_back(picture_of(*other, seed, samples, pool));
  }
  result.changed = changed_share(after, before);
  for (int seed = 1; seed <= seeds; ++seed)
    result.add(path, seed,
               verify(*scene, after[static_cast<std::size_t>(seed - 1)],
                      99u + static_cast<std::uint64_t>(seed), pool));
  return result;
}

constexpr const char* leaves = "stdlib-scenes/showcase/leaves.sdl";
constexpr const char* cornell = "stdlib-scenes/showcase/cornell.sdl";
constexpr const char* still_life = "stdlib-scenes/showcase/still-life.sdl";
constexpr const char* glossy_row = "stdlib-scenes/showcase/glossy-row.sdl";
constexpr const char* vases = "stdlib-scenes/showcase/vases.sdl";

TEST(Verify, TellsHonestPicturesFromOthersInShort) {
  ThreadPool pool;
  const auto scene = scene_of(test::source_directory() / leaves, pool, {48, 36});
  ASSERT_TRUE(scene);
  for (const bool has_layer : {true, false}) {
    PictureClaim claim = picture_of(*scene, 3, 32, pool);
    if (!has_layer) claim.picture.variance.clear();
    EXPECT_TRUE(verify(*scene, claim, 40, pool).accepted());
    for (float& value : claim.picture.rgb) value *= 1.01f;
    EXPECT_FALSE(verify(*scene, claim, 40, pool).accepted());
  }
  EXPECT_EQ(sample_counts(leaves, 1, {48, 36}, true).found, 1);
}

// A thin edge: no block test sees it.
TEST(Verify, FindsASmallMoveInShort) {
  const Forgeries f = moved_objects(cornell, "0.23m", "0.24m", 1, 32, {64, 48});
  EXPECT_EQ(f.found, 1);
}

// Where there is more noise than a percent, only many samples let a percent be seen.
TEST(Verify, SlowOnePercentOfExposureIsFound) {
  for (const char* const path : scenes) {
    const Forgeries f = exposures(path, 1, 1024, {64, 48});
    std::printf("%s: %d of %d found\n", path, f.found, f.tried);
    EXPECT_EQ(f.found, f.tried) << path;
  }
}

TEST(Verify, SlowWrongSampleCountsAreFound) {
  for (const char* const path : scenes) {
    for (const bool has_layer : {true, false}) {
      const Forgeries f = sample_counts(path, 2, {64, 48}, has_layer);
      std::printf("%s %d: %d of %d found\n", path, has_layer, f.found, f.tried);
      EXPECT_EQ(f.found, f.tried) << path;
    }
  }
}

// An object that is a little elsewhere or larger: seen by a thin edge only.
struct Move {
  const char* scene;
  const char* from;
  const char* to;
};
constexpr Move moves[] = {
    {cornell, "0.23m", "0.234m"},
    {cornell, "0.23m", "0.235m"},
    {cornell, "0.23m", "0.24m"},
    {cornell, "0.23m", "0.26m"},
    {still_life, "[-0.1m, 0.04m, 0.24m]", "[-0.11m, 0.04m, 0.24m]"},
    {still_life, "[-0.1m, 0.04m, 0.24m]", "[-0.12m, 0.04m, 0.24m]"},
    {glossy_row, "7cm, 14cm]", "9cm, 14cm]"},
    {glossy_row, "7cm, 14cm]", "7cm, 16cm]"},
    {vases, "[14cm, 0m, 16cm]", "[17cm, 0m, 16cm]"},
    {vases, "[14cm, 0m, 16cm]", "[20cm, 0m, 16cm]"},
};

TEST(Verify, SlowMovedObjectsAreFound) {
  for (const Move& move : moves) {
    const Forgeries f = moved_objects(move.scene, move.from, move.to, 6, 64, {96, 72});
    std::printf("%s %s: %.2f %% of the pixels changed, %d of %d found\n", move.scene, move.to,
                100 * f.changed, f.found, f.tried);
    if (f.changed >= 0.005) {
      EXPECT_EQ(f.found, f.tried) << move.scene << ' ' << move.to;
    }
  }
}

TEST(Verify, SlowHonestPicturesPass) {
  expect_acceptance(12, 64, {64, 48});
}

}  // namespace
}  // namespace scenec
