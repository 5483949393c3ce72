// `scenec verify` from the outside: what it lets pass, what it names and how it ends. Whether its
// statistics are right is asked in tests/accuracy/verify_test.cpp.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/process/child.hpp"

namespace {

using scenec::test::bytes_of;
using scenec::test::ChildResult;
using scenec::test::Sandbox;
using testing::HasSubstr;

const std::string scene_text = R"(sdl 1;
param x: num = 0.0;
material red: diffuse { color = rgb(0.7, 0.2, 0.1); }
material grey: diffuse { color = gray(0.5); }
sphere { center = [x, 0.5, 0]; radius = 0.5; material = red; }
plane { material = grey; }
light: sphere { center = [1, 3, 1]; radius = 0.3; radiance = 20; }
camera main: pinhole { eye = [0, 1, 4]; aim = [0, 0.5, 0]; fov = 40deg; }
render { size = [40, 30]; samples = 32; aovs = [.variance]; }
)";

class Pictures {
 public:
  Pictures() { sandbox.write("scene.sdl", scene_text); }
  ChildResult run(std::vector<std::string> words) const {
    if (words[0] == "verify") words.insert(words.end(), {"--progress", "none"});
    return scenec::test::run_child(
        words, {.directory = sandbox.path(), .file_size_limit = {}, .standard_output = {}});
  }
  void render(std::vector<std::string> words) const {
    words.insert(words.begin(), "scene.sdl");
    const ChildResult result = run(words);
    ASSERT_EQ(result.exit_code, 0) << result.err;
  }
  // Fields are text in the header; a change must keep their length.
  void change(const std::string& name, const std::string& from, const std::string& to) const {
    std::string bytes = bytes_of(sandbox.path() / name);
    const std::size_t at = bytes.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    bytes.replace(at, from.size(), to);
    sandbox.write(name, bytes);
  }
  Sandbox sandbox;
};

TEST(Verify, AcceptsWhatItsFieldsSay) {
  const Pictures p;
  p.render({"-o", "a.exr", "-D", "x=0.1", "--region", "4,2,36,28", "--seed", "5"});
  const ChildResult result = p.run({"verify", "a.exr", "scene.sdl"});
  EXPECT_EQ(result.exit_code, 0) << result.err << result.out;
  EXPECT_THAT(result.out, HasSubstr("accepted: p = "));
  // The same file is asked the same questions.
  EXPECT_EQ(p.run({"verify", "a.exr", "scene.sdl", "--threads", "1"}).out, result.out);
  p.render({"-o", "half.exr", "--half", "--stamp"});
  const ChildResult stamped = p.run({"verify", "half.exr", "--json"});
  EXPECT_EQ(stamped.exit_code, 0) << stamped.err << stamped.out;
  EXPECT_THAT(stamped.out, HasSubstr("\"accepted\": true"));
}

TEST(Verify, RefusesAPictureOfAnotherPlace) {
  const Pictures p;
  p.render({"-o", "a.exr", "-D", "x=0.1"});
  p.render({"-o", "b.exr", "-D", "x=0.3"});
  // The one's pixels with the other's fields.
  const std::string a = bytes_of(p.sandbox.path() / "a.exr");
  const std::string b = bytes_of(p.sandbox.path() / "b.exr");
  const auto hash_of = [](const std::string& bytes) {
    const std::size_t at = bytes.find("scenec/scene_hash");
    return bytes.substr(bytes.find("string", at) + 11, 32);
  };
  p.change("b.exr", hash_of(b), hash_of(a));
  p.change("b.exr", "x=0.3", "x=0.1");
  const ChildResult result = p.run({"verify", "b.exr", "scene.sdl"});
  EXPECT_EQ(result.exit_code, 1) << result.err << result.out;
  EXPECT_THAT(result.out, HasSubstr("refused: p = "));
  EXPECT_THAT(result.out, HasSubstr("worst: "));
}

TEST(Verify, NamesTheFieldThatDiffers) {
  const Pictures p;
  p.render({"-o", "a.exr", "--seed", "7"});
  const auto refused = [&](const std::string& from, const std::string& to) {
    const std::string bytes = bytes_of(p.sandbox.path() / "a.exr");
    p.sandbox.write("b.exr", bytes);
    p.change("b.exr", from, to);
    const ChildResult result = p.run({"verify", "b.exr", "scene.sdl"});
    EXPECT_EQ(result.exit_code, 1) << result.err << result.out;
    return result.err;
  };
  EXPECT_THAT(refused("scenec 0.1.0", "scenec 0.0.9"), HasSubstr("its `build` is `scenec 0.0.9`"));
  EXPECT_THAT(refused("--seed 7", "--seed 8"), HasSubstr("its `seed` is `7`; here it is `8`"));
  EXPECT_THAT(refused("shadows", "shadowy"), HasSubstr("its `effects` is"));
  p.sandbox.write("scene.sdl", bytes_of(p.sandbox.path() / "scene.sdl") +
                                   "sphere { radius = 0.1; material = red; }\n");
  const ChildResult other = p.run({"verify", "a.exr", "scene.sdl"});
  EXPECT_EQ(other.exit_code, 1);
  EXPECT_THAT(other.err, HasSubstr("its `scene_hash` is"));
}

TEST(Verify, SaysWhatCannotBeVerified) {
  const Pictures p;
  p.render({"-o", "a.png"});
  const ChildResult png = p.run({"verify", "a.png", "scene.sdl"});
  EXPECT_EQ(png.exit_code, 3);
  EXPECT_THAT(png.err, HasSubstr("only an EXR file"));
  p.render({"-o", "adaptive.exr", "--adaptive"});
  const ChildResult adaptive = p.run({"verify", "adaptive.exr", "scene.sdl"});
  EXPECT_EQ(adaptive.exit_code, 3);
  EXPECT_THAT(adaptive.err,
              HasSubstr("it was sampled adaptively: its pixels have unequal samples"));
  p.render({"-o", "a.exr"});
  const ChildResult nameless = p.run({"verify", "a.exr"});
  EXPECT_EQ(nameless.exit_code, 2);
  EXPECT_THAT(nameless.err, HasSubstr("does not name its scene"));
  ASSERT_EQ(p.run({"diff", "a.exr", "a.exr", "-o", "d.exr"}).exit_code, 0);
  const ChildResult silent = p.run({"verify", "d.exr", "scene.sdl"});
  EXPECT_EQ(silent.exit_code, 3);
  EXPECT_THAT(silent.err, HasSubstr("claims nothing: it has no field `software`"));
  EXPECT_EQ(p.run({"verify"}).exit_code, 2);
  EXPECT_EQ(p.run({"verify", "none.exr", "scene.sdl"}).exit_code, 3);
}

}  // namespace
