// `scenec stress`: a sound scene passes, one whose picture hangs on an ulp is named with its line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/process/child.hpp"

namespace {

using scenec::test::ChildResult;
using scenec::test::Sandbox;
using testing::HasSubstr;

ChildResult stress(const Sandbox& sandbox, std::vector<std::string> words) {
  words.insert(words.begin(), {"stress", "scene.sdl", "--progress", "none"});
  return scenec::test::run_child(
      words, {.directory = sandbox.path(), .file_size_limit = {}, .standard_output = {}});
}

// Every kind of light that a scale changes, glass that absorbs, a lens.
const std::string sound = R"(sdl 1;
material red: diffuse { color = rgb(0.7, 0.2, 0.1); }
material glass: dielectric { ior = 1.5; absorption = rgb(1, 2, 3); }
sphere { center = [0, 0.5, 0]; radius = 0.5; material = glass; }
box { min = [-1.5, 0, -1]; max = [-0.8, 1, 0]; material = red; }
plane { material = red; }
light: sphere { center = [1, 3, 1]; radius = 0.3; power = 100W; }
light: quad { corner = [-2, 3, 0]; edge_u = [1, 0, 0]; edge_v = [0, 0, 1]; radiance = 3; }
light: disk { center = [2, 3, 0]; normal = [0, -1, 0]; radius = 0.3; power = 30W; }
light: point { position = [0, 2, 3]; intensity = 2; }
light: point { position = [0, 2, 3]; intensity = 0.1; decay = .none; }
light: spot { position = [2, 2, 2]; direction = [-1, -1, -1]; angle = 40deg; falloff = 5deg; power = 40W; }
light: directional { direction = [0, -1, -1]; irradiance = 0.5; }
light: environment { constant = rgb(0.1, 0.1, 0.2); }
camera main: thin_lens { eye = [0, 1, 4]; aim = [0, 0.5, 0]; fov = 40deg; aperture = 0.02; focus = .aim; }
render { size = [40, 30]; samples = 16; }
)";

TEST(Stress, ASoundSceneLooksTheSameEverywhere) {
  const Sandbox sandbox;
  sandbox.write("scene.sdl", sound);
  const ChildResult result = stress(sandbox, {"--samples", "16", "-o", "maps"});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  for (const char* const name : {"moved", "large", "small", "turned", "jittered"}) {
    EXPECT_THAT(result.out, HasSubstr(name));
    EXPECT_FALSE(
        scenec::test::bytes_of(sandbox.path() / "maps" / (std::string(name) + ".exr")).empty());
  }
  EXPECT_THAT(result.out, testing::Not(HasSubstr("DISAGREES")));
}

TEST(Stress, NamesWhatHangsOnAnUlp) {
  // Two squares in one plane: rounding decides which of them is seen.
  const Sandbox sandbox;
  sandbox.write("scene.sdl", R"(sdl 1;
material dark: diffuse { color = gray(0.1); }
material pale: diffuse { color = gray(0.9); }
quad low { corner = [-1, 0.3, -1]; edge_u = [0, 0, 2]; edge_v = [2, 0, 0]; material = dark; }
quad high {
  corner = [-1, 0.2, -1]; edge_u = [0, 0, 2]; edge_v = [2, 0, 0]; material = pale;
  transform = [rotate_y(33deg), move([0.01m, 0.1m, 0.02m])];
}
light: directional { direction = [0, -1, 0]; irradiance = 3; }
camera main: pinhole { eye = [0, 3, 0.1]; aim = [0, 0.3, 0]; fov = 40deg; }
render { size = [40, 30]; }
)");
  const ChildResult result = stress(sandbox, {"--samples", "16"});
  EXPECT_EQ(result.exit_code, 1) << result.out << result.err;
  EXPECT_THAT(result.out, HasSubstr("DISAGREES"));
  EXPECT_THAT(result.out, testing::ContainsRegex("scene.sdl:[45]"));
  const ChildResult json = stress(sandbox, {"--samples", "16", "--json"});
  EXPECT_THAT(json.out, HasSubstr("\"agrees\": false"));
  EXPECT_THAT(json.out, HasSubstr("\"line\": \"scene.sdl:"));
}

}  // namespace
