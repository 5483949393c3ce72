// What language.md says of names, types and bodies, sentence by sentence: small pieces of a scene
// and the codes they give.
#include <gtest/gtest.h>

#include "tests/unit/frontend/compile_fixture.hpp"

namespace scenec::frontend::test {
namespace {

struct Sentence {
  std::string items;
  std::string codes;
};

void expect_codes(const std::vector<Sentence>& sentences) {
  for (const Sentence& sentence : sentences) {
    const Compiled result = compiled(scene_with(sentence.items));
    EXPECT_EQ(result.codes, sentence.codes) << sentence.items << '\n' << result.rendered;
  }
}

std::string allowing_unused(const std::string& declaration) {
  return "@allow(unused_declaration) " + declaration;
}

TEST(Bodies, elements_of_list_parameters_have_their_type) {
  expect_codes({
      {allowing_unused("fn f(xs: [color]): num = xs[0] + 1m;"), "E0213"},
      {allowing_unused("fn f(xs: [[num]]): num = xs[0][1].x;"), "E0219"},
      {allowing_unused("fn f(xs: [length]): angle = xs[2];"), "E0211"},
      {allowing_unused("fn f(xs: [length]): angle = sum(xs);"), "E0211"},
      {allowing_unused("fn f(xs: [string]): num = len([for x in xs: x + 1]);"), "E0213"},
      {allowing_unused("macro m(xs: [angle]) { for x in xs { sphere { radius = x; } } }"), "E0211"},
      {allowing_unused("macro m(xs: [length]) { material q: diffuse { color = xs[1]; } "
                       "sphere { material = q; } }"),
       "E0210"},
      {allowing_unused("fn f(xs: [length]): length = xs[2] + len(xs);"), ""},
  });
}

TEST(Bodies, a_list_of_unknown_length_may_serve_as_a_vector) {
  expect_codes({
      {"macro m(at: [length]) { sphere { center = at; material = grey; } }\nm([1, 2, 3]);", ""},
      {"macro m(at: [length]) { sphere { center = at; material = grey; } }\nm([1, 2]);", "E0210"},
      {"macro m(at: [angle]) { sphere { center = at; material = grey; } }\nm([1deg, 2deg, 3deg]);",
       "E0211"},
      {"fn at(i: int): point = [for k in 0 ..< 3: i * k];\nsphere { center = at(2); material = "
       "grey; }",
       ""},
      {"fn twice(i: int): point = [for k in 0 ..< 3: i * k * 1m] * 2;\nsphere { center = twice(2); "
       "material = grey; }",
       ""},
      {"if false { sphere { center = [1, 2, 3, 4]; } }", "E0210"},
  });
}

TEST(Bodies, elements_of_written_lists_are_checked_where_nothing_runs) {
  expect_codes({
      {"if false { sphere { radius = [#fff, #000][1]; } }", "E0210"},
      {allowing_unused("fn f(): length = [1deg, 2deg, 3deg, 4deg][0];"), "E0211"},
      {"for i in 0 ..< 0 { sphere { radius = [1m, 2m, 3m, 4m][i].x; } }", "E0219"},
      {"if false { box { min = [0, 0, 0]; max = [for i in 0 ..< 3: 1deg]; } }", "E0211"},
  });
}

TEST(Bodies, stops_of_a_ramp_may_come_from_a_comprehension) {
  const std::string stops = "[for i in 0 ..< n: [i / n, gray(i / n)]]";
  expect_codes({
      {"fn grades(n: int): texture = ramp(0.5, " + stops +
           ");\nmaterial a: diffuse { color = " + "grades(4); }\nsphere { material = a; }",
       ""},
      {"macro m(n: int) { material a: diffuse { color = ramp(0.5, " + stops +
           "); } sphere { material = a; } }\nm(3);",
       ""},
      {allowing_unused("fn f(n: int): texture = ramp(0.5, [for i in 0 ..< n: [i, 2, 3]]);"),
       "E0210"},
  });
}

TEST(Assertions, say_any_constant_text) {
  const Compiled result = compiled(
      scene_with("let n = 3;\nassert n % 2 == 0, concat(\"n is \", str(n), \", which is odd\");"));
  EXPECT_EQ(result.codes, "E0243");
  EXPECT_EQ(result.messages, "n is 3, which is odd\n");
  expect_codes({
      {"assert true, str(1, 2);", ""},
      {"assert true, 5;", "E0210"},
      {"assert 1 < 2, nothing;", "E0201"},
      {"assert true, concat(\"a\", 1);", "E0210"},
      {"assert len(concat(\"ab\", \"c\")) == 3;", ""},
  });
}

TEST(Parameters, defaults_lie_in_their_own_range_even_if_never_used) {
  expect_codes({
      {allowing_unused("macro m(n: int = 9 in 1 .. 5) { sphere { material = grey; } }"), "E0230"},
      {allowing_unused("fn f(x: length = 2km in 0m .. 1m): length = x;"), "E0230"},
      {allowing_unused(
           "macro m(a: int = 2, n: int = a * 3 in 1 .. 5) { sphere { material = grey; } "
           "}"),
       ""},
      {"macro m(n: int = 2 in 1 .. 5) { sphere { material = grey; } }\nm(n = 7);", "E0230"},
  });
}

TEST(Shadowing, is_linted_for_every_binder) {
  const std::string outer = "let a = 1;\nassert a == 1;\n";
  expect_codes({
      {outer + "group { let a = 2; sphere { radius = a; material = grey; } }", "L0202"},
      {outer + "group { material a: mirror { } sphere { material = a; } }", "L0202"},
      {outer + "group { proto a { sphere { material = grey; } } instance { of = a; } }", "L0202"},
      {outer + "group { fn a(): num = 1; sphere { radius = a(); material = grey; } }", "L0202"},
      {outer + "group { macro a() { sphere { material = grey; } } a(); }", "L0202"},
      {outer + "fn f(a: num): num = a;\nassert f(1) == 1;", "L0202"},
      {outer + "macro m(a: num) { sphere { radius = a; material = grey; } }\nm(1);", "L0202"},
      {outer + "for a in 1 .. 3 { sphere { radius = a; material = grey; } }", "L0202"},
      {outer + "for i, a in [1, 2] { sphere { radius = a + i; material = grey; } }", "L0202"},
      {outer + "assert sum([for a in 0 ..< 3: a]) == 3;", "L0202"},
      {"fn f(sqrt: num): num = sqrt;\nassert f(1) == 1;", "L0202"},
      {outer + "@allow(shadowed_name) for a in 1 .. 3 { sphere { radius = a; material = grey; } }",
       ""},
      // Once where it is written, not where it runs.
      {outer +
           "macro m() { for a in 1 .. 3 { sphere { radius = a; material = grey; } } }\nm();\nm();",
       "L0202"},
  });
}

TEST(Cameras, the_caller_may_choose_among_several) {
  const std::string two =
      "sdl 1;\nmaterial grey: diffuse { color = gray(0.5); }\nsphere { material "
      "= grey; }\n" +
      lit + "camera a: panorama { eye = [0, 0, 5]; aim = [0, 0, 0]; }\n" +
      "camera b: panorama { eye = [0, 0, 6]; aim = [0, 0, 0]; }\n";
  EXPECT_EQ(compiled(two).codes, "E0303");
  Compiler chosen;
  chosen.options.camera_chosen = true;
  EXPECT_EQ(chosen(two).codes, "");
}

}  // namespace
}  // namespace scenec::frontend::test
