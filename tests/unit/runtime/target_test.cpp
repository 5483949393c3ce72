// The same picture for every instruction set the machine has, for any number of threads.
#include <gtest/gtest.h>

#include <vector>

#include "backend/accel/target.hpp"
#include "tests/support/built_scene.hpp"
#include "tests/support/paths.hpp"

namespace scenec {
namespace {

TEST(Target, GivesTheSameBytesWithAnyNumberOfThreads) {
  const auto file = test::source_directory() / "tests/numerics/scenes/everything_placed.sdl";
  for (const backend::Precision precision : {backend::Precision::mixed, backend::Precision::full}) {
    std::vector<backend::Picture> pictures;
    for (const backend::Target target : backend::available_targets()) {
      for (const unsigned threads : {1U, 2U, 7U, 64U}) {
        ThreadPool pool(threads);
        const auto built = test::build_file(file, pool, {.precision = precision, .target = target});
        ASSERT_TRUE(built);
        ir::RenderSettings settings = test::small_settings(*built->scene);
        settings.aovs = {ir::Aov::normal, ir::Aov::depth, ir::Aov::ids, ir::Aov::variance};
        pictures.push_back(backend::render(*built->render_scene, settings, pool, {}, {}));
        EXPECT_EQ(pictures.back().dropped_samples, 0U);
        const backend::Picture& first = pictures.front();
        const backend::Picture& p = pictures.back();
        EXPECT_TRUE(p.rgb == first.rgb && p.alpha == first.alpha && p.layers == first.layers &&
                    p.rays == first.rays)
            << name_of(target) << ", " << threads << " threads";
      }
    }
  }
}

}  // namespace
}  // namespace scenec
