// Files made to break a reader: each compiles or is one located error within 2 s and 256 MiB.
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <string>

#include "tests/process/child.hpp"

namespace {

using scenec::test::ChildResult;
using scenec::test::Sandbox;

enum class Outcome { compiles, one_error };

// Everything is written to the file piece by piece: the memory of this process at the time of the
// fork counts as memory of the child.
using Writer = std::function<void(std::ostream&)>;

void repeat(std::ostream& out, const std::string& text, int count) {
  for (int i = 0; i < count; ++i) out << text;
}

void expect(const std::string& name, Outcome outcome, const Writer& write) {
  const Sandbox sandbox;
  {
    std::ofstream out(sandbox.path() / name, std::ios::binary);
    write(out);
  }
  const ChildResult result = scenec::test::run_child(
      {"check", name}, {.directory = sandbox.path(), .file_size_limit = {}, .standard_output = {}});
  const std::string shown = result.err.substr(0, 2000);
  if (outcome == Outcome::compiles) {
    EXPECT_EQ(result.exit_code, 0) << name << "\n" << shown;
  } else {
    EXPECT_TRUE(result.exit_code == 1 || result.exit_code == 4)
        << name << " " << result.exit_code << "\n"
        << shown;
    EXPECT_EQ(scenec::test::located_errors(result.err, name), 1) << name << "\n" << shown;
    EXPECT_LT(result.err.size(), 4000u) << name;
  }
  scenec::test::expect_bounded(result, name);
}

const std::string head = "sdl 1;\n";
const std::string rest =
    "sphere { radius = 1m; material = matt; }\n"
    "light: point { position = [0, 3, 3]; power = 60W; }\n"
    "camera main: pinhole { eye = [0, 0, 5]; aim = [0, 0, 0]; fov = 40deg; }\n";
const std::string scene = head + "material matt: diffuse { color = gray(0.5); }\n" + rest;

constexpr int deep = 200'000;

TEST(HostileInput, DeeplyNestedBrackets) {
  for (const char* const bracket : {"(", "[", "-", "!"}) {
    expect("brackets.sdl", Outcome::one_error, [&](std::ostream& out) {
      out << head << "let x = ";
      repeat(out, bracket, deep);
    });
  }
}

TEST(HostileInput, DeeplyNestedBalancedBrackets) {
  expect("balanced.sdl", Outcome::one_error, [&](std::ostream& out) {
    out << scene << "let x = ";
    repeat(out, "(", deep);
    out << "1";
    repeat(out, ")", deep);
    out << ";\n";
  });
}

TEST(HostileInput, DeeplyNestedBlocks) {
  expect("blocks.sdl", Outcome::one_error, [](std::ostream& out) {
    out << scene;
    repeat(out, "group {\n", deep);
    repeat(out, "}\n", deep);
  });
  expect("blocks.txt", Outcome::one_error, [](std::ostream& out) {
    repeat(out, "Group { numObjects 1 ", deep);
    repeat(out, "} ", deep);
  });
}

TEST(HostileInput, ASumOfAMillionTerms) {
  expect("sum.sdl", Outcome::compiles, [](std::ostream& out) {
    out << scene << "let x = 1";
    repeat(out, "+1", 1'000'000);
    out << ";\n@allow(unused_declaration) let y = x;\n";
  });
}

TEST(HostileInput, ALineOf64Mebibytes) {
  constexpr int block = 1 << 16;
  expect("line.sdl", Outcome::one_error, [](std::ostream& out) {
    out << head << "let x = ";
    repeat(out, std::string(block, 'a'), 1024);
    out << ";\n";
  });
  expect("line.txt", Outcome::one_error,
         [](std::ostream& out) { repeat(out, std::string(block, 'a'), 1024); });
  expect("comment.sdl", Outcome::one_error, [](std::ostream& out) {
    out << scene << "// ";
    repeat(out, std::string(block, 'x'), 1024);
    out << "\n";
  });
  expect("dense.sdl", Outcome::one_error, [](std::ostream& out) {
    out << scene << "let x = 1";
    repeat(out, "+1", 32 << 20);
    out << ";\n";
  });
  expect("dense.txt", Outcome::one_error, [](std::ostream& out) { repeat(out, "1 ", 32 << 20); });
}

TEST(HostileInput, EmptyFiles) {
  for (const char* const text : {"", "\n", "// nothing\n", "\xEF\xBB\xBF"}) {
    expect("empty.sdl", Outcome::one_error, [&](std::ostream& out) { out << text; });
    expect("empty.txt", Outcome::one_error, [&](std::ostream& out) { out << text; });
  }
}

TEST(HostileInput, BytesThatAreNoText) {
  expect("nul.sdl", Outcome::one_error, [](std::ostream& out) { out << scene << '\0' << '\n'; });
  expect("latin.sdl", Outcome::one_error,
         [](std::ostream& out) { out << scene << "// caf\xE9\n"; });
  expect("inside.sdl", Outcome::one_error,
         [](std::ostream& out) { out << scene << "let \xFF = 1;\n"; });
  expect("zeros.sdl", Outcome::one_error,
         [](std::ostream& out) { repeat(out, std::string(4096, '\0'), 256); });
  expect("zeros.txt", Outcome::one_error,
         [](std::ostream& out) { repeat(out, std::string(4096, '\0'), 256); });
}

TEST(HostileInput, ByteOrderMarkAndCarriageReturnsAreText) {
  expect("windows.sdl", Outcome::compiles, [](std::ostream& out) {
    out << "\xEF\xBB\xBF";
    for (const char c : scene) {
      if (c == '\n') out << '\r';
      out << c;
    }
  });
}

}  // namespace
