// The numerical lints of language.md: each found where it is, measured, silent beside it, and quiet
// under `@allow`.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "frontend/check/lint_scene.hpp"
#include "frontend/check/profile.hpp"
#include "tests/unit/frontend/compile_fixture.hpp"

namespace scenec::frontend::test {
namespace {

const std::string materials =
    "material red: diffuse { color = rgb(0.8, 0.1, 0.1); }\n"
    "material glass: dielectric { ior = 1.5; }\n"
    "sphere { center = [50, 0, 0]; material = red; }\n"
    "sphere { center = [60, 0, 0]; material = glass; }\n";

std::string codes_in(const std::string& items) {
  const Compiled result = compiled(scene_with(materials + items));
  return result.codes;
}

struct Case {
  std::string items;
  std::string codes;
};
void expect(const std::vector<Case>& cases) {
  for (const Case& c : cases) {
    const Compiled result = compiled(scene_with(materials + c.items));
    EXPECT_EQ(result.codes, c.codes) << c.items << '\n' << result.rendered;
  }
}

const std::string floor_plane = "plane { material = grey; offset = -3; }\n";

TEST(Lints, thin_gaps) {
  const std::string paper =
      "quad { corner = [-1, -3, -1]; edge_u = [0, 0, 2]; edge_v = [2, 0, 0]; ";
  expect({
      {floor_plane + paper + "material = red; }", "L0310"},
      {floor_plane + paper + "material = red; transform = move([0, 1e-8, 0]); }", "L0310"},
      {floor_plane + paper + "material = red; transform = move([0, 1e-5, 0]); }", ""},
      {floor_plane + paper + "material = grey; }", ""},  // of one material none can tell
      {floor_plane + "@allow(thin_gap) " + paper + "material = red; }", ""},
      // What stands on the floor hides both surfaces; what is flush with it does not.
      {floor_plane + "box { min = [0, -3, 0]; max = [1, 0, 1]; material = red; }", ""},
      {floor_plane + "box { min = [0, -4, 0]; max = [1, -3, 1]; material = red; }", "L0310"},
      {paper + "material = red; }\nbox { min = [0, -3, 0]; max = [1, 0, 1]; material = grey; }",
       ""},
      {"box { min = [0, 5, 0]; max = [1, 6, 1]; material = red; }\n"
       "box { min = [1, 5, 0]; max = [2, 6, 1]; material = grey; }",
       ""},
      {"box { min = [0, 5, 0]; max = [2, 6, 1]; material = red; }\n"
       "box { min = [1, 5.5, -1]; max = [3, 6, 2]; material = grey; }",
       "L0310"},
      {"disk { center = [0, 5, 0]; normal = [0, 1, 0]; radius = 1; material = red; }\n"
       "cylinder { base = [0, 4, 0]; top = [0, 5, 0]; radius = 0.5; material = grey; }",
       "L0310"},
      {"group { transform = [rotate_z(30deg), move([0, 7, 0])]; material = red; box { min = [0, 0, "
       "0]; max = [1, 1, 1]; } quad { corner = [0, 1, 0]; edge_u = [0, 0, 1]; edge_v = [1, 0, 0]; "
       "material = grey; } }",
       "L0310"},
      {"sphere { center = [9, 9, 9]; radius = 1; material = red; }\n"
       "sphere { center = [9, 9, 9]; radius = 1.00000001; material = grey; }",
       "L0310"},
      {"sphere { center = [9, 9, 9]; radius = 1; material = red; }\n"
       "sphere { center = [9, 9, 9]; radius = 1.01; material = grey; }",
       ""},
      // Two halves of a square share an edge, not a surface.
      {"triangle { vertices = [[0, 5, 0], [1, 6, 0], [1, 6, 1]]; material = red; }\n"
       "triangle { vertices = [[0, 5, 0], [1, 6, 1], [0, 5, 1]]; material = grey; }",
       ""},
  });
}

TEST(Lints, coincident_dielectrics) {
  const std::string block = "box { min = [0, -3, 0]; max = [1, 0, 1]; material = glass; }\n";
  expect({
      {floor_plane + block, "L0311"},
      {floor_plane + "@allow(coincident_dielectrics) " + block, ""},
      {floor_plane + "@allow(coincident_dielectrics) group { " + block + " }", ""},
      {block + "box { min = [1, -3, 0]; max = [2, 0, 1]; material = glass; }", "L0311"},
      {block + "box { min = [1.0000000001, -3, 0]; max = [2, 0, 1]; material = glass; }", "L0310"},
      {block + "box { min = [1.001, -3, 0]; max = [2, 0, 1]; material = glass; }", ""},
      {"macro slab(y: length) { box { min = [0, y, 0]; max = [1, y + 1, 1]; material = glass; } }\n"
       "for i in 0 ..< 5 { slab(y = 10 + i); }",
       "L0311"},
  });
}

TEST(Lints, lights_inside_geometry) {
  expect({
      {"light: point { position = [20, 20, 20]; power = 1W; }\n"
       "sphere { center = [20, 20, 20.5]; radius = 1; material = grey; }",
       "L0312"},
      {"light: point { position = [20, 20, 20]; power = 1W; }\n"
       "sphere { center = [20, 20, 20.5]; radius = 1; material = glass; }",
       ""},
      {"light: sphere { center = [20, 20, 20]; radius = 0.1; power = 1W; }\n"
       "box { min = [-1, -1, -1]; max = [1, 1, 1]; transform = [rotate_y(45deg), move([21, 20, "
       "20])]; material = grey; }",
       "L0312"},
      // In the box round the turned box, not in it.
      {"light: point { position = [22.3, 20, 20.9]; power = 1W; }\n"
       "box { min = [-1, -1, -1]; max = [1, 1, 1]; transform = [rotate_y(45deg), move([21, 20, "
       "20])]; material = grey; }",
       ""},
      {"light: spot { position = [20, 20, 20]; direction = [0, 1, 0]; angle = 30deg; power = 1W; "
       "}\n"
       "cylinder { base = [20, 19, 20]; top = [20, 21, 20]; radius = 1; material = grey; }",
       "L0312"},
      {"light: point { position = [20, 20, 20]; power = 1W; }\n"
       "cylinder { base = [20, 19, 20]; top = [20, 21, 20]; radius = 1; capped = false; material = "
       "grey; }",
       ""},
      {"@allow(light_inside_geometry) light: point { position = [20, 20, 20]; power = 1W; }\n"
       "sphere { center = [20, 20, 20.5]; radius = 1; material = grey; }",
       ""},
  });
}

TEST(Lints, tiny_objects_far_away) {
  expect({
      {"sphere { center = [1e6, 0, 0]; radius = 0.1; material = grey; }", "L0314"},
      {"sphere { center = [1e3, 0, 0]; radius = 0.1; material = grey; }", ""},
      {"sphere { radius = 1e-9; material = grey; }", ""},
      {"box { min = [0, 0, 0]; max = [0.1, 0.1, 0.1]; transform = move([0, -1e6, 0]); material = "
       "grey; }",
       "L0314"},
      {"@allow(L0314) sphere { center = [1e6, 0, 0]; radius = 0.1; material = grey; }", ""},
  });
}

TEST(Lints, transforms_that_mirror_or_flatten) {
  const std::string ball = "sphere { center = [0, 9, 0]; material = grey; transform = ";
  expect({
      {ball + "scale([1, -1, 1]); }", "L0315"},
      {ball + "scale([-1, -1, 1]); }", ""},
      {ball + "scale([1, 1, 1e-8]); }", "L0316"},
      {ball + "scale([1, 1, 1e-5]); }", ""},
      {ball + "scale([1, 1, 1e-13]); }", "E0238"},
      {"@allow(mirrored_transform) " + ball + "scale([1, -1, 1]); }", ""},
  });
}

TEST(Lints, materials) {
  const auto with = [](const std::string& material) {
    return "material m: " + material + "\nsphere { center = [0, 9, 0]; material = m; }";
  };
  expect({
      {with("ggx { base = gray(0.5); roughness = 0.01; }"), "L0313"},
      {with("ggx { base = gray(0.5); roughness = 0.04; }"), ""},
      {with("ggx { base = gray(0.5); roughness = 0; }"), ""},
      {with("conductor { preset = .gold; roughness = 0.03; }"), "L0313"},
      {with("dielectric { roughness = 0.02; tint = rgb(1, 1.2, 1); }"), "L0313 L0318"},
      {with("diffuse { color = rgb(0.5, 1.1, 0.5); }"), "L0318"},
      {with("diffuse { color = gray(0.3 + 0.3 + 0.4); }"), ""},
      {with("mirror { color = gray(2); }"), "L0318"},
      {with("phong { diffuse = gray(0.6); reflect = gray(0.6); }"), "L0318"},
      {with("phong { diffuse = gray(0.6); specular = gray(0.9); reflect = gray(0.2); }"), ""},
      {"@allow(albedo_above_one) " + with("diffuse { color = gray(2); }"), ""},
  });
}

TEST(Lints, profiles_and_faces) {
  const auto turned = [](const std::string& curve) {
    return "revolve { profile = " + curve + "; material = grey; transform = move([0, 9, 0]); }";
  };
  expect({
      {turned("polyline([[0, 0], [0.5, 0.5], [-0.1, 1]])"), "L0317"},
      {turned("polyline([[0, 0], [0.5, 0.5], [0, 1]])"), ""},
      // A point beyond the axis does not draw the curve there.
      {turned("bezier([[1, 0], [-0.1, 0.5], [1, 1]])"), ""},
      {turned("bezier([[1, 0], [-3, 0.5], [1, 1]])"), "L0317"},
      {turned("beziers([[1, 0], [1, 1], [1, 2], [1, 3], [1, 4], [-2, 5], [0, 6]])"), "L0317"},
      {turned("bspline([[1, 0], [0.2, 1], [-0.1, 2], [0.2, 3], [1, 4]])"), ""},
      {turned("bspline([[1, 0], [0.2, 1], [-2, 2], [0.2, 3], [1, 4]])"), "L0317"},
      {"triangle { vertices = [[0, 0, 9], [1, 1, 9], [2, 2, 9]]; material = grey; }", "L0501"},
      {"triangle { vertices = [[0, 0, 9], [0, 0, 9], [2, 2, 9]]; material = grey; }", "L0501"},
      {"quad { corner = [0, 0, 9]; edge_u = [1, 0, 0]; edge_v = [2, 0, 0]; material = grey; }",
       "L0501"},
      {"triangle { vertices = [[0, 0, 9], [1, 1, 9], [2, 2.001, 9]]; material = grey; }", ""},
  });
}

TEST(Lints, are_measured) {
  const Compiled result = compiled(
      scene_with(materials + "sphere { center = [1e6, 0, 0]; radius = 0.1; material = grey; }"));
  EXPECT_NE(result.messages.find("0.2 m across"), std::string::npos) << result.messages;
  EXPECT_NE(result.messages.find("3.2 steps"), std::string::npos) << result.messages;
  EXPECT_EQ(float_spacing(1), 0x1p-23);
  EXPECT_EQ(float_spacing(1.5), 0x1p-23);
  EXPECT_EQ(float_spacing(0.75), 0x1p-24);
  EXPECT_EQ(float_spacing(0), 0);
}

TEST(Lints, smallest_radius_of_a_curve) {
  const auto curve = [](ir::CurveKind kind, std::vector<double> radii, bool clamped = true) {
    ir::Curve result;
    result.kind = kind;
    result.clamped = clamped;
    for (double radius : radii) result.points.push_back({radius, 0});
    return smallest_radius(result);
  };
  EXPECT_EQ(curve(ir::CurveKind::polyline, {1, -2, 3}), -2);
  EXPECT_DOUBLE_EQ(curve(ir::CurveKind::bezier, {1, -3, 1}), -1);
  EXPECT_DOUBLE_EQ(curve(ir::CurveKind::beziers, {0, 1, 1, 0, -4, -4, 0}), -3);
  // A uniform cubic spline of equal points is that point; clamped ones begin at the first.
  EXPECT_DOUBLE_EQ(curve(ir::CurveKind::bspline, {-1, -1, -1, -1, -1}, false), -1);
  EXPECT_DOUBLE_EQ(curve(ir::CurveKind::bspline, {-1, 2, 2, 2}), -1);
  EXPECT_DOUBLE_EQ(curve(ir::CurveKind::bspline, {0, -3, 0, 9}, false), -2);
}

// What needs pairs must not take them all: a floor of tiles in one plane, each of another material
// than its neighbours.
TEST(Lints, many_faces_in_one_plane_take_little_time) {
  const std::string tiles =
      "for i in 0 ..< 200 { for k in 0 ..< 200 { quad { corner = [i, -3, k]; edge_u = [0, 0, 1]; "
      "edge_v = [1, 0, 0]; material = select((i + k) % 2 == 0, grey, red); } } }";
  EXPECT_EQ(codes_in(tiles), "");
  EXPECT_EQ(
      codes_in("for i in 0 ..< 3000 { quad { corner = [0, -3, 0]; edge_u = [0, 0, 1]; edge_v = "
               "[1, 0, 0]; material = select(i % 2 == 0, grey, red); } }"),
      "L0310");
}

}  // namespace
}  // namespace scenec::frontend::test
