#include "frontend/compile.hpp"

#include <gtest/gtest.h>

#include "tests/unit/frontend/compile_fixture.hpp"

namespace scenec::frontend::test {
namespace {

TEST(Compile, smallest_scene) {
  const Compiled result = compiled(scene_with(""));
  ASSERT_EQ(result.codes, "") << result.rendered;
  ASSERT_TRUE(result.scene);
  EXPECT_EQ(result.scene->items.size(), 1u);
  EXPECT_EQ(result.scene->lights.size(), 1u);
  EXPECT_EQ(result.scene->cameras.size(), 1u);
  EXPECT_TRUE(result.scene->render.camera.valid());
}

TEST(Compile, items_that_are_right) {
  for (const std::string& items : std::vector<std::string>{
           "let r = 0.5m; sphere ball { center = [0, 1, 0]; radius = r; material = grey; }",
           "group { transform = [scale(2), rotate_y(30deg), move([1, 0, 0])]; material = grey; "
           "sphere { } box { min = [0, 0, 0]; max = [1, 1, 1]; } }",
           "proto leaf { quad { corner = [0, 0, 0]; edge_u = [1, 0, 0]; edge_v = [0, 1, 0]; "
           "material = grey; } } instance { of = leaf; transform = move([0, 1, 0]); }",
           "param n: int = 6 in 0 .. 40; sphere { radius = n / 10; material = grey; }",
           "fn twice(x: length): length = 2 * x; sphere { radius = twice(0.5m); material = grey; }",
           "macro row(count: int in 1 .. 100, wood: material = grey) { for i in 0 ..< count { "
           "sphere { center = [i, 0, 0]; material = wood; } } } row(3); row(count = 2, wood = "
           "grey);",
           "if 1 < 2 { sphere { material = grey; } } else { box { min = [0, 0, 0]; max = [1, 1, "
           "1]; material = grey; } }",
           "assert 1 < 2, \"arithmetic\";",
           "material m: mix { a = grey; b = grey; weight = 0.5; } sphere { material = m; }",
           "material c: conductor { preset = .gold; roughness = 0.1; } sphere { material = c; }",
           "material g: ggx { base = #336699; f0 = 0.04; roughness = checker(0.2, 0.4, 8); } "
           "sphere { material = g; }",
           "triangle { vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]; uvs = [[0, 0], [1, 0], [0, "
           "1]]; material = grey; }",
           "mesh { vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]; faces = [[0, 1, 2]]; material = "
           "grey; }",
           "mesh { vertices = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]; faces = [[0, 1, 2, "
           "3]]; material = grey; }",
           "revolve { profile = bezier([[55mm, 20mm], [18mm, 140mm], [40mm, 180mm]]); axis = .y; "
           "material = grey; }",
           "render { camera = main; size = [1280, 720]; method = .path; filter = tent(1.0); stop { "
           "error = 1%; time = 120s; } effects { caustics = .off; } aovs = [.albedo, .normal]; "
           "region = [0, 0, 10, 10]; }",
           "render { filter = .box; samples = 16; background = #abc; }",
           "light: spot { position = [0, 3, 0]; direction = [0, -1, 0]; angle = 40deg; falloff = "
           "5deg; intensity = 20; color = blackbody(4300K); }",
           "light sky: environment { constant = rgb(0.1, 0.2, 0.3); gain = 2; }",
           "@allow(unused_declaration) let unused = 3;",
           "cylinder { base = [0, 0, 0]; top = [0, 1, 0]; radius = 10cm; capped = false; material "
           "= grey; }",
       }) {
    const Compiled result = compiled(scene_with(items));
    EXPECT_EQ(result.codes, "") << items << "\n" << result.rendered;
    EXPECT_TRUE(result.scene) << items;
  }
}

TEST(Compile, items_that_are_wrong) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"sphere { radios = 1; material = grey; }", "E0223"},
      {"sphere { radius = 1; radius = 2; material = grey; }", "E0224"},
      {"disk { center = [0, 0, 0]; normal = [0, 1, 0]; material = grey; }", "E0225"},
      {"disk { center = [0, 0, 0]; material = grey; }", "E0225"},
      {"disk { center = [0, 0, 0]; norml = [0, 1, 0]; radius = 1; material = grey; }", "E0223"},
      {"light: point { position = [0, 1, 0]; power = 1W; intensity = 2; }", "E0226"},
      {"light: point { position = [0, 1, 0]; }", "E0225"},
      {"light: point { }", "E0225"},
      {"mesh { vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]; material = grey; }", "E0227"},
      {"spere { material = grey; }", "E0228"},
      {"light: pint { position = [0, 1, 0]; power = 1W; }", "E0228"},
      {"material g: gloss { } sphere { material = g; }", "E0228"},
      {"render { method = .paht; }", "E0229"},
      {"sphere { radius = -1; material = grey; }", "E0230"},
      {"sphere { radius = 0; material = grey; }", "E0230"},
      {"sphere { radius = 60deg; material = grey; }", "E0211"},
      {"sphere { center = [0, 1]; material = grey; }", "E0210"},
      {"sphere { center = [0, 1s, 0]; material = grey; }", "E0211"},
      {"sphere { material = 3; }", "E0210"},
      {"sphere { material = gray; }", "E0204"},
      {"sphere { material = grei; }", "E0201"},
      {"light: spot { position = [0, 3, 0]; direction = [0, -1, 0]; angle = 40; intensity = 20; }",
       "E0212"},
      {"light: spot { position = [0, 3, 0]; direction = [0, 0, 0]; angle = 40deg; intensity = 20; "
       "}",
       "E0237"},
      {"light: spot { position = [0, 3, 0]; direction = [0, -1, 0]; angle = 40deg; falloff = "
       "30deg; intensity = 20; }",
       "E0314"},
      {"let a = 1; let a = 2; sphere { radius = a; material = grey; }", "E0202"},
      {"sphere { radius = later; material = grey; } let later = 2;", "E0203"},
      {"let x = x; sphere { radius = x; material = grey; }", "E0203"},
      {"let x: lenght = 2; sphere { radius = x; material = grey; }", "E0205"},
      {"let area = 2m * 3m; sphere { radius = sqrt(area); material = grey; }", "E0214"},
      {"param n: int = 60 in 0 .. 40; sphere { radius = n; material = grey; }", "E0230"},
      {"sphere { material = grey; transform = scale([1, 1e-13, 1]); }", "E0238"},
      {"group { transform = scale([1, 2, 1]); camera side: pinhole { eye = [0, 1, 5]; aim = [0, 1, "
       "0]; fov = 40deg; } } render { camera = main; }",
       "E0306"},
      {"proto p { light: point { position = [0, 1, 0]; power = 1W; } } instance { of = p; }",
       "E0307"},
      {"camera other: pinhole { eye = [0, 1, 5]; aim = [0, 1, 5]; fov = 40deg; } render { camera = "
       "main; }",
       "E0308"},
      {"camera other: pinhole { eye = [0, 1, 5]; aim = [0, 9, 5]; fov = 40deg; } render { camera = "
       "main; }",
       "E0308"},
      {"camera other: pinhole { eye = [0, 1, 5]; direction = [0, 0, -1]; fov = 40deg; }", "E0303"},
      {"camera main: pinhole { eye = [0, 1, 5]; direction = [0, 0, -1]; fov = 40deg; } render { "
       "camera = main; }",
       "E0304"},
      {"render { camera = mian; }", "E0246"},
      {"render { } render { }", "E0305"},
      {"render { samples = 4; stop { samples = 8; } }", "E0226"},
      {"render { size = [0, 480]; }", "E0230"},
      {"render { region = [10, 10, 5, 20]; }", "E0312"},
      {"render { filter = tent(1000); }", "E0236"},
      {"box { min = [0, 0, 0]; max = [1, -1, 1]; material = grey; }", "E0309"},
      {"cylinder { base = [0, 1, 0]; top = [0, 1, 0]; radius = 1; material = grey; }", "E0310"},
      {"mesh { vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]; faces = [[0, 1, 3]]; material = grey; "
       "}",
       "E0311"},
      {"mesh { file = \"none.obj\"; material = grey; }", "E0601"},
      {"radius = 3;", "E0233"},
      {"sphere { material = grey; sphere { } }", "E0233"},
      {"@alow(no_light) sphere { material = grey; }", "E0234"},
      {"@allow(no_lihgt) sphere { material = grey; }", "E0235"},
      {"assert 2 < 1, \"two is more\";", "E0243"},
      {"fn f(x: num): num = f(x); sphere { radius = f(1); material = grey; }", "E0244"},
      {"macro m() { m(); } m();", "E0244"},
      {"macro m(n: int) { sphere { radius = n; material = grey; } } m(k = 2);", "E0207"},
      {"macro m(n: int) { sphere { radius = n; material = grey; } } m();", "E0208"},
      {"macro m(n: int) { sphere { radius = n; material = grey; } } m(1.5);", "E0210"},
      {"macro m(n: int in 0 .. 3) { sphere { radius = n; material = grey; } } m(7);", "E0230"},
      {"for i in 0 ..< 100 { sphere { radius = nothing; material = grey; } }", "E0201"},
      {"if false { sphere { radius = nothing; material = grey; } }", "E0201"},
      {"macro never() { sphere { radius = 60deg; material = grey; } } if false { never(); }",
       "E0211"},
      {"fn f(x: angle): num = x; let y = select(true, 1, f(2deg)); sphere { radius = y; material = "
       "grey; }",
       "E0211"},
      {"if 3 { sphere { material = grey; } }", "E0210"},
      {"grey();", "E0204"},
      {"include \"none.sdl\" as none; none.row(1);", "E0601"},
  };
  for (const auto& [items, codes] : cases) {
    const Compiled result = compiled(scene_with(items));
    EXPECT_EQ(result.codes, codes) << items << "\n" << result.rendered;
    EXPECT_FALSE(result.scene) << items;
  }
}

TEST(Compile, lints) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {scene_with("let unused = 3;"), "L0201"},
      {scene_with("let r = 1; group { let r = 2; sphere { radius = r; material = grey; } } sphere "
                  "{ radius = r; material = grey; }"),
       "L0202"},
      {scene_with("let r = 1; /// behind\nsphere { radius = r; material = grey; }"), "L0203"},
      {scene_with("sphere { } sphere { }"), "L0301"},
      {"sdl 1;\nmaterial grey: diffuse { color = gray(0.5); } sphere { material = grey; }\n" +
           camera,
       "L0302"},
      {scene_with("@allow(default_material) sphere { }"), ""},
      {scene_with("@allow(L0301) sphere { }"), ""},
  };
  for (const auto& [text, codes] : cases) {
    const Compiled result = compiled(text);
    EXPECT_EQ(result.codes, codes) << text << "\n" << result.rendered;
    EXPECT_TRUE(result.scene) << text;
  }
}

TEST(Compile, whole_files) {
  EXPECT_EQ(compiled("sdl 1;\n").codes, "E0301");
  EXPECT_EQ(compiled("sdl 1;\n// nothing\n").codes, "E0301");
  EXPECT_EQ(compiled("sdl 1;\nlet a = 1;\n").codes, "E0313");
  EXPECT_EQ(
      compiled("sdl 1;\nmaterial g: diffuse { color = gray(0.5); } sphere { material = g; }\n")
          .codes,
      "E0302");
  Compiler library;
  library.options.library = true;
  const Compiled result = library("sdl 1;\nlet a = 1;\n");
  EXPECT_EQ(result.codes, "");
  EXPECT_TRUE(result.scene);
}

TEST(Compile, six_mistakes_in_seven_lines_give_six_diagnostics) {
  const Compiled result = compiled(
      "sdl 1; camera main: pinhole { eye = [0, 1, 5]; aim = [0, 1, 0]; fov = 40deg; }\n"
      "material oak: ggx { base = #963; roughnes = 0.2; }\n"
      "spher { material = oak; }\n"
      "sphere { material = oaks; }\n"
      "material gold: conductor { preset = .glod; }\n"
      "sphere { radius = 5furlong; material = gold; }\n"
      "light: point { position = [0, 5, 0]; power = 3m; }\n");
  EXPECT_EQ(result.codes, "E0223 E0228 E0201 E0229 E0222 E0211") << result.rendered;
}

TEST(Compile, settings_from_the_command_line) {
  const std::string text = scene_with(
      "param n: int = 3 in 0 .. 10; param name: string = \"a\"; param size: length = 1m; assert n "
      "== 7 && name == \"x y\" && size == 2m;");
  Compiler compiler;
  compiler.options.params = {{"n", "3 + 4"}, {"name", "x y"}, {"size", "200cm"}};
  EXPECT_EQ(compiler(text).codes, "");
  compiler.options.params = {{"n", "7"}, {"name", "x y"}, {"size", "2"}, {"sise", "2"}};
  EXPECT_EQ(compiler(text).codes, "E0231");
  compiler.options.params = {{"n", "11"}, {"name", "x y"}, {"size", "2"}};
  EXPECT_EQ(compiler(text).codes, "E0230");
  compiler.options.params = {{"n", "1.5"}, {"name", "x y"}, {"size", "2"}};
  EXPECT_EQ(compiler(text).codes, "E0210");
  compiler.options.params = {{"n", "7; sphere {}"}, {"name", "x y"}, {"size", "2"}};
  EXPECT_NE(compiler(text).codes, "");
  compiler.options.params = {{"n", "size"}, {"name", "x y"}, {"size", "2"}};
  EXPECT_EQ(compiler(text).codes, "E0201");
}

TEST(Compile, groups_compose_transforms_and_fill_materials) {
  const Compiled result =
      compiled(scene_with("group { transform = move([10, 0, 0]); material = grey;"
                          "  group { transform = [scale(2), move([0, 1, 0])]; sphere ball { "
                          "transform = move([1, 0, 0]); } } }"));
  ASSERT_EQ(result.codes, "") << result.rendered;
  const ir::Item& ball = result.scene->items.back();
  const ir::Point3 center = ir::apply(result.scene->transforms[ball.transform], {0, 0, 0});
  EXPECT_EQ(center, (ir::Point3{12, 1, 0}));
  EXPECT_EQ(ball.material, result.scene->items.front().material);
  EXPECT_EQ(result.scene->names[ball.name], "ball");
}

TEST(Compile, lights_and_cameras_move_with_their_group) {
  const Compiled result = compiled(
      "sdl 1;\nmaterial grey: diffuse { color = gray(0.5); } sphere { material = grey; }\n"
      "group { transform = [rotate_y(90deg), scale(2), move([1, 0, 0])];\n" +
      camera + "light: sphere { center = [0, 0, -1]; radius = 0.5; radiance = 3; } }\n");
  ASSERT_EQ(result.codes, "") << result.rendered;
  const auto& lamp = std::get<ir::SphereLight>(result.scene->lights[Id<ir::Light>(0)].kind);
  EXPECT_EQ(lamp.center, (ir::Point3{-1, 0, 0}));
  EXPECT_DOUBLE_EQ(lamp.radius.value, 1);
  const auto& eye = std::get<ir::Pinhole>(result.scene->cameras[ir::CameraId(0)].kind).eye;
  EXPECT_EQ(eye, (ir::Point3{11, 2, 0}));
}

TEST(Compile, a_mirrored_quad_light_emits_from_its_mirrored_side) {
  const Compiled result =
      compiled(scene_with("@allow(mirrored_transform) group { transform = scale([-1, 1, 1]); "
                          "light: quad { corner = [0, 3, "
                          "0]; edge_u = [1, 0, 0]; edge_v = [0, 0, 1]; radiance = 1; } }"));
  ASSERT_EQ(result.codes, "") << result.rendered;
  const auto& lamp = std::get<ir::QuadLight>(result.scene->lights[Id<ir::Light>(0)].kind);
  EXPECT_EQ(lamp.edge_u, (ir::Point3{0, 0, 1}));
  EXPECT_EQ(lamp.edge_v, (ir::Point3{-1, 0, 0}));
}

TEST(Compile, included_declarations) {
  Compiler compiler;
  compiler.files.put("lib.sdl",
                     "sdl 1;\nlet top = 0.72m;\nmaterial oak: diffuse { color = gray(0.3); }\nfn "
                     "double(x: length): length = 2 * x;\n"
                     "macro ball(r: length, wood: material = oak) { sphere { radius = double(r) + "
                     "top; material = wood; } }\n"
                     "sphere { material = oak; }\n");
  const Compiled result =
      compiler(scene_with("include \"lib.sdl\" as lib; lib.ball(r = lib.double(lib.top)); sphere { "
                          "material = lib.oak; }"));
  ASSERT_EQ(result.codes, "") << result.rendered;
  EXPECT_EQ(result.scene->items.size(), 3u);
  EXPECT_EQ(
      compiler(scene_with("include \"lib.sdl\" as lib; sphere { material = lib.oka; }")).codes,
      "E0245");
  compiler.files.put("lib.sdl", "sdl 1;\ninclude \"lib.sdl\" as me;\n");
  EXPECT_EQ(compiler(scene_with("include \"lib.sdl\" as lib;")).codes, "E0244");
}

TEST(Compile, hygiene_of_macros) {
  const Compiled result =
      compiled(scene_with("let r = 1m; macro ball() { sphere { radius = r; material = grey; } } "
                          "group { let r = 5m; ball(); sphere { radius = r; material = grey; } }"));
  EXPECT_EQ(result.codes, "L0202") << result.rendered;
  ASSERT_TRUE(result.scene);
  const auto& spheres = result.scene->table<ir::Sphere>();
  EXPECT_EQ(spheres[Id<ir::Sphere>(1)].radius.value, 1);
  EXPECT_EQ(spheres[Id<ir::Sphere>(2)].radius.value, 5);
}

TEST(Compile, mistakes_in_a_macro_show_the_call) {
  const Compiled result =
      compiled(scene_with("macro m(n: int) { sphere { radius = 1 / n; material = grey; } } m(0);"));
  EXPECT_EQ(result.codes, "E0217");
  EXPECT_NE(result.rendered.find("expanded from macro `m` here"), std::string::npos)
      << result.rendered;
}

TEST(Compile, too_many_items) {
  Compiler compiler;
  compiler.options.limits.items = 50;
  EXPECT_EQ(compiler(scene_with("for i in 0 ..< 100 { sphere { material = grey; } }")).codes,
            "E0721");
}

TEST(Compile, equal_text_gives_equal_hash_and_layout_does_not_matter) {
  const Compiled a =
      compiled(scene_with("sphere { radius = 0.5; center = [1, 2, 3]; material = grey; }"));
  const Compiled b =
      compiled(scene_with("let r = 50cm; // a comment\nsphere  named { center = [1m, 2, 3]; radius "
                          "= r; material = grey; }"));
  ASSERT_TRUE(a.scene && b.scene);
  EXPECT_EQ(a.scene->hash, b.scene->hash);
}

}  // namespace
}  // namespace scenec::frontend::test
