// Small texts that ask for very much: each is one located error (or compiles) within 2 s and
// 256 MiB, before the memory for what it asks is taken.
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <string>

#include "tests/process/child.hpp"

namespace {

using scenec::test::ChildResult;
using scenec::test::Sandbox;

const std::string scene =
    "sdl 1;\nmaterial matt: diffuse { color = gray(0.5); }\n"
    "light: point { position = [0, 3, 3]; power = 60W; }\n"
    "camera main: pinhole { eye = [0, 0, 5]; aim = [0, 0, 0]; fov = 40deg; }\n";
const std::string ball = "sphere { material = matt; }\n";

std::string repeated(const std::string& text, int count) {
  std::string all;
  for (int i = 0; i < count; ++i) all += text;
  return all;
}

// Names 0 to `levels`: the first is `first`, each other one made from the one before.
std::string levels(int count, const std::string& first,
                   const std::function<std::string(int level)>& other) {
  std::string text = first;
  for (int i = 1; i <= count; ++i) text += other(i);
  return text;
}
std::string at(const std::string& name, int level) {
  return name + std::to_string(level);
}

ChildResult check(const std::string& name, const std::string& text) {
  const Sandbox sandbox;
  sandbox.write(name, text);
  const ChildResult result = scenec::test::run_child(
      {"check", name}, {.directory = sandbox.path(), .file_size_limit = {}, .standard_output = {}});
  scenec::test::expect_bounded(result, name);
  return result;
}

void expect_limit(const std::string& name, const std::string& text, const std::string& code) {
  const ChildResult result = check(name, text);
  EXPECT_EQ(result.exit_code, 4) << name << "\n" << result.err.substr(0, 2000);
  EXPECT_EQ(scenec::test::located_errors(result.err, name), 1) << name << "\n"
                                                               << result.err.substr(0, 2000);
  EXPECT_NE(result.err.find("error[" + code + "]"), std::string::npos) << result.err;
}

TEST(Bombs, TenLevelsOfTenMacros) {
  const auto macros = [](const std::string& innermost) {
    return scene +
           levels(10, "macro m0() { " + innermost + "}\n",
                  [](int i) {
                    return "macro " + at("m", i) + "() { " + repeated(at("m", i - 1) + "(); ", 10) +
                           "}\n";
                  }) +
           "m10();\n" + ball;
  };
  expect_limit("macros.sdl", macros(ball), "E0721");
  // What places nothing takes time only.
  expect_limit("hollow.sdl", macros("assert true; "), "E0720");
}

TEST(Bombs, TenLevelsOfTenProtos) {
  const std::string text =
      scene +
      levels(10, "proto p0 { " + ball + "}\n",
             [](int i) {
               return "proto " + at("p", i) + " { " +
                      repeated("instance { of = " + at("p", i - 1) + "; } ", 10) + "}\n";
             }) +
      "instance { of = p10; }\n";
  const ChildResult result = check("protos.sdl", text);  // stored once each, but nested too deeply
  EXPECT_EQ(result.exit_code, 1) << result.err;
  EXPECT_EQ(scenec::test::located_errors(result.err, "protos.sdl"), 1) << result.err;
}

TEST(Bombs, DoublingStringsAndLists) {
  const auto doubling = [](const std::string& first, const std::string& join) {
    return scene +
           levels(40, "let s0 = " + first + ";\n",
                  [&](int i) {
                    return "let " + at("s", i) + " = " + join + "(" + at("s", i - 1) + ", " +
                           at("s", i - 1) + ");\n";
                  }) +
           "assert len(s40) > 0, \"x\";\n" + ball;
  };
  expect_limit("strings.sdl", doubling("\"ab\"", "str"), "E0722");
  expect_limit("lists.sdl", doubling("[1, 2]", "concat"), "E0723");
}

TEST(Bombs, ListsOfListsShareTheirElements) {
  const std::string text = scene +
                           levels(200, "let s0 = [1, 2];\n",
                                  [](int i) {
                                    return "let " + at("s", i) + " = [" + at("s", i - 1) + ", " +
                                           at("s", i - 1) + "];\n";
                                  }) +
                           "assert len(s200) == 2, \"x\";\n" + ball;
  EXPECT_EQ(check("nested.sdl", text).exit_code, 0);
}

TEST(Bombs, LoopsOverABillion) {
  const std::string loop = "for i in 0 ..< 1000000000 { ";
  expect_limit("loop.sdl", scene + loop + ball + "}\n", "E0721");
  expect_limit("loops.sdl", scene + repeated(loop, 3) + ball + repeated("}", 3) + "\n", "E0721");
  expect_limit("empty.sdl", scene + ball + loop + "}\n", "E0720");
  expect_limit(
      "list.sdl",
      scene + "sphere { radius = len([for i in 0 ..< 1000000000: i]); material = matt; }\n",
      "E0723");
  expect_limit("sums.sdl",
               scene + "fn f(n: int): num = sum([for i in 0 ..< 1000: n * i]);\n" +
                   "for i in 0 ..< 1000000000 { assert f(i) >= 0; }\n" + ball,
               "E0720");
}

TEST(Bombs, FunctionsThatCallEachOtherTwice) {
  const std::string text =
      scene +
      levels(60, "fn f0(x: num): num = x + 1;\n",
             [](int i) {
               const std::string call = at("f", i - 1) + "(x)";
               return "fn " + at("f", i) + "(x: num): num = " + call + " + " + call + ";\n";
             }) +
      "sphere { material = matt; radius = f60(1); }\n";
  expect_limit("functions.sdl", text, "E0720");
}

// Declarations are checked once where they stand, not once a path that leads to them.
TEST(Bombs, ADiamondOfIncludesIsReadOnceAFile) {
  const Sandbox sandbox;
  constexpr int deepest = 30;
  for (int i = 0; i <= deepest; ++i) {
    const std::string below = std::to_string(i + 1);
    for (const std::string side : {"a", "b"}) {
      std::string text = "sdl 1;\n";
      if (i < deepest) {
        text += "include \"a" + below + ".sdl\" as a;\ninclude \"b" + below + ".sdl\" as b;\n";
      }
      text += i < deepest ? "let x = a.x + b.x;\n" : "let x = 1;\n";
      sandbox.write(at(side, i) + ".sdl", text);
    }
  }
  sandbox.write("scene.sdl", scene +
                                 "include \"a0.sdl\" as a;\ninclude \"b0.sdl\" as b;\n"
                                 "assert a.x + b.x == 2147483648;\n" +
                                 ball);
  const ChildResult result = scenec::test::run_child(
      {"check", "scene.sdl"},
      {.directory = sandbox.path(), .file_size_limit = {}, .standard_output = {}});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  scenec::test::expect_bounded(result, "a diamond of includes");
  if (!SCENEC_IS_SANITIZED) {
    EXPECT_LE(result.cpu_seconds, 0.1);
  }
}

TEST(Bombs, IncludesNestedTooDeeply) {
  const Sandbox sandbox;
  for (int i = 1; i < 70; ++i) {
    const std::string next = std::to_string(i + 1);
    sandbox.write(at("n", i) + ".sdl",
                  "sdl 1;\ninclude \"n" + next + ".sdl\" as n;\nlet x = n.x;\n");
  }
  sandbox.write("n70.sdl", "sdl 1;\nlet x = 1;\n");
  sandbox.write("scene.sdl", scene + "include \"n1.sdl\" as n;\nassert n.x == 1;\n" + ball);
  const ChildResult result = scenec::test::run_child(
      {"check", "scene.sdl"},
      {.directory = sandbox.path(), .file_size_limit = {}, .standard_output = {}});
  EXPECT_EQ(result.exit_code, 4) << result.err;
  EXPECT_NE(result.err.find("error[E0724]"), std::string::npos) << result.err;
  EXPECT_EQ(result.err.find("error[", result.err.find("error[") + 1), std::string::npos)
      << result.err;
  scenec::test::expect_bounded(result, "includes 70 deep");
}

}  // namespace
