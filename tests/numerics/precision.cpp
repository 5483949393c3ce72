#include "tests/numerics/precision.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <ctime>
#include <limits>

#include "base/assert.hpp"
#include "tests/support/built_scene.hpp"
#include "tests/support/paths.hpp"

namespace scenec::numerics {
namespace {

using backend::Precision;

enum class Meshes : std::uint8_t { none, some };
struct Subject {
  const char* file;
  const char* name;
  Meshes meshes;  // whether there are any that could differ
};
constexpr std::array subjects{
    Subject{"stdlib-scenes/showcase/still-life.sdl", "still life, no mesh", Meshes::none},
    Subject{"stdlib-scenes/showcase/cornell.sdl", "Cornell room, no mesh", Meshes::none},
    Subject{"stdlib-scenes/examples/shapes.sdl", "gears of listed vertices", Meshes::some},
    Subject{"stdlib-scenes/examples/buildings.sdl", "buildings", Meshes::some},
    Subject{"tests/numerics/scenes/everything_placed.sdl", "every shape, instances of instances",
            Meshes::some},
    Subject{"tests/numerics/scenes/glass_vases.sdl", "vases of triangles, glass and mirror",
            Meshes::some},
};

class Pair {
 public:
  explicit Pair(const Subject& subject) : pool_(1) {
    for (const Precision precision : {Precision::mixed, Precision::full}) {
      auto built = test::build_file(test::source_directory() / subject.file, pool_,
                                    {.precision = precision});
      SCENEC_ASSERT(built.has_value());
      built_[index(precision)] = std::move(*built);
    }
  }

  backend::Picture picture(Precision precision, ir::ImageSize size, int samples) {
    const test::BuiltScene& built = built_[index(precision)];
    ir::RenderSettings settings = test::small_settings(*built.scene, samples);
    settings.size = size;
    return backend::render(*built.render_scene, settings, pool_, {}, {});
  }

 private:
  static std::size_t index(Precision p) { return p == Precision::full ? 1 : 0; }

  ThreadPool pool_;
  std::array<test::BuiltScene, 2> built_;
};

struct Difference {
  double largest = 0;
  double mean_square = 0;
  double changed = 0;  // share of the channels
};

Difference difference(const backend::Picture& a, const backend::Picture& b) {
  Difference d;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) {
    const double x = std::fabs(static_cast<double>(a.rgb[i]) - static_cast<double>(b.rgb[i]));
    d.largest = std::fmax(d.largest, x);
    d.mean_square += x * x / static_cast<double>(a.rgb.size());
    d.changed += (x > 0 ? 1.0 : 0.0) / static_cast<double>(a.rgb.size());
  }
  return d;
}

TEST(Precision, ChangesNothingWhereVerticesAreExactOrThereAreNone) {
  for (const Subject& subject : subjects) {
    if (subject.meshes == Meshes::some) continue;
    Pair pair(subject);
    EXPECT_EQ(pair.picture(Precision::mixed, {24, 18}, 4).rgb,
              pair.picture(Precision::full, {24, 18}, 4).rgb)
        << subject.name;
  }
}

// A vertex moves by 2^-25 of its mesh: what is seen moves by nothing a sample could show, but a
// path that passes an edge on the other side is another path.
TEST(Precision, ChangesFewPaths) {
  for (const Subject& subject : subjects) {
    Pair pair(subject);
    const backend::Picture mixed = pair.picture(Precision::mixed, {64, 48}, 4);
    const backend::Picture full = pair.picture(Precision::full, {64, 48}, 4);
    const auto away = [&](double limit) {
      std::size_t count = 0;
      for (std::size_t i = 0; i < mixed.rgb.size(); ++i)
        if (!(std::fabs(mixed.rgb[i] - full.rgb[i]) <= limit * std::fabs(full.rgb[i]))) ++count;
      return static_cast<double>(count) / static_cast<double>(mixed.rgb.size());
    };
    EXPECT_LE(away(1e-3), 0.01) << subject.name;
  }
}

}  // namespace

std::string precision_table() {
  constexpr ir::ImageSize size{160, 120};
  constexpr int samples = 16;
  constexpr int rounds = 5;
  std::string out =
      "| scene | double / mixed, time | largest difference | root mean square | channels changed "
      "|\n"
      "|---|--:|--:|--:|--:|\n";
  for (const Subject& subject : subjects) {
    Pair pair(subject);
    std::array<double, 2> best{};
    best.fill(std::numeric_limits<double>::infinity());
    std::array<backend::Picture, 2> pictures;
    for (int round = 0; round < rounds; ++round) {
      for (std::size_t i = 0; i < 2; ++i) {
        const std::clock_t start = std::clock();
        pictures[i] = pair.picture(i == 1 ? Precision::full : Precision::mixed, size, samples);
        best[i] = std::fmin(best[i], static_cast<double>(std::clock() - start));
      }
    }
    const Difference d = difference(pictures[0], pictures[1]);
    out += fmt::format("| {} | {:.2f} | {:.2g} | {:.2g} | {:.2g} % |\n", subject.name,
                       best[1] / best[0], d.largest, std::sqrt(d.mean_square), 100 * d.changed);
  }
  return out;
}

}  // namespace scenec::numerics
