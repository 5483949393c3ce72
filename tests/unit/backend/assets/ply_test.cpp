#include "backend/assets/ply.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "tests/support/hostile.hpp"

namespace scenec::backend {
namespace {

std::string problem_of(std::string_view bytes) {
  const Result<MeshData, AssetProblem> mesh = read_ply(bytes);
  if (mesh) return "read";
  return std::to_string(mesh.error().line) + ": " + mesh.error().message;
}

const std::string ascii =
    "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 4\nproperty float x\n"
    "property double y\nproperty short z\nproperty uchar red\nelement edge 1\nproperty int a\n"
    "property list uchar float w\nelement face 2\nproperty uchar flags\n"
    "property list uchar int vertex_indices\nend_header\n"
    "0 0 0 255\n0.1 0 0 1\n1 1 0 2\n0 1 0 3\n7 2 0.5 0.5\n0 3 0 1 2\n1 4 0 1 2 3\n";

// Appends values in the chosen byte order.
class BinaryWriter {
 public:
  explicit BinaryWriter(bool big) : big_(big) {}

  template <class T>
  void put(T value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    if (big_) std::reverse(bytes, bytes + sizeof value);
    body.append(bytes, sizeof value);
  }

  std::string body;

 private:
  bool big_;
};

std::string binary_sample(bool big) {
  std::string bytes = "ply\r\nformat binary_";
  bytes += big ? "big" : "little";
  bytes +=
      "_endian 1.0\r\nelement face 1\r\nproperty list ushort uint vertex_index\r\n"
      "property list int double junk\r\nelement vertex 3\r\nproperty double x\r\n"
      "property float y\r\nproperty int z\r\nproperty float nx\r\nproperty float ny\r\n"
      "property float nz\r\nproperty float s\r\nproperty float t\r\nproperty char c\r\n"
      "end_header\r\n";
  BinaryWriter out(big);
  out.put<std::uint16_t>(3);
  for (const std::uint32_t index : {2u, 1u, 0u}) out.put(index);
  out.put<std::int32_t>(1);
  out.put(1.5);
  for (std::int32_t i = 0; i < 3; ++i) {
    out.put(0.1 * i);
    out.put(i == 1 ? 0.25f : 0.0f);
    out.put<std::int32_t>(i == 2 ? -70'000 : 0);
    for (const float value : {0.0f, 0.0f, 1.0f, 0.5f, 0.75f}) out.put(value);
    out.put<std::int8_t>(-1);
  }
  return bytes + out.body;
}

TEST(Ply, ReadsAscii) {
  const Result<MeshData, AssetProblem> mesh = read_ply(ascii);
  ASSERT_TRUE(mesh.ok()) << mesh.error().line << ": " << mesh.error().message;
  EXPECT_EQ(mesh.value().positions[1].x, 0.1);
  EXPECT_EQ(mesh.value().triangles,
            (std::vector<TriangleIndices>{{0, 1, 2}, {0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(mesh.value().parts.size(), 1u);
}

TEST(Ply, ReadsBothByteOrders) {
  for (const bool big : {false, true}) {
    const Result<MeshData, AssetProblem> mesh = read_ply(binary_sample(big));
    ASSERT_TRUE(mesh.ok()) << mesh.error().message;
    EXPECT_EQ(mesh.value().positions[2], (Point3{0.2, 0, -70'000}));
    EXPECT_EQ(mesh.value().positions[1].y, 0.25);
    EXPECT_EQ(mesh.value().triangles[0], (TriangleIndices{2, 1, 0}));
    EXPECT_EQ(normal_indices_of(mesh.value(), 0), (TriangleIndices{2, 1, 0}));
    EXPECT_EQ(mesh.value().normals[0], (std::array<float, 3>{0, 0, 1}));
    EXPECT_EQ(mesh.value().uvs[2], (std::array<float, 2>{0.5f, 0.75f}));
  }
}

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(Ply, LocatesHeaderMistakes) {
  const auto changed = [](std::string_view from, std::string_view to) {
    return problem_of(replaced(ascii, from, to));
  };
  EXPECT_EQ(problem_of(""), "0: file is empty");
  EXPECT_EQ(problem_of("plx\n"), "1: not a PLY file; the first line must be `ply`");
  EXPECT_EQ(changed("end_header\n", "comment\n"), "16: unknown header word `0`");
  EXPECT_EQ(problem_of("ply\nformat ascii 1.0\n"), "3: `end_header` is missing");
  EXPECT_EQ(problem_of("ply\nend_header\n"), "2: `format` line is missing");
  EXPECT_EQ(changed("ascii 1.0", "asci 1.0"), "2: unknown format `asci`");
  EXPECT_EQ(changed("ascii 1.0", "ascii 2.0"), "2: PLY version `2.0`; only 1.0 is known");
  EXPECT_EQ(changed("element edge", "element vertex"), "9: second element `vertex`");
  EXPECT_EQ(changed("double y", "double x"), "6: second property `x` in element `vertex`");
  EXPECT_EQ(changed("float x", "real x"), "5: unknown type `real`");
  EXPECT_EQ(changed("float x", "float a"),
            "4: element `vertex` needs the properties `x`, `y` and `z`");
  EXPECT_EQ(changed("list uchar int", "list float int"),
            "14: list count must have a whole-number type");
  EXPECT_EQ(changed("vertex_indices", "corners"),
            "12: element `face` needs a list of whole numbers `vertex_indices`");
  EXPECT_EQ(changed("element face 2", "element faces 2"), "0: no element `face`");
}

TEST(Ply, BelievesNoCount) {
  for (const std::string_view count :
       {"9223372036854775808", "18446744073709551615", "4294967295", "1000"}) {
    const std::string problem =
        problem_of(replaced(ascii, "vertex 4", "vertex " + std::string(count)));
    EXPECT_TRUE(problem.starts_with("4: element `vertex` with ")) << problem;
  }
  for (const std::string_view count : {"-1", "18446744073709551616", "x", "4.0"}) {
    EXPECT_EQ(problem_of(replaced(ascii, "vertex 4", "vertex " + std::string(count))),
              "4: count of element `vertex` is `" + std::string(count) +
                  "`; needs a whole number from 0");
  }
  EXPECT_EQ(problem_of(replaced(ascii, "vertex 4", "vertex 0")), "4: element `vertex` has no rows");
  EXPECT_EQ(problem_of(replaced(ascii, "element edge 1", "element nothing 7\nelement edge 1")),
            "9: element `nothing` has rows but no property");
  std::string lists = binary_sample(false);
  const std::size_t body = lists.find("end_header") + 12;
  lists[body] = lists[body + 1] = '\xFF';
  EXPECT_EQ(problem_of(lists), "0: face 0: list is longer than what follows");
  lists = binary_sample(false);
  lists[body + 14] = '\xFF';
  EXPECT_EQ(problem_of(lists), "0: face 0: list is longer than what follows");
  lists[body + 17] = '\xFF';
  EXPECT_EQ(problem_of(lists), "0: face 0: list is longer than what follows");
}

TEST(Ply, LocatesBodyMistakes) {
  const auto changed = [](std::string_view from, std::string_view to) {
    return problem_of(replaced(ascii, from, to));
  };
  EXPECT_EQ(changed("1 1 0 2\n", "1 1 0\n"),
            "18: vertex 2: values are missing; the file or the row ends too early");
  EXPECT_EQ(changed("1 1 0 2\n", "1 1 0 2 3\n"), "18: vertex 2: more values than properties");
  EXPECT_EQ(changed("1 1 0 2\n", "1 1 0.5 2\n"), "18: vertex 2: value is not a whole number");
  EXPECT_EQ(changed("1 1 0 2\n", "1 a 0 2\n"), "18: vertex 2: value is not a number");
  EXPECT_EQ(changed("1 1 0 2\n", "1 nan 0 2\n"), "18: vertex 2: coordinate is not finite");
  EXPECT_EQ(changed("0 3 0 1 2\n", "0 2 0 1\n"), "21: face 0: 2 corners; needs at least 3");
  EXPECT_EQ(changed("0 3 0 1 2\n", "0 300 0 1 2\n"),
            "21: face 0: list is longer than what follows");
  EXPECT_EQ(changed("0 3 0 1 2\n", "0 3 0 1 -2\n"), "21: face 0: corner 3 has the index -2");
  EXPECT_EQ(changed("1 4 0 1 2 3\n", "1 4 0 1 2 4\n"), "22: face index 4 is beyond the 4 vertices");
  EXPECT_EQ(problem_of(ascii + "1 2 3\n"),
            "0: 6 bytes follow the last element; counts and body disagree");
  EXPECT_EQ(problem_of(ascii + " \n\n"), "read");
  EXPECT_EQ(problem_of(binary_sample(true) + "x"),
            "0: 1 bytes follow the last element; counts and body disagree");
  EXPECT_NE(problem_of(replaced(binary_sample(true), "big", "little")), "read");
  EXPECT_NE(problem_of(replaced(binary_sample(true), "binary_big_endian", "ascii")), "read");
}

TEST(Ply, RefusesEveryPrefixOfABinaryFile) {
  const auto read = [](std::string_view bytes) { return read_ply(bytes).ok(); };
  EXPECT_EQ(scenec::test::read_every_prefix(binary_sample(false), read), 0u);
  EXPECT_EQ(scenec::test::read_every_prefix(binary_sample(true), read), 0u);
  EXPECT_LE(scenec::test::read_every_prefix(ascii, read),
            1u);  // all but the last line end is still whole
}

TEST(Ply, SurvivesRandomDamage) {
  const auto read = [](std::string_view bytes) { return read_ply(bytes).ok(); };
  scenec::test::read_with_random_damage(ascii, 1, 20'000, read);
  scenec::test::read_with_random_damage(binary_sample(false), 2, 20'000, read);
  scenec::test::read_with_random_damage(binary_sample(true), 3, 20'000, read);
}

}  // namespace
}  // namespace scenec::backend
