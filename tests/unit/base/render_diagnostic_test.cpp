#include "base/render_diagnostic.hpp"

#include <gtest/gtest.h>

#include <chrono>

#include "base/text.hpp"

namespace scenec {
namespace {

constexpr DiagnosticKind kind = DiagnosticKind::file_unreadable;

class RenderDiagnostic : public testing::Test {
 protected:
  void load(std::string text) { file = sources.add("dir/scene.sdl", std::move(text)); }
  // The span of the first occurrence of `part`.
  Span at(std::string_view part) const {
    const auto begin = static_cast<std::uint32_t>(sources.text(file).find(part));
    return {file, begin, begin + static_cast<std::uint32_t>(part.size())};
  }
  std::string render(const Diagnostic& diagnostic) const {
    return render_terminal(diagnostic, sources, options);
  }
  std::vector<std::string_view> lines(std::string_view text) const {
    std::vector<std::string_view> result;
    while (!text.empty()) {
      result.push_back(text.substr(0, text.find('\n')));
      text.remove_prefix(result.back().size() + 1);
    }
    return result;
  }

  SourceMap sources;
  FileId file;
  RenderOptions options;
};

TEST_F(RenderDiagnostic, ShowsLineAndCarets) {
  load("sdl 1;\nsphere { radus = 1; }\n");
  EXPECT_EQ(render({kind, at("radus"), "unknown key `radus`"}),
            "dir/scene.sdl:2:10: error[E0601]: unknown key `radus`\n"
            "    2 | sphere { radus = 1; }\n"
            "      |          ^^^^^\n");
}

TEST_F(RenderDiagnostic, ShowsEverythingADiagnosticCarries) {
  load("let a = 60;\nfov = a;\ncamera main {}\n");
  const Diagnostic diagnostic = Diagnostic(kind, at("a;"), "a plain number is no angle")
                                    .label(at("a;"), "this is 60")
                                    .label(at("fov"), "needs an angle")
                                    .label(at("60"), "comes from here")
                                    .note("angles carry `deg` or `rad`")
                                    .note("the camera is here", at("camera"))
                                    .hint("did you mean `60deg`?")
                                    .fix({file, 10, 10}, "deg");
  EXPECT_EQ(render(diagnostic),
            "dir/scene.sdl:2:7: error[E0601]: a plain number is no angle\n"
            "    2 | fov = a;\n"
            "      |       ^^ this is 60\n"
            "      | --- needs an angle\n"
            "  --> dir/scene.sdl:1:9\n"
            "    1 | let a = 60;\n"
            "      |         -- comes from here\n"
            "note: angles carry `deg` or `rad`\n"
            "dir/scene.sdl:3:1: note: the camera is here\n"
            "    3 | camera main {}\n"
            "      | ^^^^^^\n"
            "help: did you mean `60deg`?\n"
            "help: insert `deg` at dir/scene.sdl:1:11\n");
}

TEST_F(RenderDiagnostic, NamesTheKindsOfFixes) {
  load("a 1 m b");
  EXPECT_EQ(render(Diagnostic(kind, at("1 m"), "x").fix(at("1 m"), "1m").fix(at("b"), "")),
            "dir/scene.sdl:1:3: error[E0601]: x\n"
            "    1 | a 1 m b\n"
            "      |   ^^^\n"
            "help: replace `1 m` by `1m`\n"
            "help: remove `b` at dir/scene.sdl:1:7\n");
}

TEST_F(RenderDiagnostic, WithoutAPlaceTheProgramSpeaks) {
  load("");
  EXPECT_EQ(render(Diagnostic(kind, {}, "cannot read `x.sdl`").hint("check the path")),
            "scenec: error[E0601]: cannot read `x.sdl`\n"
            "help: check the path\n");
  EXPECT_EQ(render(Diagnostic(kind, {}, "odd").label({}, "nowhere")),
            "scenec: error[E0601]: odd\n");
}

TEST_F(RenderDiagnostic, LabelsOfADiagnosticWithoutPlaceKeepTheirs) {
  load("one\ntwo\n");
  EXPECT_EQ(render(Diagnostic(kind, {}, "odd").label(at("two"), "this")),
            "scenec: error[E0601]: odd\n"
            "  --> dir/scene.sdl:2:1\n"
            "    2 | two\n"
            "      | --- this\n");
}

TEST_F(RenderDiagnostic, CaretsStandUnderWideSigns) {
  load("let 木 = \"😀é\" + x;");
  EXPECT_EQ(render({kind, at("木"), "wide"}),
            "dir/scene.sdl:1:5: error[E0601]: wide\n"
            "    1 | let 木 = \"😀é\" + x;\n"
            "      |     ^^\n");
  EXPECT_EQ(render({kind, at("x"), "behind"}),
            "dir/scene.sdl:1:16: error[E0601]: behind\n"
            "    1 | let 木 = \"😀é\" + x;\n"
            "      |                  ^\n");
}

TEST_F(RenderDiagnostic, TabsAreExpanded) {
  load("\tab\tcd");
  EXPECT_EQ(render({kind, at("cd"), "tab"}),
            "dir/scene.sdl:1:5: error[E0601]: tab\n"
            "    1 |     ab  cd\n"
            "      |         ^^\n");
}

TEST_F(RenderDiagnostic, ControlCharactersDoNotReachTheTerminal) {
  load(std::string("a\x1b[31mb\0c\xff d", 12));
  EXPECT_EQ(render({kind, at("d"), "message with \x1b and \n"}),
            "dir/scene.sdl:1:12: error[E0601]: message with \\u{1b} and \\n\n"
            "    1 | a\\u{1b}[31mb\\u{0}c\\xff d\n"
            "      |                        ^\n");
  EXPECT_EQ(render({kind, {file, 1, 2}, "the escape"}),
            "dir/scene.sdl:1:2: error[E0601]: the escape\n"
            "    1 | a\\u{1b}[31mb\\u{0}c\\xff d\n"
            "      |  ^^^^^^\n");
}

TEST_F(RenderDiagnostic, EdgesOfTheFile) {
  load("ab\ncd");
  EXPECT_EQ(render({kind, {file, 5, 5}, "ends too early"}),
            "dir/scene.sdl:2:3: error[E0601]: ends too early\n"
            "    2 | cd\n"
            "      |   ^\n");
  EXPECT_EQ(render({kind, {file, 0, 5}, "two lines"}),
            "dir/scene.sdl:1:1: error[E0601]: two lines\n"
            "    1 | ab\n"
            "      | ^^\n");
  EXPECT_EQ(render({kind, {file, 2, 3}, "the line end"}),
            "dir/scene.sdl:1:3: error[E0601]: the line end\n"
            "    1 | ab\n"
            "      |   ^\n");
}

TEST_F(RenderDiagnostic, EmptyFileIsShown) {
  load("");
  EXPECT_EQ(render({kind, {file, 0, 0}, "nothing here"}),
            "dir/scene.sdl:1:1: error[E0601]: nothing here\n"
            "    1 | \n"
            "      | ^\n");
}

TEST_F(RenderDiagnostic, LongLinesAreCutRoundThePlace) {
  options.max_source_width = 30;
  load(std::string(100, 'a') + "HERE" + std::string(100, 'b'));
  EXPECT_EQ(render({kind, at("HERE"), "far in"}),
            "dir/scene.sdl:1:101: error[E0601]: far in\n"
            "    1 | …aaaaaaaaaaHEREbbbbbbbbbbbbbb…\n"
            "      |            ^^^^\n");
  EXPECT_EQ(render(Diagnostic(kind, {file, 5, 6}, "near").label(at("HERE"), "cut away")),
            "dir/scene.sdl:1:6: error[E0601]: near\n"
            "    1 | aaaaaaaaaaaaaaaaaaaaaaaaaaaaa…\n"
            "      |      ^\n"
            "      |                              - cut away\n");
  EXPECT_EQ(render({kind, {file, 204, 204}, "at the end"}),
            "dir/scene.sdl:1:205: error[E0601]: at the end\n"
            "    1 | …bbbbbbbbbb\n"
            "      |            ^\n");
}

TEST_F(RenderDiagnostic, HugeLineCostsNoMoreThanAShortOne) {
  load(std::string(64U << 20, 'x'));
  (void)sources.position(file, 0);
  const auto start = std::chrono::steady_clock::now();
  const std::string text = render({kind, {file, 33'000'000, 60'000'000}, "wide"});
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::milliseconds(200));
  for (const std::string_view line : lines(text)) {
    EXPECT_LE(count_code_points(line), 200U + 8U) << "with the gutter";
  }
}

TEST_F(RenderDiagnostic, SpansOfDerivedTextShowWhatTheAuthorWrote) {
  load("Sphere {\n  radius -1\n}\n");
  const FileId derived =
      sources.add_derived(file, "sphere { radius = -1; }", {{0, 23, 0, 22}, {18, 20, 18, 20}});
  const Diagnostic diagnostic =
      Diagnostic(kind, {derived, 18, 20}, "`radius` is -1 m; needs a value above 0 m")
          .label({derived, 0, 23}, "in this sphere")
          .fix({derived, 18, 20}, "1");
  EXPECT_EQ(render(diagnostic),
            "dir/scene.sdl:2:10: error[E0601]: `radius` is -1 m; needs a value above 0 m\n"
            "    2 |   radius -1\n"
            "      |          ^^\n"
            "  --> dir/scene.sdl:1:1\n"
            "    1 | Sphere {\n"
            "      | -------- in this sphere\n");
}

TEST_F(RenderDiagnostic, ColorOnlyWhenAsked) {
  load("sphere { radus = 1; }");
  const Diagnostic diagnostic = Diagnostic(kind, at("radus"), "unknown key `radus`")
                                    .label(at("sphere"), "of this")
                                    .note("note", at("1"))
                                    .hint("did you mean `radius`?")
                                    .fix(at("radus"), "radius");
  const std::string plain = render(diagnostic);
  EXPECT_EQ(plain.find('\x1b'), std::string::npos);
  options.color = true;
  std::string colored = render(diagnostic);
  EXPECT_NE(colored.find("\x1b[1;31merror[E0601]:\x1b[0m"), std::string::npos);
  for (std::size_t at = colored.find('\x1b'); at != std::string::npos; at = colored.find('\x1b')) {
    colored.erase(at, colored.find('m', at) - at + 1);
  }
  EXPECT_EQ(colored, plain);  // color changes nothing else
}

}  // namespace
}  // namespace scenec
