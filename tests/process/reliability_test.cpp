// The list of bad inputs every release must answer well (B01 to B24 and B37 to B39 of the
// reliability rules), one case each where no other test has it: one mistake, its code, its place,
// the right exit code, 2 s and 256 MiB. Others: hostile_input_test.cpp (B02, B04-B06),
// foreign_files_test.cpp (B11, B13, B15), bombs_test.cpp (B12, B16-B18), output_test.cpp (B35).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <clocale>
#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include "tests/process/child.hpp"

namespace {

namespace fs = std::filesystem;
using scenec::test::ChildResult;
using scenec::test::Sandbox;
using testing::HasSubstr;

const std::string rest =
    "material matt: diffuse { color = gray(0.5); }\n"
    "sphere { radius = 1m; material = matt; }\n"
    "light: point { position = [0, 3, 3]; power = 60W; }\n";
const std::string camera =
    "camera main: pinhole { eye = [0, 0, 5]; aim = [0, 0, 0]; fov = 40deg; }\n";

ChildResult run(const Sandbox& sandbox, const std::vector<std::string>& words) {
  return scenec::test::run_child(
      words, {.directory = sandbox.path(), .file_size_limit = {}, .standard_output = {}});
}

// One line in a scene that has everything else.
struct Case {
  const char* rule;
  const char* line;
  const char* code;     // empty: compiles
  const char* message;  // part of it
  int errors = 1;
};
std::ostream& operator<<(std::ostream& out, const Case& one) {
  return out << one.rule << " " << one.line;
}

class Line : public testing::TestWithParam<Case> {};

TEST_P(Line, IsAnsweredWell) {
  const Case& one = GetParam();
  const bool has_camera = std::string(one.line).starts_with("camera");
  const Sandbox sandbox;
  sandbox.write("scene.sdl",
                "sdl 1;\n" + std::string(one.line) + "\n" + rest + (has_camera ? "" : camera));
  const ChildResult result = run(sandbox, {"check", "scene.sdl"});
  scenec::test::expect_bounded(result, one.line);
  EXPECT_THAT(result.err, HasSubstr(one.message));
  if (std::string(one.code).empty()) {
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return;
  }
  EXPECT_EQ(result.exit_code, 1) << result.err;
  EXPECT_EQ(scenec::test::located_errors(result.err, "scene.sdl"), one.errors) << result.err;
  EXPECT_THAT(result.err, HasSubstr("scene.sdl:2:"));
  EXPECT_THAT(result.err, HasSubstr("error[" + std::string(one.code) + "]"));
}

// B07: numbers.
INSTANTIATE_TEST_SUITE_P(
    Numbers, Line,
    testing::Values(Case{"B07", "let x = 1e400;", "E0221", "beyond the largest number"},
                    Case{"B07", "assert -1.07797e-046 < 0;", "", ""},
                    Case{"B07", "assert 4.9e-324 > 0;", "", ""},
                    Case{"B07", "let x = 0x10;", "E0222", "there is no unit `x10`"},
                    Case{"B07", "let x = 1e;", "E0222", "there is no unit `e`"},
                    Case{"B07", "let x = 1__0;", "E0222", "there is no unit `__0`"},
                    Case{"B07", "let x = inf;", "E0201", "there is no `inf` here"},
                    Case{"B07", "let x = nan;", "E0201", "there is no `nan` here"},
                    Case{"B07", "let x = 1e308 * 10;", "E0216", "the result of `*` is infinite"},
                    Case{"B07", "let x = 1 / 0;", "E0217", ""}));

// B09, B10, B20, B21: names and types.
INSTANTIATE_TEST_SUITE_P(
    Names, Line,
    testing::Values(Case{"B09", "sphere { raduis = 1; material = matt; }", "E0203", "", 2},
                    Case{"B09", "render { sise = [2, 2]; }", "E0223", "did you mean `size`?"},
                    Case{"B09", "spere { }", "E0228", "did you mean `sphere`?"},
                    Case{"B10", "let a = 1; let a = 2;", "E0202", "scene.sdl:2:5: note"},
                    Case{"B10", "let a = b; let b = 1;", "E0203", "scene.sdl:2:16: note"},
                    Case{"B10", "let a = a;", "E0203", ""},
                    Case{"B16", "fn f(x: num): num = f(x);", "E0244", "`f` calls itself"},
                    Case{"B16", "macro m() { m(); }", "E0244", "`m` calls itself"},
                    Case{"B16", "fn g(x: num): num = h(x); fn h(x: num): num = g(x);", "E0206", ""},
                    Case{"B20", "let x = tan(90);", "E0212", "replace `90` by `90deg`"},
                    Case{"B20", "let x = 1m + 1s;", "E0211", ""},
                    Case{"B20", "let x = dot([1, 2], [1, 2, 3]);", "E0210", ""},
                    Case{"B20", "let x: point = [1, 2];", "E0210", ""},
                    Case{"B20", "let x = [1, \"a\"];", "E0220", ""},
                    Case{"B21", "let a = 1; fn f(a: num): num = a;", "", "L0202"},
                    Case{"B21", "let unused = 1;", "", "L0201"}));

// B22 to B24: values out of their ranges.
INSTANTIATE_TEST_SUITE_P(
    Values, Line,
    testing::Values(
        Case{"B22", "render { size = [0, 5]; }", "E0230", "needs a value from 1 to 65535"},
        Case{"B22", "render { size = [-1, 5]; }", "E0230", "needs a value from 1 to 65535"},
        Case{"B22", "render { size = [1000000000, 5]; }", "E0230", "`size` is 1000000000;"},
        Case{"B22", "render { size = [65535, 65535]; }", "E0230", "needs at most 268435456"},
        Case{"B22", "render { samples = 0; }", "E0230", "needs a value from 1 to 1048576"},
        Case{"B22", "render { samples = 2147483648; }", "E0230", "`samples` is 2147483648;"},
        Case{"B22", "render { max_depth = -1; }", "E0230", "needs a value from 0 to 1024"},
        Case{"B22", "render { filter = tent(0); }", "E0236", "needs a radius above 0"},
        Case{"B22", "render { filter = box(2147483300); }", "E0236", "of at most 32 pixels"},
        Case{"B23", "camera c: pinhole { eye = [0, 0, 0]; direction = [0, 1, 0]; fov = 1deg; }",
             "E0308", "looks along its `up`"},
        Case{"B23", "camera c: pinhole { eye = [0, 0, 0]; direction = [0, 0, 0]; fov = 1deg; }",
             "E0237", "`direction` is zero"},
        Case{"B23", "camera c: pinhole { eye = [0, 0, 0]; aim = [0, 0, 0]; fov = 1deg; }", "E0308",
             "looks at the point where it stands"},
        Case{"B23", "camera c: pinhole { eye = [0, 0, 0]; aim = [0, 0, 1]; fov = 0deg; }", "E0230",
             "above 0 deg and below 180 deg"},
        Case{"B23", "camera c: pinhole { eye = [0, 0, 0]; aim = [0, 0, 1]; fov = 180deg; }",
             "E0230", "above 0 deg and below 180 deg"},
        Case{"B23",
             "camera c: thin_lens { eye = [0, 0, 0]; aim = [0, 0, 1]; fov = 9deg; focus = 0m; "
             "aperture = 1mm; }",
             "E0230", "`focus` is 0 m"},
        Case{"B23",
             "camera c: thin_lens { eye = [0, 0, 0]; aim = [0, 0, 1]; fov = 9deg; focus = 1m; "
             "aperture = -1mm; }",
             "E0230", "`aperture` is -0.001 m"},
        Case{"B24", "sphere { radius = 0; }", "E0230", "`radius` is 0 m"},
        Case{"B24", "sphere { radius = -1; }", "E0230", "`radius` is -1 m"},
        Case{"B24", "sphere { radius = 1e200m * 1e200; }", "E0216", "is infinite"},
        Case{"B24", "plane { normal = [0, 0, 0]; }", "E0237", "`normal` is zero"},
        Case{"B24", "group { transform = scale(0); sphere { } }", "E0238", "cannot be inverted"},
        Case{"B24", "group { transform = scale([1, 1, 1e-13]); sphere { } }", "E0238",
             "accumulated: matrix("},
        Case{"B24", "group { transform = [scale(1e308), scale(1e308)]; sphere { } }", "E0238",
             "beyond the largest number"},
        Case{"B24", "revolve { profile = polyline([[1, 0]]); }", "E0240", "at least 2 points"}));

// Whole files.
struct FileCase {
  const char* rule;
  const char* name;
  const char* text;
  int exit_code;
  const char* code;
  const char* message;
};
std::ostream& operator<<(std::ostream& out, const FileCase& one) {
  return out << one.rule << " " << one.name;
}
class File : public testing::TestWithParam<FileCase> {};

TEST_P(File, IsAnsweredWell) {
  const FileCase& one = GetParam();
  const Sandbox sandbox;
  sandbox.write(one.name, one.text);
  const ChildResult result = run(sandbox, {"check", one.name});
  scenec::test::expect_bounded(result, std::string(one.rule) + " " + one.name);
  EXPECT_EQ(result.exit_code, one.exit_code) << result.err;
  EXPECT_EQ(scenec::test::located_errors(result.err, one.name), 1) << result.err;
  EXPECT_THAT(result.err, HasSubstr("error[" + std::string(one.code) + "]"));
  EXPECT_THAT(result.err, HasSubstr(one.message));
}

INSTANTIATE_TEST_SUITE_P(
    Files, File,
    testing::Values(
        FileCase{"B01", "empty.sdl", "", 1, "E0103", "the first statement must be `sdl 1;`"},
        FileCase{"B01", "empty.txt", "", 1, "E0405", ""},
        FileCase{"B01", "comments.sdl", "// nothing\n/* at all */\n", 1, "E0103", ":3:1"},
        FileCase{"B01", "edition.sdl", "sdl 1;\n", 1, "E0301", ":2:1"},
        FileCase{"B02", "nul.sdl", "sdl 1;\nlet x = \x01;\n", 1, "E0123", ":2:9"},
        FileCase{"B02", "bytes.sdl", "sdl 1;\n// \xC3\xA4\xFF\n", 1, "E0124", ":2:5"},
        FileCase{"B02", "bidi.sdl", "sdl 1;\n// \xE2\x80\xAE\n", 1, "E0125", ":2:4"},
        FileCase{"B03", "string.sdl", "sdl 1;\nlet x = \"abc\nlet y = 1;\n", 1, "E0116", ":2:9"},
        FileCase{"B03", "comment.sdl", "sdl 1;\n/* abc\n", 1, "E0117", ":2:1"},
        FileCase{"B03", "brace.sdl", "sdl 1;\ngroup {\n", 1, "E0118", ":2:7"},
        FileCase{"B38", "course.sdl",
                 "PerspectiveCamera { center 0 0 10 direction 0 0 -1 up 0 1 0 angle 30 width 2 "
                 "height 2 }\nBackground { color 0 0 0 }\nGroup { numObjects 0 }\n",
                 1, "E0103", "--dialect course"},
        FileCase{"B38", "native.txt",
                 "material m: diffuse { color = white; }\nsphere { material = m; }\n", 1, "E0103",
                 "sdl 1;"},
        FileCase{"B39", "future.sdl", "sdl 2;\nsphere { }\n", 1, "E0104", "knows edition 1"},
        FileCase{"B39", "past.sdl", "sdl 0;\nsphere { }\n", 1, "E0104", "knows edition 1"}));

TEST(Reliability, TwoThousandErrorsAreAHundredAndACount) {  // B19
  const Sandbox sandbox;
  std::string text = "sdl 1;\n" + rest + camera;
  for (int i = 0; i < 2000; ++i) text += "let x" + std::to_string(i) + " = nobody;\n";
  sandbox.write("scene.sdl", text);
  const ChildResult first = run(sandbox, {"check", "scene.sdl"});
  scenec::test::expect_bounded(first, "2000 errors");
  EXPECT_EQ(first.exit_code, 1);
  EXPECT_EQ(scenec::test::located_errors(first.err, "scene.sdl"), 100);
  EXPECT_THAT(first.err, HasSubstr("\nand 1900 more\n2000 errors\n"));
  EXPECT_EQ(run(sandbox, {"check", "scene.sdl"}).err, first.err);
}

TEST(Reliability, ACommaLocaleChangesNothing) {  // B08
  const Sandbox sandbox;
  sandbox.write("scene.sdl", "sdl 1;\nlet x = 0.25;\n" + rest +
                                 "sphere { center = [x, 1.5, 0]; material = matt; }\n" + camera);
  const ChildResult plain = run(sandbox, {"dump", "scene.sdl"});
  ASSERT_EQ(::setenv("LC_ALL", "de_DE.UTF-8", 1), 0);
  const ChildResult comma = run(sandbox, {"dump", "scene.sdl"});
  ASSERT_EQ(::unsetenv("LC_ALL"), 0);
  EXPECT_EQ(plain.exit_code, 0) << plain.err;
  EXPECT_THAT(plain.out, HasSubstr("center = [0.25, 1.5, 0]"));
  EXPECT_EQ(comma.out, plain.out);
}

TEST(Reliability, OddNamesOfFilesAreShownEscaped) {  // B15
  const Sandbox sandbox;
  const auto expect = [&](const std::string& path, const std::string& shown) {
    sandbox.write("scene.sdl", "sdl 1;\ninclude \"" + path + "\" as other;\n" + rest + camera);
    const ChildResult result = run(sandbox, {"check", "scene.sdl"});
    scenec::test::expect_bounded(result, path);
    EXPECT_EQ(result.exit_code, 1) << result.err;
    EXPECT_EQ(scenec::test::located_errors(result.err, "scene.sdl"), 1) << result.err;
    EXPECT_THAT(result.err, HasSubstr("error[E0601]: cannot read \"" + shown + "\""));
  };
  expect("~/x.sdl", "~/x.sdl");
  expect("C:\\\\x.sdl", "C:\\\\x.sdl");
  expect("\\\\\\\\host\\\\x.sdl", "\\\\\\\\host\\\\x.sdl");
  expect("a\\nb.sdl", "a\\nb.sdl");
  expect(std::string(300, 'x') + ".sdl", std::string(300, 'x') + ".sdl");
  expect(".", ".");
}

TEST(Reliability, ACycleThroughALinkIsFound) {  // B11
  const Sandbox sandbox;
  sandbox.write("a.sdl", "sdl 1;\ninclude \"alias.sdl\" as other;\nlet x = other.x;\n");
  fs::create_symlink("a.sdl", sandbox.path() / "alias.sdl");
  sandbox.write("scene.sdl", "sdl 1;\ninclude \"a.sdl\" as a;\nassert a.x == 1;\n" + rest + camera);
  const ChildResult result = run(sandbox, {"check", "scene.sdl"});
  scenec::test::expect_bounded(result, "a cycle through a link");
  EXPECT_EQ(result.exit_code, 1) << result.err;
  EXPECT_THAT(result.err, HasSubstr("error[E0244]"));
  EXPECT_EQ(result.err.find("error[", result.err.find("error[") + 1), std::string::npos)
      << result.err;
}

TEST(Reliability, CommandLinesThatAreWrong) {  // B37
  const Sandbox sandbox;
  sandbox.write("a.sdl", scenec::test::small_scene);
  const auto expect = [&](const std::vector<std::string>& words, const std::string& message) {
    const ChildResult result = run(sandbox, words);
    scenec::test::expect_bounded(result, words.empty() ? "" : words.back());
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_THAT(result.err, HasSubstr(message));
    EXPECT_LT(result.err.size(), 2000u);
  };
  expect({}, "needs the name of a scene file");
  expect({"check", "--nope", "a.sdl"}, "unknown option `--nope`");
  expect({"check", "a.sdl", "a.sdl"}, "takes one scene at a time");
  expect({"check", "-"}, "not from standard input");
  expect(std::vector<std::string>(10'000, "a.sdl"), "takes one scene at a time");
  expect({"check", "a.sdl", "-D", std::string(100'000, 'x')}, "needs");
  expect({"check", "a.sdl", "-D", "nobody=1"}, "nobody");
}

TEST(Reliability, NothingLitIsABlackPictureAndAWarning) {  // B26
  const Sandbox sandbox;
  sandbox.write("scene.sdl",
                "sdl 1;\nmaterial m: diffuse { color = white; }\n"
                "sphere { material = m; }\nrender { size = [4, 4]; samples = 1; }\n" +
                    camera);
  const ChildResult result = run(sandbox, {"scene.sdl", "-o", "out.png"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("warning[L"));
  EXPECT_TRUE(scenec::test::bytes_of(sandbox.path() / "out.png").starts_with("\x89PNG"));
}

}  // namespace
