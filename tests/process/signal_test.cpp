// SIGINT and SIGTERM while rendering: the picture so far within 2 s, and the exit code that says
// so.
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <string>
#include <thread>

#include "tests/process/child.hpp"

namespace {

using scenec::test::Child;
using scenec::test::ChildResult;
using scenec::test::Sandbox;

ChildResult interrupt(const Sandbox& sandbox, int signal) {
  sandbox.write("scene.sdl", scenec::test::small_scene);
  Child child({"scene.sdl", "-o", "out.png", "--size", "200x150", "--samples", "1000000"},
              {.directory = sandbox.path(), .file_size_limit = {}, .standard_output = {}});
  // Long enough for the first rounds of a picture that would take hours.
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));
  const auto start = std::chrono::steady_clock::now();
  child.send(signal);
  ChildResult result = child.wait();
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

TEST(Signals, InterruptWritesThePictureSoFar) {
  const Sandbox sandbox;
  const ChildResult result = interrupt(sandbox, SIGINT);
  EXPECT_EQ(result.exit_code, 130) << result.err;
  EXPECT_LT(result.seconds, SCENEC_IS_SANITIZED ? 20 : 2);
  EXPECT_TRUE(scenec::test::bytes_of(sandbox.path() / "out.png").starts_with("\x89PNG"))
      << result.err;
  EXPECT_NE(result.err.find("stopped early; `--resume` goes on"), std::string::npos) << result.err;
}

TEST(Signals, TerminateDoesTheSame) {
  const Sandbox sandbox;
  const ChildResult result = interrupt(sandbox, SIGTERM);
  EXPECT_EQ(result.exit_code, 143) << result.err;
  EXPECT_TRUE(scenec::test::bytes_of(sandbox.path() / "out.png").starts_with("\x89PNG"))
      << result.err;
}

}  // namespace
