// What other programs make of scenec: make and ninja of its dependency files, shells of its
// completions, groff and mandoc of its manual page, a JSON reader of its schema. A tool that is not
// installed is named and skipped.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include "tests/process/child.hpp"

namespace {

namespace fs = std::filesystem;
using scenec::test::bytes_of;
using scenec::test::Sandbox;
using testing::HasSubstr;

struct ShellResult {
  int exit_code;
  std::string output;  // of both streams
};

class Tools : public testing::Test {
 protected:
  // `scenec` is on the path.
  [[nodiscard]] ShellResult shell(const std::string& command) const {
    const std::string folder = fs::path(SCENEC_BINARY).parent_path().string();
    sandbox_.write("command.sh", "cd \"$(dirname \"$0\")\"\nPATH=" + folder + ":$PATH\n" + command);
    const std::string line =
        "bash '" + (sandbox_.path() / "command.sh").string() + "' 2>&1 </dev/null";
    std::FILE* const pipe = ::popen(line.c_str(), "r");
    if (pipe == nullptr) return {-1, "cannot start a shell"};
    std::string output;
    std::array<char, 4096> buffer{};
    for (std::size_t size = 0; (size = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) {
      output.append(buffer.data(), size);
    }
    const int status = ::pclose(pipe);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, output};
  }
  [[nodiscard]] bool has(const std::string& tool) const {
    return shell("command -v " + tool).exit_code == 0;
  }
  void put(const std::string& name, const std::string& text) const { sandbox_.write(name, text); }
  [[nodiscard]] std::string get(const std::string& name) const {
    return bytes_of(sandbox_.path() / name);
  }
  // Newer than anything written so far.
  void touch(const std::string& name) const {
    clock_ += std::chrono::seconds(2);
    fs::last_write_time(sandbox_.path() / name, clock_);
  }

  // A scene that includes these files by their names as written.
  static std::string scene_with(const std::vector<std::string>& includes) {
    std::string text = "sdl 1;\n";
    for (std::size_t i = 0; i < includes.size(); ++i) {
      text += "@allow(unused_declaration) include \"" + includes[i] + "\" as lib" +
              std::to_string(i) + ";\n";
    }
    return text + scenec::test::small_scene.substr(7);
  }

  Sandbox sandbox_;
  mutable fs::file_time_type clock_ = fs::file_time_type::clock::now();
};

// ---- make and ninja -----------------------------------------------------------------------------

// Names that hold what the two give a meaning. (A backslash just before `#` is the one thing they
// read differently: there make's way is written.)
const std::vector<std::string> odd_names{"a b.sdl",  "c:d.sdl",   "e#f.sdl", "g$h.sdl",
                                         "i\\j.sdl", "k\\ l.sdl", "m%n.sdl"};

std::string in_source(const std::string& name) {  // as a string of the language
  std::string text;
  for (const char c : name) text += c == '\\' ? std::string("\\\\") : std::string(1, c);
  return text;
}

class Builds : public Tools {
 protected:
  void SetUp() override {
    std::vector<std::string> written;
    for (const std::string& name : odd_names) {
      put(name, "sdl 1;\nlet x = 1;\n");
      written.push_back(in_source(name));
    }
    put("scene.sdl", scene_with(written));
  }
  // Builds until nothing is left to do; then once more after each file has changed.
  void expect_rebuilds(const std::string& build) {
    ASSERT_EQ(shell(build).exit_code, 0) << shell(build).output;
    ASSERT_EQ(shell(build).exit_code, 0);
    EXPECT_EQ(get("log"), "ran\n") << get("out.d");
    std::string ran = "ran\n";
    for (const std::string& name : odd_names) {
      touch(name);
      const ShellResult result = shell(build);
      ASSERT_EQ(result.exit_code, 0) << result.output;
      ran += "ran\n";
      EXPECT_EQ(get("log"), ran) << name << "\n" << get("out.d");
      touch("out.png");  // later than the file just touched
    }
  }
  // An include that is missing fails; its appearance alone builds again.
  void expect_healing(const std::string& build) {
    fs::rename(sandbox_.path() / odd_names[0], sandbox_.path() / "aside");
    EXPECT_NE(shell(build).exit_code, 0);
    EXPECT_NE(shell(build).exit_code, 0) << "a failed build is tried again";
    EXPECT_THAT(get("out.d"), HasSubstr("a\\ b.sdl"));
    fs::rename(sandbox_.path() / "aside", sandbox_.path() / odd_names[0]);
    touch(odd_names[0]);
    const ShellResult result = shell(build);
    EXPECT_EQ(result.exit_code, 0) << result.output;
  }
};

const std::string render = "scenec scene.sdl -o out.png --progress none -MD -MF out.d";

TEST_F(Builds, NinjaBuildsAgainWhenAnIncludeChangesOrAppears) {
  if (!has("ninja")) GTEST_SKIP() << "ninja is not installed";
  put("build.ninja", "rule render\n  command = " + render +
                         " && echo ran >> log\n  depfile = out.d\n"
                         "build out.png: render scene.sdl\n");
  expect_rebuilds("ninja");
  expect_healing("ninja");
}

TEST_F(Builds, NinjaWithItsOwnStoreOfDependencies) {
  if (!has("ninja")) GTEST_SKIP() << "ninja is not installed";
  put("build.ninja", "rule render\n  command = " + render +
                         " && echo ran >> log\n  depfile = out.d\n  deps = gcc\n"
                         "build out.png: render scene.sdl\n");
  const std::string build = "ninja";
  ASSERT_EQ(shell(build).exit_code, 0) << shell(build).output;
  ASSERT_EQ(shell(build).exit_code, 0);
  EXPECT_EQ(get("log"), "ran\n");
  touch(odd_names[1]);
  ASSERT_EQ(shell(build).exit_code, 0);
  EXPECT_EQ(get("log"), "ran\nran\n");
}

TEST_F(Builds, MakeBuildsAgainWhenAnIncludeChangesOrAppears) {
  if (!has("make")) GTEST_SKIP() << "make is not installed";
  put("Makefile", "out.png: scene.sdl\n\t@" + render + " && echo ran >> log\n-include out.d\n");
  expect_rebuilds("make");
  expect_healing("make");
}

TEST_F(Builds, MakeForgetsAFileThatIsGoneWithPhonyRules) {
  if (!has("make")) GTEST_SKIP() << "make is not installed";
  put("Makefile", "out.png: scene.sdl\n\t@" + render + " -MP && echo ran >> log\n-include out.d\n");
  ASSERT_EQ(shell("make").exit_code, 0);
  fs::remove(sandbox_.path() / odd_names[0]);
  put("scene.sdl", scene_with({in_source(odd_names[1])}));
  touch("scene.sdl");
  const ShellResult result = shell("make");
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_EQ(get("log"), "ran\nran\n");
}

// One file of dependencies for all frames: every picture is a target, every file any frame reads
// stands there.
TEST_F(Tools, FramesShareANamedDependencyFile) {
  put("early.sdl", "sdl 1;\nlet x = 1;\n");
  put("tri.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  put("scene.sdl",
      "sdl 1;\ninclude \"early.sdl\" as early;\n@clock param t: time = 0s in 0s .. 10s;\n" +
          scenec::test::small_scene.substr(7) +
          "if t < 0.5s { mesh { file = \"tri.obj\"; material = matt; } }\n"
          "assert early.x == 1;\n");
  const std::string render_frames =
      "scenec scene.sdl -o 'out ##.png' --frames 0..2 --fps 1 --progress none -MD -MF frames.d";
  ASSERT_EQ(shell(render_frames).exit_code, 0) << shell(render_frames).output;
  EXPECT_EQ(
      get("frames.d"),
      "out\\ 00.png out\\ 01.png out\\ 02.png: \\\n  scene.sdl \\\n  early.sdl \\\n  tri.obj\n");
  // A `#` in the name asks for one file a frame.
  ASSERT_EQ(shell(render_frames + "'#.d'").exit_code, 0);
  ASSERT_EQ(shell("scenec scene.sdl -o 'out ##.png' --frames 0..1 --fps 1 --progress none -MD -MF "
                  "'f#.d'")
                .exit_code,
            0);
  EXPECT_EQ(get("f0.d"), "out\\ 00.png: \\\n  scene.sdl \\\n  early.sdl \\\n  tri.obj\n");
  EXPECT_EQ(get("f1.d"), "out\\ 01.png: \\\n  scene.sdl \\\n  early.sdl\n");
  if (!has("make")) return;
  put("Makefile", "out\\ 00.png:\n\t@exit 1\n-include frames.d\n");
  EXPECT_EQ(shell("make -q 'out 00.png'").exit_code, 0) << shell("make -q 'out 00.png'").output;
  touch("tri.obj");
  EXPECT_NE(shell("make -q 'out 00.png'").exit_code, 0);
}

// ---- shells -------------------------------------------------------------------------------------

TEST_F(Tools, CompletionsAreSoundScripts) {
  int checked = 0;
  for (const std::string name : {"bash", "zsh", "fish"}) {
    if (!has(name)) {
      std::printf("%s is not installed: not checked\n", name.c_str());
      continue;
    }
    const ShellResult result =
        shell("scenec completion " + name + " > script && " + name + " -n script");
    EXPECT_EQ(result.exit_code, 0) << name << "\n" << result.output;
    EXPECT_EQ(result.output, "") << name;
    ++checked;
  }
  EXPECT_GT(checked, 0);
}

TEST_F(Tools, BashCompletes) {
  put("a b.sdl", scenec::test::small_scene);
  put("other.png", "");
  const auto completed = [&](const std::string& words) {
    return shell("source <(scenec completion bash)\nCOMP_WORDS=(" + words +
                 ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_scenec\n"
                 "printf '%s\\n' \"${COMPREPLY[@]}\"")
        .output;
  };
  EXPECT_EQ(completed("scenec render --method ''"), "path\nwhitted\nphong\n");
  EXPECT_EQ(completed("scenec render --method = wh"), "whitted\n");
  EXPECT_EQ(completed("scenec ren"), "render\n");
  EXPECT_EQ(completed("scenec check --diag"), "--diagnostics\n");
  EXPECT_EQ(completed("scenec check a"), "a b.sdl\n");
  EXPECT_EQ(completed("scenec check oth"), "\n");
  EXPECT_EQ(completed("scenec completion ''"), "bash\nzsh\nfish\n");
}

// ---- manual and schema --------------------------------------------------------------------------

TEST_F(Tools, TheManualPageHasNoFault) {
  int checked = 0;
  for (const std::string tool : {"groff -man -ww -z -Tutf8", "mandoc -Tlint -Wwarning",
                                 "man --warnings -l --pager=cat -E UTF-8"}) {
    if (!has(tool.substr(0, tool.find(' ')))) {
      std::printf("%s is not installed: not checked\n", tool.c_str());
      continue;
    }
    const std::string output = tool.starts_with("man ") ? " > /dev/null" : "";
    const ShellResult result =
        shell("scenec manual > scenec.1 && " + tool + " ./scenec.1" + output);
    EXPECT_EQ(result.exit_code, 0) << tool << "\n" << result.output;
    EXPECT_EQ(result.output, "") << tool;
    ++checked;
  }
  if (checked == 0) GTEST_SKIP() << "neither groff nor mandoc nor man is installed";
}

TEST_F(Tools, EveryKindHasItsSchemaInBothForms) {
  const ShellResult all = shell("scenec schema");
  EXPECT_EQ(all.exit_code, 0);
  std::size_t kinds = 0;
  const std::string mark = "\n    \"name\": \"";
  for (std::size_t at = all.output.find(mark); at != std::string::npos;
       at = all.output.find(mark, at + 1)) {
    const std::size_t begin = at + mark.size();
    const std::string name = all.output.substr(begin, all.output.find('"', begin) - begin);
    const ShellResult one = shell("scenec schema --markdown " + name);
    EXPECT_EQ(one.exit_code, 0) << name;
    EXPECT_THAT(one.output, HasSubstr(" `" + name + "`\n"));
    EXPECT_THAT(one.output, HasSubstr("| key | type | default | range | meaning |"));
    ++kinds;
  }
  EXPECT_GT(kinds, 30u);
  if (has("jq")) {
    EXPECT_EQ(
        shell("scenec schema | jq -e 'all(.[]; .name and .doc and (.keys | type) == \"array\" "
              "and all(.keys[]; .name and .type and .doc and has(\"required\")))'")
            .output,
        "true\n");
  }
}

}  // namespace
