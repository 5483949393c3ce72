#include "runtime/frames.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "runtime/cli.hpp"

namespace scenec::runtime {
namespace {

namespace fs = std::filesystem;

TEST(Frames, RangesAreTwoWholeNumbersInOrder) {
  const auto range = parse_frames("0..143");
  ASSERT_TRUE(range.ok());
  EXPECT_EQ(range.value().first, 0);
  EXPECT_EQ(range.value().last, 143);
  EXPECT_EQ(parse_frames("007..7").value().first, 7);
  EXPECT_TRUE(parse_frames("999999999..999999999").ok());
  for (const std::string_view text : {"", "4", "..", "4..", "..4", "4..3", "-1..3", "0..1e3",
                                      "0...3", "0..1000000000", "0..100000", "0 .. 3", "0..3..5"})
    EXPECT_FALSE(parse_frames(text).ok()) << text;
}

TEST(Frames, TheNumberReplacesTheMarksOrStandsBeforeTheExtension) {
  EXPECT_EQ(path_in_frame("out.####.png", 12), "out.0012.png");
  EXPECT_EQ(path_in_frame("out#.png", 12), "out12.png");
  EXPECT_EQ(path_in_frame("#a/##-###.exr", 5), "#a/##-005.exr");
  EXPECT_EQ(path_in_frame("out.png", 1), "out.0001.png");
  EXPECT_EQ(path_in_frame("out.png", 123456), "out.123456.png");
  EXPECT_EQ(path_in_frame("film.d/out", 1), "film.d/out.0001");
  EXPECT_EQ(path_in_frame("dir#/out.png", 1), "dir#/out.0001.png");
  EXPECT_EQ(path_in_frame(".png", 1), ".png.0001");
}

class FramesOfAScene : public testing::Test {
 protected:
  FramesOfAScene()
      : directory_(fs::temp_directory_path() / ("scenec-frames-" + std::to_string(::getpid()))) {
    fs::create_directories(directory_);
  }
  ~FramesOfAScene() override { fs::remove_all(directory_); }

  std::string put(const std::string& name, const std::string& text) {
    std::ofstream(directory_ / name, std::ios::binary) << text;
    return (directory_ / name).string();
  }
  std::string bytes_of(const std::string& name) const {
    std::ifstream file(directory_ / name, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }
  bool exists(const std::string& name) const { return fs::exists(directory_ / name); }
  ExitCode run_scenec(std::vector<std::string> words) {
    err_.str({});
    const Environment environment{
        .out = out_, .err = err_, .variable = [](std::string_view) { return std::nullopt; }};
    words.insert(words.end(), {"--threads", "1", "--progress", "none"});
    return run(words, environment);
  }
  // A ball that a clock moves, with `more` in the scene.
  std::string scene(const std::string& range = "0s .. 1s", const std::string& more = {}) {
    const std::string low = range.substr(0, range.find(' '));
    return put("scene.sdl",
               "sdl 1;\n@clock param t: time = " + low + " in " + range + ";\n" + more +
                   "material m: diffuse { color = gray(0.6); }\n"
                   "sphere { center = [t / 1s, 0, 0]; radius = 0.5; material = m; }\n"
                   "light: point { position = [2, 3, 4]; power = 900; }\n"
                   "camera main: pinhole { eye = [0, 0, 5]; aim = [0, 0, 0]; fov = 40deg; }\n"
                   "render { size = [8, 8]; samples = 1; }\n");
  }
  std::string output(const std::string& name) const { return (directory_ / name).string(); }

  fs::path directory_;
  std::ostringstream out_;
  std::ostringstream err_;
};

TEST_F(FramesOfAScene, EachFrameIsThePictureOfItsTime) {
  const std::string file = scene();
  ASSERT_EQ(run_scenec({file, "--frames", "0..2", "--fps", "2", "-o", output("a.##.bmp")}),
            ExitCode::ok)
      << err_.str();
  ASSERT_EQ(run_scenec({file, "-D", "t=500ms", "-o", output("half.bmp")}), ExitCode::ok);
  EXPECT_EQ(bytes_of("a.01.bmp"), bytes_of("half.bmp"));
  EXPECT_NE(bytes_of("a.00.bmp"), bytes_of("a.01.bmp"));
  EXPECT_NE(bytes_of("a.01.bmp"), bytes_of("a.02.bmp"));
  EXPECT_FALSE(exists("a.03.bmp"));
}

TEST_F(FramesOfAScene, AFrameIsTheSameWhateverTheRange) {
  const std::string file = scene();
  ASSERT_EQ(run_scenec({file, "--frames", "0..5", "-o", output("a.png")}), ExitCode::ok);
  ASSERT_EQ(run_scenec({file, "--frames", "5..5", "-o", output("b.png")}), ExitCode::ok);
  EXPECT_EQ(bytes_of("a.0005.png"), bytes_of("b.0005.png"));
}

// 0.1 + 7/10 is 0.7999999999999999 or 0.8000000000000002 depending on the order of rounding: the
// last frame of a whole number of frames belongs to the clock.
TEST_F(FramesOfAScene, TheLastFrameMayMeetTheEndOfTheClock) {
  for (int tenths = 1; tenths <= 40; ++tenths) {
    const std::string end = std::to_string(tenths / 10 + 1) + "." + std::to_string(tenths % 10);
    const std::string last = std::to_string(tenths + 9);
    const std::string file = scene("100ms .. " + end + "s");
    ASSERT_EQ(run_scenec({file, "--frames", last + ".." + last, "--fps", "10", "--size", "1x1",
                          "-o", output("a.bmp")}),
              ExitCode::ok)
        << end << "\n"
        << err_.str();
    const std::string beyond = std::to_string(tenths + 10);
    EXPECT_EQ(run_scenec(
                  {file, "--frames", beyond + ".." + beyond, "--fps", "10", "-o", output("a.bmp")}),
              ExitCode::usage);
  }
}

TEST_F(FramesOfAScene, AnOpenRangeLeavesItsEndOut) {
  const std::string file = scene("0s ..< 1s");
  EXPECT_EQ(run_scenec({file, "--frames", "23..23", "-o", output("a.bmp")}), ExitCode::ok);
  EXPECT_EQ(run_scenec({file, "--frames", "24..24", "-o", output("a.bmp")}), ExitCode::usage);
  EXPECT_NE(err_.str().find("the last frame at 24 frames a second is 23"), std::string::npos)
      << err_.str();
}

TEST_F(FramesOfAScene, NothingIsRenderedWhenALaterFrameDoesNotFit) {
  const std::string file = scene();
  EXPECT_EQ(run_scenec({file, "--frames", "0..25", "-o", output("a.bmp")}), ExitCode::usage);
  EXPECT_FALSE(exists("a.0000.bmp"));
  fs::create_directories(directory_ / "b.0002.bmp");
  EXPECT_EQ(run_scenec({file, "--frames", "0..3", "-o", output("b.bmp")}), ExitCode::file_error);
  EXPECT_FALSE(exists("b.0000.bmp"));
}

TEST_F(FramesOfAScene, AnOutputOfALaterFrameIsNoInput) {
  ASSERT_EQ(run_scenec({scene(), "-o", output("t.0001.png")}), ExitCode::ok) << err_.str();
  const std::string before = bytes_of("t.0001.png");
  const std::string file =
      scene("0s .. 1s",
            "let i = image(\"t.0001.png\");\nmaterial n: diffuse { color = i; }\n"
            "sphere { center = [0, 2, 0]; radius = 0.5; material = n; }\n");
  EXPECT_EQ(run_scenec({file, "--frames", "0..1", "-o", output("t.png")}), ExitCode::file_error)
      << err_.str();
  EXPECT_FALSE(exists("t.0000.png"));
  EXPECT_EQ(bytes_of("t.0001.png"), before);
}

TEST_F(FramesOfAScene, AFrameThatFailsStopsTheRest) {
  const std::string file = scene("0s .. 1s", "assert t < 3s / 24;\n");
  EXPECT_EQ(run_scenec({file, "--frames", "0..9", "-o", output("a.bmp")}), ExitCode::scene_error);
  EXPECT_TRUE(exists("a.0002.bmp"));
  EXPECT_FALSE(exists("a.0003.bmp"));
  EXPECT_FALSE(exists("a.0004.bmp"));
}

TEST_F(FramesOfAScene, StatisticsHaveAFileEach) {
  EXPECT_EQ(run_scenec({scene(), "--frames", "3..4", "-o", output("a.bmp"),
                        "--stats=json:" + output("stats.json")}),
            ExitCode::ok);
  EXPECT_TRUE(exists("stats.0003.json"));
  EXPECT_TRUE(exists("stats.0004.json"));
}

}  // namespace
}  // namespace scenec::runtime
