// Readings of the vocabularies students added: materials, lights, cameras, shapes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/frontend/course_support.hpp"

namespace scenec::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

std::string material_text(std::string_view words, std::string_view block = "Material") {
  MemoryFileSystem files;
  files.put("t.png", "");
  const Translated scene =
      translate_course(course_camera + "Materials { numMaterials 1 " + std::string(block) + " { " +
                           std::string(words) + " } } Group { numObjects 0 }",
                       std::move(files));
  EXPECT_THAT(scene.errors, IsEmpty()) << words;
  const std::size_t begin = scene.text.find("material ");
  return begin == std::string::npos ? "" : scene.text.substr(begin);
}

std::string light_text(std::string_view words, std::string_view more_words = {}) {
  const Translated scene = translate_course(
      course_camera + "Lights { numLights 1 " + std::string(words) +
      " } Materials { numMaterials 1 Material { emission 9 9 9 } } Group { numObjects 1 "
      "MaterialIndex 0 Sphere { center 1 2 3 radius 4 } " +
      std::string(more_words) + "}");
  EXPECT_THAT(scene.errors, IsEmpty()) << words;
  return scene.text;
}

TEST(CourseMaterials, WeightsOfTypeAreScaledAndMixed) {
  EXPECT_EQ(material_text("color 1 0 0 type 1 0 0 refr 1.5"),
            "material m0: diffuse { color = rgb(1, 0, 0); }\n");
  EXPECT_EQ(material_text("color 0.5 1 0 type 0 0 2 refr 1.6"),
            "material m0: dielectric { ior = 1.6; tint = rgb(0.5, 1, 0); }\n");
  EXPECT_EQ(material_text("color 1 0 0 type 3 1 0"),
            "material m0_diffuse: diffuse { color = rgb(1, 0, 0); }\n"
            "material m0_mirror: mirror { color = rgb(1, 0, 0); }\n"
            "@allow(unused_declaration)\n"
            "material m0: mix { a = m0_diffuse; b = m0_mirror; weight = 0.25; }\n");
}

TEST(CourseMaterials, ThreeLobesAreTwoMixes) {
  EXPECT_THAT(material_text("color 1 0 0 type 2 1 1"),
              HasSubstr("material m0_rest1: mix { a = m0_mirror; b = m0_glass; weight = 0.5; "
                        "}\n@allow(unused_declaration)\n"
                        "material m0: mix { a = m0_diffuse; b = m0_rest1; weight = 0.5; }\n"));
}

TEST(CourseMaterials, WordsFlagsAndNumbersNameLobes) {
  EXPECT_THAT(material_text("type SPEC color 1 1 0"),
              HasSubstr("m0: mirror { color = rgb(1, 1, 0); }"));
  EXPECT_THAT(material_text("type 2 attenuation 1 1 1 refractive 2.43"),
              HasSubstr("m0: dielectric { ior = 2.43; tint = white; }"));
  EXPECT_THAT(material_text("diffuseColor 1 1 0 REFR"),
              HasSubstr("m0: dielectric { ior = 1.5; tint = rgb(1, 1, 0); }"));
  EXPECT_THAT(material_text("dielectric eta 1.6 diffuseColor 1 1 1"),
              HasSubstr("dielectric { ior = 1.6;"));
  EXPECT_THAT(material_text("reflection 1 color 1 1 1"), HasSubstr("m0: mirror"));
  EXPECT_THAT(material_text("type 3 specularColor 9 9 9"),
              HasSubstr("emission = gray(9); two_sided = true;"));
}

TEST(CourseMaterials, SharesBelowOneAbsorbTheRest) {
  EXPECT_THAT(material_text("color 1 0.5 0 diff 0.5 refl 0 refr 0"),
              HasSubstr("diffuse { color = rgb(1, 0.5, 0) * 0.5; }"));
}

TEST(CourseMaterials, SeedKindsComeFromMaterialType) {
  EXPECT_THAT(material_text("materialType 1 surfaceType 0 diffuseColor 1 0 0"),
              HasSubstr("m0: diffuse { color = rgb(1, 0, 0); }"));
  EXPECT_THAT(
      material_text("materialType 1 surfaceType 1 diffuseColor 1 1 1", "LambertianMaterial"),
      HasSubstr("m0: mirror"));
  EXPECT_THAT(material_text("materialType 1 surfaceType 2 refractiveIndex 2.0"),
              HasSubstr("m0: dielectric { ior = 2.0; }"));
  EXPECT_THAT(
      material_text(
          "materialType 2 roughness 0.2 diffuseColor 1 0.5 0.5 ks 0.1 kd 0.5 F0 0.9 0.6 0.5"),
      HasSubstr(
          "m0: ggx { base = rgb(1, 0.5, 0.5) * 0.5; f0 = rgb(0.9, 0.6, 0.5); roughness = 0.2; }"));
  EXPECT_THAT(material_text("materialType 2 roughness 0.2 F0 0.9 0.6 0.5"),
              HasSubstr("m0: conductor { f0 = rgb(0.9, 0.6, 0.5); roughness = 0.2; }"));
  EXPECT_THAT(
      material_text("reflectiveCoefficient 0.5 refractiveCoefficient 0.4 refractiveIndex 1.3"),
      HasSubstr(
          "m0: phong { diffuse = white; reflect = gray(0.5); refract = gray(0.4); ior = 1.3; }"));
}

TEST(CourseMaterials, BlockWordsNameKinds) {
  EXPECT_THAT(material_text("refractColor 1 1 1 refractIndex 1.45", "RefractiveMaterial"),
              HasSubstr("dielectric { ior = 1.45; tint = white; }"));
  EXPECT_THAT(material_text("", "Reflective"), HasSubstr("m0: mirror { color = white; }"));
  EXPECT_THAT(material_text("albedo 1 0.5 0 roughness 0.3", "Metalic"),
              HasSubstr("m0: conductor { f0 = rgb(1, 0.5, 0); roughness = 0.3; }"));
  EXPECT_THAT(material_text("lightColor 3 3 3", "LightMaterial"),
              HasSubstr("diffuse { color = black; emission = gray(3); two_sided = true; }"));
}

TEST(CourseMaterials, TexturesReplaceTheColour) {
  EXPECT_THAT(material_text("diffuseColor 1 0 0 texture t.png"),
              HasSubstr("diffuse = image(\"../t.png\");"));
  EXPECT_THAT(material_text("texture t.png 2 3"), HasSubstr("image(\"../t.png\", scale = [2, 3])"));
}

TEST(CourseMaterials, NoiseIsAFractal) {
  EXPECT_THAT(
      material_text("Noise { color 0 0 0 color 0.1 0.8 0.3 octaves 4 frequency 20 amplitude 4 }"),
      HasSubstr("fractal(20, octaves = 4, a = black, b = rgb(0.1, 0.8, 0.3))"));
}

TEST(CourseLights, AnEqualGlowingSphereIsTheSameLight) {
  EXPECT_THAT(light_text("SphereLight { position 1 2 3 color 9 9 9 radius 4 }"),
              Not(HasSubstr("light: sphere")));
  EXPECT_THAT(
      light_text("SphereLight { position 1 2 4 color 9 9 9 radius 4 }"),
      HasSubstr(
          "light: sphere { center = [1, 2, 4]; radius = 4; radiance = 1; color = gray(9); }"));
}

TEST(CourseLights, AreaLightsAreToldApartByTheirWords) {
  EXPECT_THAT(
      light_text("AreaLight { position 0 1 0 axis1 1 0 0 axis2 0 0 1 color 1 1 1 flux 50 }"),
      HasSubstr("light: quad {\n  corner = [0, 1, 0];\n  edge_u = [1, 0, 0];\n  edge_v = [0, 0, "
                "1];\n  power = 50;\n  color = white;\n}"));
  EXPECT_THAT(
      light_text("AreaLight { vertex0 0 0 0 vertex1 1 0 0 vertex2 0 0 1 color 8 8 8 }"),
      HasSubstr(
          "material light0: diffuse { color = black; emission = gray(8); two_sided = true; }"));
  EXPECT_THAT(light_text("AreaLight { position 50 80 20 color 1 0 0 normal 0 -1 0 area 4 }"),
              HasSubstr("light: disk"));
}

TEST(CourseLights, AxisLightsAreDisksAndQuads) {
  EXPECT_THAT(light_text("CircleLight { normal Z+ color 5 5 5 position -14 X 1 Y 2 radius 3 }"),
              HasSubstr("center = [1, 2, -14]; normal = [0, 0, 1]; radius = 3;"));
  EXPECT_THAT(light_text("RectLight { normal Z- color 5 5 5 position 14 X -0.5 0.5 Y -1 1 }"),
              HasSubstr("corner = [-0.5, -1, 14];\n  edge_u = [0, 2, 0];\n  edge_v = [1, 0, 0];"));
}

TEST(CourseLights, StrengthWordsAreFactorsAndPowers) {
  EXPECT_THAT(light_text("PointLight { position 0 0 0 color 1 1 1 falloff 0.25 }"),
              HasSubstr("intensity = pi / 0.25; color = white;"));
  EXPECT_THAT(light_text("PointLight { position 0 0 0 power 120 120 60 }"),
              HasSubstr("power = 1; color = rgb(120, 120, 60);"));
  EXPECT_THAT(light_text("PointLight { position 0 0 0 color 1 1 1 scale 4 }"),
              HasSubstr("color = gray(4);"));
}

TEST(CourseCamera, ALensNeedsAFocus) {
  const auto text_of = [](const std::string& words) {
    return translate_course(
               "PerspectiveCamera { center 0 0 1 direction 0 0 -1 up 0 1 0 angle 30 width 200.0 "
               "height 100 " +
               words + " } Group { numObjects 0 }")
        .text;
  };
  EXPECT_THAT(text_of("aperture 2 focus 30"), HasSubstr("main: thin_lens"));
  EXPECT_THAT(text_of("aperture 2 focus 30"), HasSubstr("aperture = 2;\n  focus = 30;"));
  EXPECT_THAT(text_of("aperture 2"), HasSubstr("main: pinhole"));
  EXPECT_THAT(text_of("aperture 0 focus 30"), HasSubstr("main: pinhole"));
  EXPECT_THAT(text_of(""), HasSubstr("size = [200, 100];"));
}

TEST(CourseObjects, ShapesOfStudents) {
  EXPECT_TRUE(
      translate_objects("numObjects 1 MaterialIndex 0 Rectangle { point 0 0 0 x 1 0 0 y 0 1 0 }")
          .has("quad { corner = [0, 0, 0]; edge_u = [1, 0, 0]; edge_v = [0, 1, 0];"));
  EXPECT_TRUE(
      translate_objects("numObjects 1 MaterialIndex 0 Square { minPoint 0 0 5 maxPoint 1 2 5 }")
          .has("quad { corner = [0, 0, 5]; edge_u = [1, 0, 0]; edge_v = [0, 2, 0];"));
  EXPECT_TRUE(translate_objects("numObjects 1 MaterialIndex 0 Cube { min_p 0 0 0 max_p 1 2 5 }")
                  .has("box { min = [0, 0, 0]; max = [1, 2, 5];"));
  const Translated moving = translate_objects(
      "numObjects 1 MaterialIndex 0 MovingSphere { center0 1 2 3 center1 4 5 6 time0 0 time1 1 "
      "radius 2 }");
  EXPECT_TRUE(moving.has("sphere { center = [1, 2, 3]; radius = 2; material = m0; }"));
  EXPECT_FALSE(moving.warnings.empty());
}

TEST(CourseObjects, EachMaterialOfAnObjFileIsAPartOfItsMesh) {
  MemoryFileSystem files;
  files.put("m/a.obj",
            "mtllib one.mtl two.mtl\nmtllib my lib.txt\nv 0 0 0\nf 1 1 1\nusemtl few\nf 1 1 1\n"
            "usemtl none\nusemtl many \nf 1 1 1\nusemtl few\nf 1 1 1\nusemtl lost\nf 1 1 1\n");
  files.put("m/one.mtl", "newmtl few\nKd 1 0 0\nKs 0.5 0.5 0.5\nNs 20\n");
  files.put("m/two.mtl", "newmtl few\nKd 0 1 0\n");
  files.put("m/my lib.txt", "newmtl many\nKd 0 0 1\nKe 2 2 2\nmap_Kd c.png\n");
  files.put("m/c.png", "");
  const Translated scene = translate_course(
      course_camera +
          "Materials { numMaterials 1 Material { diffuseColor 1 1 0 } } Group { numObjects 1 "
          "MaterialIndex 0 Group { ObjMaterialType 0 ObjFile m/a.obj } }",
      std::move(files));
  EXPECT_THAT(scene.errors, IsEmpty());
  EXPECT_THAT(scene.warnings, testing::ElementsAre("L0407"));
  for (const char* const piece :
       {"material obj0: phong { diffuse = rgb(1, 0, 0); specular = gray(0.5); shininess = 20; }",
        "diffuse = image(\"../m/c.png\");", "emission = gray(2);", "method = .path;",
        "part = \"\";", "part = \"few\"; normals = .auto; material = obj0;",
        "part = \"many\"; normals = .auto; material = obj1;",
        "part = \"lost\"; normals = .auto; material = m0;"}) {
    EXPECT_TRUE(scene.has(piece)) << piece << " in\n" << scene.text;
  }
  EXPECT_FALSE(scene.has("part = \"none\""));
}

TEST(CourseObjects, AnObjFileWithOneMaterialIsOneMesh) {
  MemoryFileSystem files;
  files.put("a.obj", "mtllib a.mtl\nv 0 0 0\nusemtl m\nf 1 1 1\nusemtl m\nf 1 1 1\n");
  files.put("a.mtl", "newmtl m\nKd 1 0 0\nmap_Kd c.png\n");
  files.put("c.png", "");
  const Translated scene =
      translate_course(course_camera +
                           "Materials { numMaterials 0 } Group { numObjects 1 MaterialIndex -1 "
                           "Group { ObjMaterialType 1 ObjFile a.obj } }",
                       std::move(files));
  EXPECT_THAT(scene.errors, IsEmpty());
  EXPECT_THAT(scene.warnings, IsEmpty());
  EXPECT_TRUE(scene.has("color = image(\"../c.png\");")) << scene.text;
  EXPECT_TRUE(scene.has("file = \"../a.obj\"; normals = .auto; material = obj0;")) << scene.text;
}

TEST(CourseObjects, ABrokenLibraryIsLocated) {
  MemoryFileSystem files;
  files.put("a.obj", "mtllib a.mtl\nv 0 0 0\nusemtl m\nf 1 1 1\n");
  files.put("a.mtl", "newmtl m\nKd 1 red 0\n");
  const Translated scene = translate_course(
      course_camera + "Materials { numMaterials 0 } Group { ObjMaterialType 1 ObjFile a.obj }",
      std::move(files));
  EXPECT_THAT(scene.errors, testing::ElementsAre(testing::HasSubstr(
                                "E0501 a.mtl:2: value of `Kd` is `red`; needs a number")));
  EXPECT_THAT(scene.warnings, IsEmpty());
}

TEST(CourseWarnings, OneAFileAndWord) {
  const Translated scene = translate_course(course_camera +
                                            "Materials { numMaterials 2 Material { type 1 0 0 } "
                                            "Material { type 0 1 0 } } Group { numObjects 0 }");
  EXPECT_THAT(scene.warnings, testing::ElementsAre("L0401"));
}

}  // namespace
}  // namespace scenec::test
