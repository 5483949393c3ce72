// Base vocabulary and curves: what each word of a course scene becomes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/frontend/course_support.hpp"

namespace scenec::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr std::string_view ball = "numObjects 1 MaterialIndex 0 Sphere { center 0 0 0 radius 1 }";

TEST(CourseTranslate, ABaseSceneIsPhongOnCourseFilm) {
  const Translated scene =
      translate_objects(ball, "diffuseColor 1 0.5 0 specularColor 1 1 1 shininess 20");
  EXPECT_THAT(scene.errors, IsEmpty());
  EXPECT_THAT(scene.warnings, IsEmpty());
  EXPECT_EQ(
      scene.text,
      "sdl 1;\n"
      "// Converted from a course scene.\n"
      "\n"
      "render { size = [200, 100]; method = .phong; film = .course; background = gray(0.5); }\n"
      "\n"
      "camera main: pinhole { eye = [0, 0, 10]; direction = [0, 0, -1]; up = [0, 1, 0]; fov = "
      "30deg; }\n"
      "\n"
      "material m0: phong { diffuse = rgb(1, 0.5, 0); specular = white; shininess = 20; }\n"
      "\n"
      "sphere { center = [0, 0, 0]; radius = 1; material = m0; }\n");
}

TEST(CourseTranslate, EveryPieceKnowsItsCourseText) {
  const Translated scene = translate_objects(ball);
  EXPECT_EQ(scene.origin_of("radius = 1"), "radius 1");
  EXPECT_EQ(scene.origin_of("[0, 0, 10]"), "0 0 10");
  EXPECT_EQ(scene.origin_of("30deg"), "30");
  EXPECT_EQ(scene.origin_of("rgb(1, 0, 0)"), "1 0 0");
  EXPECT_EQ(scene.origin_of("= m0;"), "Sphere { center 0 0 0 radius 1 }");
  EXPECT_EQ(scene.origin_of("material m0: phong { diffuse"), "Material { diffuseColor 1 0 0 }");
}

TEST(CourseTranslate, SpecularWithoutShininessKeepsExponentZero) {
  EXPECT_TRUE(
      translate_objects(ball, "specularColor 1 1 1").has("specular = white; shininess = 0;"));
  EXPECT_TRUE(translate_objects(ball, "specularColor 1 1 1").has("diffuse = white;"));
}

TEST(CourseTranslate, NumbersOfScanfBecomeNumerals) {
  const Translated scene =
      translate_objects("numObjects 1 MaterialIndex 0 Sphere { center .16 -.5 +1 radius 1.}");
  EXPECT_THAT(scene.errors, IsEmpty());
  EXPECT_TRUE(scene.has("center = [0.16, -0.5, 1]; radius = 1;")) << scene.text;
  EXPECT_TRUE(
      translate_objects("numObjects 1 MaterialIndex 0 Sphere { center -0 1e-05 007 radius 1 }")
          .has("center = [0, 1e-05, 7]"));
}

TEST(CourseTranslate, TheFirstTransformListedIsAppliedLast) {
  const Translated scene = translate_objects(
      "numObjects 1 MaterialIndex 0 Transform { Scale 5 5 5 Translate 1 2 3 XRotate 90 Sphere { "
      "center 0 0 0 radius 1 } }");
  EXPECT_TRUE(scene.has("transform = [rotate_x(90deg), move([1, 2, 3]), scale([5, 5, 5])];"))
      << scene.text;
}

TEST(CourseTranslate, AMatrixIsReadByColumnsAndAppliedAfterwards) {
  const Translated scene = translate_objects(
      "numObjects 1 MaterialIndex 0 Transform { UniformScale 2 Matrix4f { 1 0 0 0 0 1 0 0 0 0 1 0 "
      "7 8 9 1 }"
      " Rotate { 0 1 0 45 } Sphere { center 0 0 0 radius 1 } }");
  EXPECT_TRUE(scene.has("rotate([0, 1, 0], 45deg)")) << scene.text;
  EXPECT_TRUE(scene.has("matrix([1, 0, 0, 7, 0, 1, 0, 8, 0, 0, 1, 9, 0, 0, 0, 1])")) << scene.text;
  EXPECT_LT(scene.text.find("rotate("), scene.text.find("scale("));
  EXPECT_LT(scene.text.find("scale("), scene.text.find("matrix("));
}

TEST(CourseTranslate, NestedTransformsAreJoinedAndGroupsKept) {
  const Translated scene = translate_objects(
      "numObjects 1 MaterialIndex 0 Transform { Translate 1 0 0 Transform { UniformScale 2 Group { "
      "numObjects 1 Sphere { center 0 0 0 "
      "radius 1 } } } }");
  EXPECT_THAT(scene.errors, IsEmpty());
  EXPECT_TRUE(scene.has("group {\n  transform = [scale(2), move([1, 0, 0])];\n  sphere"))
      << scene.text;
}

TEST(CourseTranslate, MaterialIndexRunsOnBehindAGroup) {
  const Translated scene =
      translate_course(course_camera +
                       "Materials { numMaterials 2 Material { } Material { diffuseColor 0 0 1 } }"
                       "Group { numObjects 2 Group { numObjects 1 MaterialIndex 1 Sphere { center "
                       "0 0 0 radius 1 } } Sphere { center 0 0 0 radius 2 } }");
  EXPECT_TRUE(scene.has("radius = 2; material = m1;")) << scene.text;
}

TEST(CourseTranslate, APlaneKeepsItsEquation) {
  const Translated scene =
      translate_objects("numObjects 1 MaterialIndex 0 Plane { normal 0 0 4 offset -2 }");
  EXPECT_TRUE(scene.has("plane { normal = [0, 0, 4]; offset = -0.5;")) << scene.text;
  EXPECT_THAT(scene.warnings, ElementsAre("L0404"));
  EXPECT_THAT(translate_objects("numObjects 1 MaterialIndex 0 Plane { normal 0.6 0.8 0 offset -2 }")
                  .warnings,
              IsEmpty());
}

TEST(CourseTranslate, ProfilesLeftOfTheAxisAreTurnedOver) {
  const Translated left = translate_objects(
      "numObjects 1 RevSurface { profile BezierCurve { controls [ -2 2 0 ] [ -4 0 0 ] [ 0 0 0 ] [ "
      "-2 -2 0 ] } }");
  EXPECT_TRUE(left.has("profile = bezier([[2, 2], [4, 0], [0, 0], [2, -2]])")) << left.text;
  const Translated both = translate_objects(
      "numObjects 1 RevSurface { profile BsplineCurve { controls [ -2 2 0 ] [ 4 0 0 ] [ 0 0 0 ] [ "
      "-2 -2 0 ] } }");
  EXPECT_TRUE(both.has("bspline([[-2, 2], [4, 0], [0, 0], [-2, -2]], clamped = false)"))
      << both.text;
}

TEST(CourseTranslate, ControlPointsMayComeWithoutBrackets) {
  const Translated scene = translate_objects(
      "numObjects 1 RevSurface { profile BezierCurve { controls 4 2 2 0 4 0 0 0 0 0 2 -2 0 } }");
  EXPECT_THAT(scene.errors, IsEmpty());
  EXPECT_TRUE(scene.has("bezier([[2, 2], [4, 0], [0, 0], [2, -2]])")) << scene.text;
}

TEST(CourseTranslate, MeshesAreFoundFromThreePlaces) {
  const auto text_with = [](std::string_view path) {
    MemoryFileSystem files;
    files.put(std::string(path), "");
    return translate_objects("numObjects 1 MaterialIndex 0 TriangleMesh { obj_file mesh/a.obj }",
                             "", std::move(files))
        .text;
  };
  EXPECT_THAT(text_with("mesh/a.obj"), testing::HasSubstr("file = \"../mesh/a.obj\""));
  EXPECT_THAT(text_with("scenes/mesh/a.obj"), testing::HasSubstr("file = \"mesh/a.obj\""));
}

TEST(CourseTranslate, TheMethodFollowsTheVocabulary) {
  const std::string lights = "Lights { numLights 1 PointLight { position 0 1 0 color 1 1 1 } }\n";
  const auto text_of = [&](std::string_view material, std::optional<ir::Method> method = {}) {
    return translate_course(course_camera + lights + "Materials { numMaterials 1 Material { " +
                                std::string(material) + " } } Group { " + std::string(ball) + " }",
                            {}, {.scene_path = "s.txt", .output_directory = "", .method = method})
        .text;
  };
  EXPECT_THAT(text_of("diffuseColor 1 1 1"), testing::HasSubstr("intensity = 1; decay = .none;"));
  EXPECT_THAT(text_of("reflectiveColor 1 1 1"), testing::HasSubstr("method = .whitted;"));
  EXPECT_THAT(text_of("reflectiveColor 1 1 1"),
              testing::HasSubstr("intensity = pi; decay = .none;"));
  EXPECT_THAT(text_of("emission 1 1 1"), testing::HasSubstr("method = .path;"));
  EXPECT_THAT(text_of("emission 1 1 1"), testing::Not(testing::HasSubstr("film")));
  const std::string forced = text_of("diffuseColor 1 1 1", ir::Method::path);
  EXPECT_THAT(forced, testing::HasSubstr("method = .path; background"));
  EXPECT_THAT(forced, testing::HasSubstr("intensity = pi;"));
}

TEST(CourseTranslate, TheLastBlockOfAKindCounts) {
  const Translated scene = translate_course(
      course_camera +
      "Background { color 1 0 0 } Background { color 0 0 1 } Group { numObjects 0 }");
  EXPECT_TRUE(scene.has("background = rgb(0, 0, 1)"));
  EXPECT_THAT(scene.warnings, ElementsAre("L0403"));
}

// ---- mistakes
// --------------------------------------------------------------------------------------

TEST(CourseMistakes, AMisspeltWordIsOneError) {
  EXPECT_THAT(
      translate_objects("numObjects 1 MaterialIndex 0 Sphere { center 0 0 0 raduis 1 }").errors,
      ElementsAre("3:60 E0401 `raduis` has no reading in a sphere"));
  EXPECT_THAT(
      translate_objects("numObjects 1 MaterialIndex 0 Spere { center 0 0 0 radius 1 }").errors,
      ElementsAre("3:38 E0401 `Spere` has no reading in a group"));
}

TEST(CourseMistakes, AWordInThePlaceOfANumberIsOneError) {
  EXPECT_THAT(
      translate_objects("numObjects 1 MaterialIndex 0 Sphere { center 0 0 0 radius one }").errors,
      ElementsAre("3:67 E0402 `one` stands in the values of `radius`, which takes a number"));
}

TEST(CourseMistakes, CountsAreCompared) {
  EXPECT_THAT(
      translate_objects("numObjects 3 MaterialIndex 0 Sphere { center 0 0 0 radius 1 }").errors,
      ElementsAre("3:20 E0404 `numObjects` is 3, but there is 1 object"));
}

TEST(CourseMistakes, MaterialsComeBeforeTheirUse) {
  const Translated scene = translate_course(course_camera + "Group { " + std::string(ball) +
                                            " } Materials { numMaterials 1 Material { } }");
  EXPECT_THAT(scene.errors,
              ElementsAre("2:36 E0406 there is no `Materials` block before this group"));
}

TEST(CourseMistakes, SeveralAreFoundInOneRun) {
  const Translated scene = translate_course(
      "PerspectiveCamera { center 0 0 5 direction 0 0 -1 upp 0 1 0 angle 40 width 64 height 64 }\n"
      "Lights { numLights 1 PointLigth { position 0 3 3 color 1 1 1 } }\n"
      "Background { color 0 0 x }\n"
      "Materials { numMaterials 1 PhongMaterial { diffuseColour 1 1 1 } }\n"
      "Group { numObjects 2\n"
      "MaterialIndex 0 Spere { center 0 0 0 radius 1 }\n"
      "Sphere { center 0 0 0 radius one } }\n");
  EXPECT_EQ(scene.errors.size(), 6u) << testing::PrintToString(scene.errors);
}

TEST(CourseMistakes, AMissingFileNamesThePlacesTried) {
  EXPECT_THAT(
      translate_objects("numObjects 1 MaterialIndex 0 TriangleMesh { obj_file mesh/a.obj }").errors,
      ElementsAre("3:62 E0408 there is no file `mesh/a.obj`"));
}

TEST(CourseMistakes, NothingAtAllIsAnError) {
  EXPECT_FALSE(translate_course("").errors.empty());
  EXPECT_FALSE(translate_course("} { [ 1 ] 2 3 Group").errors.empty());
  EXPECT_FALSE(translate_course("Group { Transform { Transform {").errors.empty());
}

}  // namespace
}  // namespace scenec::test
