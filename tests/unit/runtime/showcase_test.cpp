// The showcase does what its page says: each scene compiles without a word, asks for the effects it
// shows, and would look different without them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <sstream>
#include <string>
#include <vector>

#include "ir/effects.hpp"
#include "tests/support/built_scene.hpp"
#include "tests/support/paths.hpp"
#include "tests/support/scenes.hpp"

namespace scenec {
namespace {

using ir::Effect;
using ir::Method;

struct Shown {
  const char* feature;
  const char* scene;  // in stdlib-scenes/
  Method method;
  std::vector<Effect> effects;  // leaving one out changes the picture
};

// What a renderer of this kind is asked for first, and the scene that shows it.
std::vector<Shown> checklist() {
  return {
      {"Phong ray casting", "showcase/phong.sdl", Method::phong, {Effect::textures}},
      {"Whitted's reflection, refraction and shadows",
       "showcase/whitted.sdl",
       Method::whitted,
       {Effect::reflection, Effect::refraction, Effect::shadows}},
      {"light off the walls",
       "showcase/cornell.sdl",
       Method::path,
       {Effect::interreflection, Effect::area_lights, Effect::shadows}},
      {"mirror and glass in a path",
       "showcase/still-life.sdl",
       Method::path,
       {Effect::reflection, Effect::refraction, Effect::textures}},
      {"glossy surfaces and metals", "showcase/glossy-row.sdl", Method::path, {Effect::glossy}},
      {"caustics and absorption in glass",
       "showcase/caustic-glass.sdl",
       Method::path,
       {Effect::caustics, Effect::absorption, Effect::refraction}},
      {"rough glass, media inside each other",
       "showcase/rough-glass.sdl",
       Method::path,
       {Effect::glossy, Effect::refraction}},
      {"an image round a sphere", "showcase/globe.sdl", Method::path, {Effect::textures}},
      {"one image on plane, sphere, revolve and triangle",
       "showcase/mapping.sdl",
       Method::path,
       {Effect::textures}},
      {"leaves cut out by alpha",
       "showcase/leaves.sdl",
       Method::path,
       {Effect::alpha, Effect::environment, Effect::shadows}},
      {"interpolated normals, light from an image of a sky",
       "showcase/knot.sdl",
       Method::path,
       {Effect::environment, Effect::glossy}},
      {"depth of field", "showcase/depth-of-field.sdl", Method::path, {Effect::depth_of_field}},
      {"hundreds of lights", "showcase/many-lights.sdl", Method::path, {Effect::area_lights}},
      {"surfaces of revolution", "showcase/vases.sdl", Method::path, {Effect::area_lights}},
      {"surfaces of revolution by Newton's iteration",
       "showcase/newton.sdl",
       Method::path,
       {Effect::shadows}},
      {"thousands of instances",
       "showcase/landscape.sdl",
       Method::path,
       {Effect::environment, Effect::shadows}},
      {"a built scene from the library",
       "examples/colonnade.sdl",
       Method::path,
       {Effect::refraction, Effect::shadows}},
  };
}

backend::Picture picture_with(const test::BuiltScene& built, const ir::EffectSet& effects,
                              ThreadPool& pool) {
  const ir::RenderSettings settings = test::small_settings(*built.scene, 16);
  return backend::render(*built.render_scene, settings, effects, pool, {}, {});
}

TEST(Showcase, ShowsWhatItSays) {
  ThreadPool pool;
  for (const Shown& shown : checklist()) {
    SCOPED_TRACE(std::string(shown.feature) + " in " + shown.scene);
    const auto built =
        test::build_file(test::source_directory() / "stdlib-scenes" / shown.scene, pool);
    ASSERT_TRUE(built);
    EXPECT_EQ(built->findings, 0u);
    EXPECT_EQ(built->scene->render.method, shown.method);
    const ir::EffectSet found =
        backend::find_effects(*built->render_scene, test::small_settings(*built->scene))
            .simulated();
    const backend::Picture whole = picture_with(*built, found, pool);
    EXPECT_EQ(whole.dropped_samples, 0u);
    EXPECT_GT(*std::max_element(whole.rgb.begin(), whole.rgb.end()), 0.05f);
    for (const Effect effect : shown.effects) {
      ASSERT_TRUE(found.has(effect)) << ir::name_of(effect);
      ir::EffectSet without = found;
      without.remove(effect);
      EXPECT_NE(picture_with(*built, without, pool).rgb, whole.rgb) << ir::name_of(effect);
    }
  }
}

TEST(Showcase, EveryPictureOfThePageHasItsScene) {
  const std::string page = test::text_of_file(test::source_directory() / "docs/gallery.md");
  for (const auto& scene : test::scenes_beneath({"stdlib-scenes/showcase"})) {
    EXPECT_NE(page.find(scene.filename().string()), std::string::npos) << scene;
    EXPECT_NE(page.find("images/gallery/" + scene.stem().string() + ".png"), std::string::npos)
        << scene;
  }
}

// The words between back quotes.
std::vector<std::string> quoted_of(const std::string& line) {
  std::vector<std::string> words;
  for (std::size_t at = 0; (at = line.find('`', at)) != std::string::npos;) {
    const std::size_t end = line.find('`', at + 1);
    if (end == std::string::npos) break;
    words.push_back(line.substr(at + 1, end - at - 1));
    at = end + 1;
  }
  return words;
}

// The table of features: each row's scene is there, and so is its test.
TEST(Showcase, EveryFeatureOfTheTableHasItsSceneAndItsTest) {
  const std::filesystem::path root = test::source_directory();
  std::istringstream page(test::text_of_file(root / "docs/gallery.md"));
  int rows = 0;
  for (std::string line; std::getline(page, line);) {
    if (!line.starts_with("| ") || line.starts_with("| feature")) continue;
    const std::vector<std::string> words = quoted_of(line);
    ASSERT_EQ(words.size(), 3u) << line;
    ++rows;
    EXPECT_TRUE(std::filesystem::exists(root / "stdlib-scenes" / words[0])) << line;
    const std::string tests = test::text_of_file(root / "tests" / words[1]);
    const std::size_t dot = words[2].find('.');
    const std::string name = "(" + words[2].substr(0, dot) + ", " + words[2].substr(dot + 1) + ")";
    EXPECT_NE(tests.find(name), std::string::npos) << line;
  }
  EXPECT_EQ(rows, 15);
}

}  // namespace
}  // namespace scenec
