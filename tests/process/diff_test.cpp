// `scenec diff`, and `--error`: what is said of pictures.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/process/child.hpp"

namespace {

using scenec::test::ChildResult;
using scenec::test::Sandbox;
using testing::HasSubstr;

class Pictures {
 public:
  Pictures() { sandbox.write("scene.sdl", scenec::test::small_scene); }
  ChildResult run(const std::vector<std::string>& words) const {
    return scenec::test::run_child(
        words, {.directory = sandbox.path(), .file_size_limit = {}, .standard_output = {}});
  }
  Sandbox sandbox;
};

TEST(Diff, EqualPicturesAreEqualAndOthersAreMeasured) {
  const Pictures p;
  ASSERT_EQ(p.run({"scene.sdl", "-o", "a.exr", "--size", "32x24", "--samples", "4"}).exit_code, 0);
  ASSERT_EQ(p.run({"scene.sdl", "-o", "a.png", "--size", "32x24", "--samples", "4"}).exit_code, 0);
  ASSERT_EQ(p.run({"scene.sdl", "-o", "b.exr", "--size", "32x24", "--samples", "4", "--seed", "9"})
                .exit_code,
            0);
  const ChildResult same = p.run({"diff", "a.exr", "a.exr", "--tolerance", "0.001%"});
  EXPECT_EQ(same.exit_code, 0) << same.err;
  EXPECT_THAT(same.out, HasSubstr("0 of 768"));
  const ChildResult other =
      p.run({"diff", "a.exr", "b.exr", "--tolerance", "0.001%", "-o", "d.png"});
  EXPECT_EQ(other.exit_code, 1) << other.err;
  EXPECT_THAT(other.out, HasSubstr("worst"));
  EXPECT_TRUE(scenec::test::bytes_of(p.sandbox.path() / "d.png").starts_with("\x89PNG"));
  EXPECT_EQ(p.run({"diff", "a.exr", "b.exr", "-o", "d.exr"}).exit_code, 0);
  // Eight bits hold what they can: an EXR and its PNG are close.
  const ChildResult formats = p.run({"diff", "a.png", "a.exr", "--json"});
  EXPECT_EQ(formats.exit_code, 0);
  EXPECT_THAT(formats.out, HasSubstr("\"FLIP\""));
}

TEST(Diff, SaysWhatCannotBeCompared) {
  const Pictures p;
  ASSERT_EQ(p.run({"scene.sdl", "-o", "a.png", "--size", "8x8", "--samples", "1"}).exit_code, 0);
  ASSERT_EQ(p.run({"scene.sdl", "-o", "b.png", "--size", "9x8", "--samples", "1"}).exit_code, 0);
  const ChildResult sizes = p.run({"diff", "a.png", "b.png"});
  EXPECT_EQ(sizes.exit_code, 3);
  EXPECT_THAT(sizes.err, HasSubstr("8x8 and 9x8"));
  EXPECT_EQ(p.run({"diff", "a.png", "none.png"}).exit_code, 3);
  EXPECT_EQ(p.run({"diff", "a.png", "scene.sdl"}).exit_code, 3);
  EXPECT_EQ(p.run({"diff", "a.png"}).exit_code, 2);
}

TEST(Error, EndsTheRenderAndIsToldInTheFile) {
  const Pictures p;
  const ChildResult result =
      p.run({"scene.sdl", "-o", "a.png", "--size", "32x24", "--error", "10%", "--stats"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("error"));
  EXPECT_THAT(scenec::test::bytes_of(p.sandbox.path() / "a.png"), HasSubstr("scenec/error"));
  EXPECT_EQ(p.run({"scene.sdl", "--error", "0%"}).exit_code, 2);
}

}  // namespace
