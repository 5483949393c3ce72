// Renders that are interrupted end with the same bytes as renders that are not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "tests/process/child.hpp"

namespace {

using scenec::test::bytes_of;
using scenec::test::Child;
using scenec::test::ChildOptions;
using scenec::test::ChildResult;
using scenec::test::run_child;
using scenec::test::Sandbox;
using testing::HasSubstr;

// EXR with the layers that are made of sums.
const std::string scene_text = R"(sdl 1;
material red: diffuse { color = rgb(0.7, 0.2, 0.1); }
sphere { center = [0, 0.5, 0]; radius = 0.5; material = red; }
plane { material = red; }
light: sphere { center = [1, 3, 1]; radius = 0.3; radiance = 20; }
camera main: pinhole { eye = [0, 1, 4]; aim = [0, 0.5, 0]; fov = 40deg; }
render { size = [48, 36]; aovs = [.variance, .normal]; }
)";

class Stage {
 public:
  Stage() { sandbox_.write("scene.sdl", scene_text); }
  [[nodiscard]] const Sandbox& sandbox() const { return sandbox_; }
  [[nodiscard]] ChildOptions options() const {
    return {.directory = sandbox_.path(), .file_size_limit = {}, .standard_output = {}};
  }
  [[nodiscard]] ChildResult run(std::vector<std::string> words) const {
    words.insert(words.begin(), "scene.sdl");
    return run_child(words, options());
  }
  [[nodiscard]] std::string file(const std::string& name) const {
    return bytes_of(sandbox_.path() / name);
  }

 private:
  Sandbox sandbox_;
};

TEST(Checkpoint, MoreSamplesLaterAreAllSamplesAtOnce) {
  const Stage stage;
  ASSERT_EQ(stage.run({"-o", "a.exr", "--samples", "256"}).exit_code, 0);
  ASSERT_EQ(stage.run({"-o", "b.exr", "--samples", "64", "--checkpoint", "c"}).exit_code, 0);
  const ChildResult more =
      stage.run({"-o", "b.exr", "--samples", "256", "--checkpoint", "c", "--resume"});
  ASSERT_EQ(more.exit_code, 0) << more.err;
  EXPECT_TRUE(stage.file("a.exr") == stage.file("b.exr"));
  EXPECT_THAT(stage.run({"--samples", "32", "--checkpoint", "c", "--resume"}).err,
              HasSubstr("has 256 samples a pixel; 32 are asked for"));
}

TEST(Checkpoint, OfAnotherRenderIsRefusedByName) {
  const Stage stage;
  ASSERT_EQ(stage.run({"--samples", "8", "--checkpoint", "c"}).exit_code, 0);
  const auto refused = [&](std::vector<std::string> words) {
    words.insert(words.end(), {"--samples", "16", "--checkpoint", "c", "--resume"});
    const ChildResult result = stage.run(words);
    EXPECT_EQ(result.exit_code, 3) << result.err;
    return result.err;
  };
  EXPECT_THAT(refused({"--seed", "4"}), HasSubstr("its `seed` is `0`; this render's is `4`"));
  EXPECT_THAT(refused({"--size", "40x30"}), HasSubstr("its `size` is `48x36`"));
  EXPECT_THAT(refused({"--method", "whitted"}), HasSubstr("its `method` is `path`"));
  stage.sandbox().write("scene.sdl", scene_text + "sphere { radius = 0.1; material = red; }\n");
  EXPECT_THAT(refused({}), HasSubstr("its `scene` is"));
}

TEST(Checkpoint, DamageIsNoticedAndTheOneBeforeIsTaken) {
  const Stage stage;
  for (const char* const samples : {"8", "16"}) {
    std::vector<std::string> words{"--samples", samples, "--checkpoint", "c"};
    if (std::string(samples) == "16") words.emplace_back("--resume");
    ASSERT_EQ(stage.run(words).exit_code, 0);
  }
  std::string bytes = stage.file("c");
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 4);
  stage.sandbox().write("c", bytes);
  EXPECT_EQ(
      stage.run({"-o", "a.exr", "--samples", "24", "--checkpoint", "c", "--resume"}).exit_code, 0);
  ASSERT_EQ(stage.run({"-o", "b.exr", "--samples", "24"}).exit_code, 0);
  EXPECT_TRUE(stage.file("a.exr") == stage.file("b.exr"));
  for (const char* const name : {"c", "c~"}) stage.sandbox().write(name, "scenec checkpoint 1\nno");
  EXPECT_EQ(stage.run({"--samples", "32", "--checkpoint", "c", "--resume"}).exit_code, 3);
}

TEST(Checkpoint, AFullDiskLeavesTheOldOneWhole) {
  const Stage stage;
  ASSERT_EQ(stage.run({"--samples", "8", "--checkpoint", "c"}).exit_code, 0);
  const std::string before = stage.file("c");
  for (const std::uint64_t limit : {std::uint64_t{4096}, std::uint64_t{before.size() - 1}}) {
    ChildOptions options = stage.options();
    options.file_size_limit = limit;
    const ChildResult again = run_child(
        {"scene.sdl", "-o", "x.png", "--samples", "16", "--checkpoint", "c", "--resume"}, options);
    EXPECT_EQ(again.exit_code, 3) << limit << again.err;
    EXPECT_TRUE(stage.file("c") == before) << limit;
  }
}

TEST(Checkpoint, IsWrittenOnASignalAndGoneAfterSuccess) {
  const Stage stage;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    Child child({"scene.sdl", "-o", "a.exr", "--samples", "1000000"}, stage.options());
    std::this_thread::sleep_for(std::chrono::milliseconds(700));
    child.send(signal);
    EXPECT_EQ(child.wait().exit_code, 128 + signal);
    EXPECT_FALSE(stage.file("a.exr.ckpt").empty());
  }
  // The samples so far are those of a render that was not stopped.
  const ChildResult stats =
      stage.run({"-o", "a.exr", "--time", "1ms", "--resume", "--stats=json:s.json"});
  EXPECT_EQ(stats.exit_code, 0) << stats.err;
  EXPECT_TRUE(stage.file("a.exr.ckpt").empty());
}

// Killed again and again, at moments that are not chosen; the last run is let to its end.
void expect_survival(int kills, const char* samples, int longest_ms) {
  const Stage stage;
  ASSERT_EQ(stage.run({"-o", "whole.exr", "--samples", samples}).exit_code, 0);
  std::mt19937 random(20);
  int resumed = 0;
  for (int kill = 0; kill <= kills; ++kill) {
    const bool exists = !stage.file("c").empty();
    std::vector<std::string> words{
        "scene.sdl", "-o",           "parts.exr", "--samples",
        samples,     "--checkpoint", "c",         "--checkpoint-interval",
        "1ms"};
    if (exists) words.emplace_back("--resume");
    resumed += exists ? 1 : 0;
    Child child(words, stage.options());
    if (kill < kills) {
      // On a busy machine nothing may have been saved yet: the first is let come to its first save.
      for (int wait = 0; wait < 500 && !exists && stage.file("c").empty(); ++wait)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
      std::this_thread::sleep_for(
          std::chrono::milliseconds(30 + random() % static_cast<unsigned>(longest_ms)));
      child.send(SIGKILL);
    }
    const ChildResult result = child.wait();
    if (kill == kills) {
      ASSERT_EQ(result.exit_code, 0) << result.err;
    } else {
      ASSERT_TRUE(result.exit_code == 137 || result.exit_code == 0) << result.err;
    }
  }
  EXPECT_TRUE(stage.file("whole.exr") == stage.file("parts.exr"));
  EXPECT_GT(resumed, 0);
  for (const std::string& name : stage.sandbox().names())
    EXPECT_EQ(name.find(".tmp-"), std::string::npos) << name;
}

TEST(Checkpoint, EndsTheSameHoweverOftenItIsKilled) {
  expect_survival(4, "1200", 200);
}
TEST(Checkpoint, SlowEndsTheSameAfterTwoHundredKills) {
  expect_survival(200, "60000", 400);
}

}  // namespace
