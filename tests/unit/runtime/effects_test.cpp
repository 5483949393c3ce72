// The proofs of effects hold: a picture simulated with what the analysis finds has the same bits as
// one simulated with every effect, for every scene in the tree; and switches change what they say.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "backend/backend.hpp"
#include "ir/effects.hpp"
#include "tests/support/built_scene.hpp"
#include "tests/support/paths.hpp"

namespace scenec {
namespace {

namespace fs = std::filesystem;
using test::build_file;
using test::small_settings;

// Where two pictures differ first.
std::string difference(const backend::Picture& a, const backend::Picture& b) {
  for (std::size_t i = 0; i < a.rgb.size(); ++i) {
    if (a.rgb[i] == b.rgb[i]) continue;
    return " float " + std::to_string(i) + ": " + std::to_string(a.rgb[i]) + " and " +
           std::to_string(b.rgb[i]);
  }
  return " nowhere";
}

std::vector<fs::path> all_scenes() {
  std::vector<fs::path> scenes;
  for (const char* const folder : {"stdlib-scenes", "tests/golden/effects"})
    for (const auto& entry : fs::recursive_directory_iterator(test::source_directory() / folder))
      if (entry.path().extension() == ".sdl") scenes.push_back(entry.path());
  std::sort(scenes.begin(), scenes.end());
  return scenes;
}

TEST(Effects, WhatIsProvedAbsentCannotBeSeen) {
  ThreadPool pool;
  int compared = 0;
  for (const fs::path& path : all_scenes()) {
    const auto built = build_file(path, pool);
    if (!built) continue;  // a library
    for (const ir::Method method : {ir::Method::path, ir::Method::whitted, ir::Method::phong}) {
      ir::RenderSettings settings = small_settings(*built->scene);
      settings.method = method;
      settings.effects = {};
      const ir::EffectReport report = backend::find_effects(*built->render_scene, settings);
      const backend::Picture found =
          backend::render(*built->render_scene, settings, report.simulated(), pool, {}, {});
      const backend::Picture full =
          backend::render(*built->render_scene, settings, ir::EffectSet::all(), pool, {}, {});
      EXPECT_TRUE(found.rgb == full.rgb)
          << path << " method " << static_cast<int>(method) << difference(found, full);
      // The same effects by the kernel that could simulate all.
      const backend::Picture by_full =
          backend::render(*built->render_scene, settings, report.simulated(), pool, {}, {},
                          backend::KernelChoice::full);
      EXPECT_TRUE(found.rgb == by_full.rgb)
          << path << " method " << static_cast<int>(method) << difference(found, by_full);
      // What is not called for does not run (E01-E08).
      for (std::size_t i = 0; i < ir::effect_count; ++i) {
        if (report.findings[i].simulated()) continue;
        EXPECT_EQ(found.effect_runs[i], 0u)
            << path << " " << ir::name_of(static_cast<ir::Effect>(i));
        EXPECT_EQ(by_full.effect_runs[i], 0u)
            << path << " " << ir::name_of(static_cast<ir::Effect>(i));
      }
      ++compared;
    }
  }
  EXPECT_GE(compared, 3 * 12);
}

TEST(Effects, SwitchesLeaveOutWhatTheyName) {
  ThreadPool pool;
  const auto built =
      build_file(test::source_directory() / "tests/golden/effects/everything.sdl", pool);
  ASSERT_TRUE(built);
  const ir::RenderSettings settings = small_settings(*built->scene);
  const ir::EffectSet all = backend::find_effects(*built->render_scene, settings).simulated();
  ASSERT_EQ(all, ir::EffectSet::all());
  const backend::Picture with = backend::render(*built->render_scene, settings, all, pool, {}, {});
  for (std::size_t i = 0; i < ir::effect_count; ++i) {
    const auto effect = static_cast<ir::Effect>(i);
    ir::EffectSet set = all;
    set.remove(effect);
    const backend::Picture without =
        backend::render(*built->render_scene, settings, set, pool, {}, {});
    EXPECT_NE(with.rgb, without.rgb) << ir::name_of(effect);
    EXPECT_EQ(without.dropped_samples, 0u) << ir::name_of(effect);
  }
}

}  // namespace
}  // namespace scenec
