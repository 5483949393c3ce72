#include "backend/assets/obj.hpp"

#include <gtest/gtest.h>

#include <clocale>

#include "tests/support/hostile.hpp"

namespace scenec::backend {
namespace {

MeshData mesh_of(std::string_view text) {
  Result<MeshData, AssetProblem> mesh = read_obj(text);
  EXPECT_TRUE(mesh.ok()) << mesh.error().line << ": " << mesh.error().message;
  return mesh ? std::move(mesh).value() : MeshData{};
}

std::string problem_of(std::string_view text, const MeshLimits& limits = {}) {
  const Result<MeshData, AssetProblem> mesh = read_obj(text, limits);
  if (mesh) return "read";
  return std::to_string(mesh.error().line) + ": " + mesh.error().message;
}

constexpr std::string_view square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

std::string with_square(std::string_view rest) {
  return std::string(square) + std::string(rest);
}

TEST(Obj, ReadsAllCornerForms) {
  const MeshData mesh =
      mesh_of(with_square("vt 0 0.5\nvt 1\nvn 0 0 1\nf 1 2 3\nf 1/1 2/2 3/1\nf 1//1 2//1 3//-1\n"
                          "f -4/1/1 -3/2/1 -2/1/1\n"));
  ASSERT_EQ(mesh.triangles.size(), 4u);
  for (const TriangleIndices& triangle : mesh.triangles) {
    EXPECT_EQ(triangle, (TriangleIndices{0, 1, 2}));
  }
  EXPECT_EQ(normal_indices_of(mesh, 0)[0], no_index);
  EXPECT_EQ(normal_indices_of(mesh, 2), (TriangleIndices{0, 0, 0}));
  EXPECT_EQ(uv_indices_of(mesh, 1), (TriangleIndices{0, 1, 0}));
  EXPECT_EQ(uv_indices_of(mesh, 2)[1], no_index);
  EXPECT_EQ(uv_indices_of(mesh, 3), (TriangleIndices{0, 1, 0}));
  EXPECT_EQ(mesh.uvs[0], (std::array<float, 2>{0.0f, 0.5f}));
}

TEST(Obj, KeepsPositionsInDouble) {
  const MeshData mesh = mesh_of("v 0.1 +1.5e3 -1e-310\nv 1e-400 0 1\nv 0 1 0 1.0\nf 1 2 3");
  EXPECT_EQ(mesh.positions[0], (Point3{0.1, 1500, -1e-310}));
  EXPECT_EQ(mesh.positions[1].x, 0.0);
}

TEST(Obj, TakesCarriageReturnsTabsCommentsContinuationsAndAByteOrderMark) {
  const MeshData mesh = mesh_of(
      "\xEF\xBB\xBF# C:\\scenes\\\r\nv\t0 0\t0\r\nv 1 0 \\\r\n0 # end\r\n v 1 1 0\r\n\r\n"
      "f 1 2 \\\n\\\n3#x");
  ASSERT_EQ(mesh.triangles.size(), 1u);
}

TEST(Obj, AcceptsFacesBeforeTheirVertices) {
  EXPECT_EQ(mesh_of("f 1 2 3 4\n" + std::string(square)).triangles.size(), 2u);
  EXPECT_EQ(problem_of("f 1 2 3\nf 1 2 9\nf 1 2 4\n" + std::string(square)),
            "2: face index 9 is beyond the 4 vertices of the file");
}

TEST(Obj, NumbersGroupsAndMaterialsInParts) {
  const MeshData mesh = mesh_of(
      with_square("mtllib a.mtl b.mtl\nmtllib my scene.mtl\nmtllib a.mtl\nf 1 2 3\ng left wing\n"
                  "usemtl red\nf 1 2 3\nf 1 3 4\nusemtl blue\nusemtl red\nf 1 2 4\n"));
  ASSERT_EQ(mesh.parts.size(), 3u);
  EXPECT_EQ(mesh.parts[0].material, no_index);
  EXPECT_EQ(mesh.parts[1].first_triangle, 1u);
  EXPECT_EQ(mesh.parts[1].triangle_count, 2u);
  EXPECT_EQ(mesh.group_names.at(mesh.parts[1].group), "left wing");
  EXPECT_EQ(mesh.material_names.at(mesh.parts[2].material), "red");
}

TEST(Obj, ReadsOverWhatItDoesNotKnow) {
  const MeshData mesh =
      mesh_of(with_square("mtllib a.mtl\ns off\nl 1 2\ncurv2 1 2\np 1\nf 1 2 3\n"));
  EXPECT_EQ(mesh.triangles.size(), 1u);
}

TEST(Obj, LeavesOutFacesWithoutArea) {
  const MeshData mesh =
      mesh_of(with_square("v 2 0 0\nf 1 2 2\nf 1 2 5\nf 1 2 3\nf 1 2 5 2\nf 2 3 3 2\n"));
  EXPECT_EQ(mesh.triangles.size(), 1u);
  ASSERT_EQ(mesh.dropped_face_count, 4u);
  EXPECT_EQ(mesh.dropped_faces[0].line, 6u);
  EXPECT_EQ(mesh.dropped_faces[0].reason, DropReason::repeated_vertex);
  EXPECT_EQ(mesh.dropped_faces[1].reason, DropReason::zero_area);
  EXPECT_EQ(mesh.dropped_faces[2].line, 9u);
  EXPECT_EQ(mesh.dropped_faces[3].reason, DropReason::repeated_vertex);
}

TEST(Obj, LocatesWhatIsWrong) {
  const std::pair<std::string, std::string> cases[] = {
      {"", "0: file is empty"},
      {"v 0 0 0\n# nothing\n", "0: no face (`f`) in 2 lines"},
      {with_square("f 0 1 2"), "5: face index `0`: indices begin at 1, or at -1 from the end"},
      {with_square("f 1 2 5"), "5: face index 5 is beyond the 4 vertices of the file"},
      {with_square("f 1 2 -5"), "5: face index `-5`: only 4 vertices come before"},
      {with_square("f 1 2 99999999999999999999"),
       "5: face index `99999999999999999999`: index is too large"},
      {with_square("f 1 2 -99999999999999999999"),
       "5: face index `-99999999999999999999`: only 4 vertices come before"},
      {with_square("f 1/1 2/1 3/1"),
       "5: face index 1 is beyond the 0 texture coordinates of the file"},
      {with_square("f 1//1 2//1 3//1"), "5: face index 1 is beyond the 0 normals of the file"},
      {with_square("\nf 1 2"), "6: face with 2 corners; needs at least 3"},
      {with_square("f"), "5: face with 0 corners; needs at least 3"},
      {with_square("f 1 x 3"), "5: face index `x`: needs whole numbers such as `3` or `3/1/2`"},
      {with_square("f 1 2.5 3"),
       "5: face index `2.5`: needs the form `a`, `a/t`, `a//n` or `a/t/n`"},
      {with_square("vn 0 0 1\nf 1//1 2 3"),
       "6: corner 2 of the face has another form than the first"},
      {"v 0 0\n", "1: z of the vertex is missing"},
      {"v 0 nan 0\n", "1: y of the vertex is `nan`; needs a finite number"},
      {"v 0 -inf 0\n", "1: y of the vertex is `-inf`; needs a finite number"},
      {"v 0 1e400 0\n", "1: y of the vertex is `1e400`; needs a finite number"},
      {"v 0,5 1 0\n", "1: x of the vertex is `0,5`; needs a number"},
      {"v 0 1 0 red\n", "1: extra value is `red`; needs a number"},
      {"vn 0 1\n", "1: z of the normal is missing"},
      {"vn 0 1 0 1\n", "1: unexpected `1` behind the coordinates"},
      {"vt\n", "1: u of the texture coordinate is missing"},
      {"vt 1e300 0\n", "1: 1e+300 is beyond single precision"},
  };
  for (const auto& [text, expected] : cases) EXPECT_EQ(problem_of(text), expected) << text;
}

TEST(Obj, HoldsItsLimits) {
  MeshLimits limits;
  limits.line_bytes = 20;
  EXPECT_EQ(problem_of("# 3456789 123456789 \n", limits), "0: no face (`f`) in 1 lines");
  EXPECT_EQ(problem_of("v 0 0 0\n# 3456789 123456789 1\n", limits), "2: line longer than 20 bytes");
  EXPECT_EQ(problem_of("v 0 0 \\\n0 0 0 0 0 0 0 0 0 \\\n 0 0", limits),
            "1: line longer than 20 bytes");
  limits = {};
  limits.polygon_vertices = 4;
  EXPECT_EQ(problem_of(with_square("f 1 2 3 4"), limits), "read");
  EXPECT_EQ(problem_of(with_square("f 1 2 3 4 1"), limits), "5: face with more than 4 corners");
  limits = {};
  limits.triangles = 1;
  EXPECT_EQ(problem_of(with_square("f 1 2 3 4"), limits), "0: 2 triangles; at most 1 are allowed");
  limits = {};
  limits.file_bytes = 10;
  EXPECT_EQ(problem_of(square, limits), "0: file has 32 bytes; at most 10 are allowed");
}

TEST(Obj, EndsOnAMillionCornersAndOnALongLine) {
  std::string face = with_square("f");
  for (int i = 0; i < 1'000'000; ++i) face += " 1";
  EXPECT_EQ(problem_of(face), "5: face with more than 65536 corners");
  EXPECT_EQ(problem_of(std::string((std::size_t{16} << 20) + 1, 'v')),
            "1: line longer than 16777216 bytes");
}

TEST(Obj, DoesNotListenToTheLocale) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  std::setlocale(LC_ALL, "de_DE.UTF-8");
  const MeshData mesh = mesh_of("v 0.5 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3");
  std::setlocale(LC_ALL, before.c_str());
  EXPECT_EQ(mesh.positions[0].x, 0.5);
}

const std::string sample = with_square(
    "vt 0 0\nvt 1 1\nvn 0 0 1\ng a\nusemtl m\nf 1/1/1 2/2/1 3/1/1 4/2/1\nf -1//1 -2//1 -3//1\n");

TEST(Obj, SurvivesEveryPrefix) {
  scenec::test::read_every_prefix(sample,
                                  [](std::string_view bytes) { return read_obj(bytes).ok(); });
}

TEST(Obj, SurvivesRandomDamage) {
  scenec::test::read_with_random_damage(
      sample, 20240601, 20'000, [](std::string_view bytes) { return read_obj(bytes).ok(); });
}

// Found by fuzz_mesh: the reader of normals went beyond their end.
TEST(Obj, CornersWhoseSquaresOverflowAreJudgedToo) {
  // The products of differences are infinite, their difference no number: that is no area.
  const MeshData repeated =
      mesh_of("v 0 0 1e308\nv 1e308 1 0\nv 0 1 -1e308\nf 1 2 2\nf 1 2 3\nf 1 3 2 2\n");
  EXPECT_EQ(repeated.dropped_face_count, 1U);
  ASSERT_EQ(repeated.triangles.size(), 2U);
  for (const TriangleIndices& one : repeated.triangles)
    EXPECT_TRUE(one[0] != one[1] && one[1] != one[2] && one[2] != one[0]);
}

TEST(Obj, WhatNoFaceNamesIsNotInTheMesh) {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\n";
  const auto plain = read_obj(vertices + "f 1 2 3\n");
  ASSERT_TRUE(plain.ok());
  EXPECT_TRUE(plain.value().normals.empty());
  EXPECT_TRUE(plain.value().uvs.empty());
  const auto named = read_obj(vertices + "f 1/1/1 2/1/1 3/1/1\n");
  ASSERT_TRUE(named.ok());
  EXPECT_EQ(named.value().normals.size(), 1u);
  EXPECT_EQ(named.value().uvs.size(), 1u);
  const auto dropped = read_obj(vertices + "f 1/1/1 1/1/1 1/1/1\n");
  ASSERT_TRUE(dropped.ok());
  EXPECT_TRUE(dropped.value().normals.empty());
}

}  // namespace
}  // namespace scenec::backend
