// Mesh files that mean harm or were made by broken exporters (B29, B30, B33): each is answered with
// one located problem, or read, within 2 s and 256 MiB, whatever it claims about itself.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <array>
#include <chrono>
#include <cstring>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "backend/assets/obj.hpp"
#include "backend/assets/ply.hpp"
#include "tests/support/hostile.hpp"

namespace scenec::backend {
namespace {

double peak_mebibytes() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

std::string repeated(std::string_view text, std::size_t count) {
  std::string result;
  result.reserve(text.size() * count);
  for (std::size_t i = 0; i < count; ++i) result += text;
  return result;
}

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

// The answer to a file: "read", or the line and the message of its problem.
std::string answer_of(const Result<MeshData, AssetProblem>& mesh) {
  if (mesh) return "read";
  return std::to_string(mesh.error().line) + ": " + mesh.error().message;
}

struct Case {
  const char* name;
  std::function<std::string()> bytes;
  std::string answer;
  bool is_obj = true;
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name;
}

class HostileMesh : public testing::TestWithParam<Case> {};

TEST_P(HostileMesh, IsAnsweredInTimeAndSpace) {
  const std::string bytes = GetParam().bytes();
  const double before = peak_mebibytes();
  const auto begin = std::chrono::steady_clock::now();
  const std::string answer = answer_of(GetParam().is_obj ? read_obj(bytes) : read_ply(bytes));
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  EXPECT_EQ(answer, GetParam().answer);
  EXPECT_LE(seconds.count(), 2);
  EXPECT_LE(peak_mebibytes() - before, 256);
}

std::string polygon(std::size_t corners) {
  return square + "f" + repeated(" 1 2 3", corners / 3) + "\n";
}

const std::vector<Case> obj_cases{
    {"IndexZero", [] { return square + "f 1 0 2\n"; },
     "5: face index `0`: indices begin at 1, or at -1 from the end"},
    {"IndexBeyondTheVertices", [] { return square + "f 1 2 5\n"; },
     "5: face index 5 is beyond the 4 vertices of the file"},
    {"NegativeIndexBeforeTheStart", [] { return square + "f 1 2 -5\n"; },
     "5: face index `-5`: only 4 vertices come before"},
    {"OneCorner", [] { return square + "f 1\n"; }, "5: face with 1 corners; needs at least 3"},
    {"TwoCorners", [] { return square + "f 1 2\n"; }, "5: face with 2 corners; needs at least 3"},
    {"LineElementThenFace", [] { return square + "l 1\nf 1 2 3\n"; }, "read"},
    {"LineOf1024Bytes", [] { return "# " + repeated("x", 1024) + "\n" + square + "f 1 2 3\n"; },
     "read"},
    {"FaceLineOfAMebibyte", [] { return square + "f 1 2 3" + repeated(" ", 1 << 20) + "4\n"; },
     "read"},
    {"LineBeyondTheLimit", [] { return square + repeated("#", (16 << 20) + 1) + "\nf 1 2 3\n"; },
     "5: line longer than 16777216 bytes"},
    {"ContinuedLinesBeyondTheLimit",
     [] { return square + "f 1 2 3" + repeated(" 1 2 3 \\\n", 3 << 20); },
     "5: line longer than 16777216 bytes"},
    {"EndlessContinuation", [] { return repeated("\\\n", 9 << 20); },
     "0: no face (`f`) in 9437184 lines"},
    {"MissingTextureCoordinates", [] { return square + "f 1/1 2/2 3/3\n"; },
     "5: face index 3 is beyond the 0 texture coordinates of the file"},
    {"MissingNormals", [] { return square + "f 1//1 2//2 3//3\n"; },
     "5: face index 3 is beyond the 0 normals of the file"},
    {"PolygonAtTheLimit", [] { return polygon(65'535); }, "read"},
    {"PolygonBeyondTheLimit", [] { return polygon(65'538); },
     "5: face with more than 65536 corners"},
    {"PolygonOfAMillion", [] { return polygon(1'000'000); },
     "5: face with more than 65536 corners"},
    {"NanVertex", [] { return "v 0 nan 0\n" + square + "f 1 2 3\n"; },
     "1: y of the vertex is `nan`; needs a finite number"},
    {"InfiniteVertex", [] { return "v 0 0 1e999\n" + square + "f 1 2 3\n"; },
     "1: z of the vertex is `1e999`; needs a finite number"},
    {"IncludesItself", [] { return square + "mtllib self.obj\ncall self.obj\nf 1 2 3\n"; }, "read"},
    {"AMillionDegenerateQuads", [] { return square + repeated("f 1 1 1 1\n", 1'000'000); }, "read"},
    {"AMillionGroups", [] { return square + "f 1 2 3\n" + repeated("g a\nusemtl b\n", 500'000); },
     "read"},
    {"NulBytes", [] { return square + std::string("f 1 2 3\0\n", 9); },
     "5: face index `3\\u{0}`: needs the form `a`, `a/t`, `a//n` or `a/t/n`"},
    {"AnotherFormat", [] { return std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16); },
     "0: no face (`f`) in 3 lines"},
    {"Empty", [] { return std::string(); }, "0: file is empty"},
};
INSTANTIATE_TEST_SUITE_P(Obj, HostileMesh, testing::ValuesIn(obj_cases),
                         [](const auto& test) { return std::string(test.param.name); });

std::string ply(std::string_view format, std::string_view vertices, std::string_view faces,
                std::string_view list = "uchar int") {
  return "ply\nformat " + std::string(format) + " 1.0\nelement vertex " + std::string(vertices) +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
         std::string(faces) + "\nproperty list " + std::string(list) +
         " vertex_indices\nend_header\n";
}

template <class T>
void append(std::string& out, T value) {
  std::array<char, sizeof value> bytes;
  std::memcpy(bytes.data(), &value, sizeof value);
  out.append(bytes.data(), bytes.size());
}

std::string positions(float y_of_last = 1) {
  std::string bytes;
  for (const float value : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 1.f, 1.f, 0.f, 0.f, y_of_last, 0.f})
    append(bytes, value);
  return bytes;
}

std::string triangle(std::int32_t a, std::int32_t b, std::int32_t c) {
  std::string bytes;
  append(bytes, std::uint8_t{3});
  for (const std::int32_t index : {a, b, c}) append(bytes, index);
  return bytes;
}

constexpr const char* little = "binary_little_endian";

const std::string two_triangles = triangle(0, 1, 2) + triangle(0, 2, 3);

const std::vector<Case> ply_cases{
    {"MoreVerticesThanData", [] { return ply(little, "1000", "2") + positions() + two_triangles; },
     "3: element `vertex` with 1000 rows does not fit the 74 bytes that follow", false},
    {"TwoToThe63Vertices",
     [] { return ply(little, "9223372036854775808", "2") + positions() + two_triangles; },
     "3: element `vertex` with 9223372036854775808 rows does not fit the 74 bytes that follow",
     false},
    {"TwoToThe60FacesOfTwelveBytes",
     [] { return ply(little, "4", "1537228672809129302") + positions() + two_triangles; },
     "7: element `face` with 1537228672809129302 rows does not fit the 74 bytes that follow",
     false},
    {"MinusOneFaces", [] { return ply(little, "4", "-1") + positions(); },
     "7: count of element `face` is `-1`; needs a whole number from 0", false},
    {"MoreFacesThanData", [] { return ply(little, "4", "3") + positions() + two_triangles; },
     "0: face 2: values are missing; the file or the row ends too early", false},
    {"SecondVertexElement",
     [] {
       return "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
              "element vertex 1\nend_header\n";
     },
     "5: second element `vertex`", false},
    {"ListOfTwoToThe32",
     [] {
       std::string bytes = ply(little, "4", "1", "uint int") + positions();
       append(bytes, std::uint32_t{0xFFFF'FFFF});
       return bytes + two_triangles;
     },
     "0: face 0: list is longer than what follows", false},
    {"ListOfMinusOne",
     [] {
       std::string bytes = ply(little, "4", "1", "char int") + positions();
       append(bytes, std::int8_t{-1});
       return bytes + two_triangles;
     },
     "0: face 0: list is longer than what follows", false},
    {"NoEndOfHeader", [] { return std::string("ply\nformat ascii 1.0\nelement vertex 3\n"); },
     "4: `end_header` is missing", false},
    {"HeaderOfOneEndlessLine", [] { return "ply\n" + repeated("x", (16 << 20) + 1); },
     "2: line longer than 16777216 bytes", false},
    {"AsciiHeaderAndBinaryBody",
     [] { return ply("ascii", "4", "2") + positions() + two_triangles; },
     "10: vertex 0: value is not a number", false},
    {"TheOtherByteOrder",
     [] { return ply("binary_big_endian", "4", "2") + positions() + two_triangles; },
     "0: face index 50331648 is beyond the 4 vertices", false},
    {"TrailingByte", [] { return ply(little, "4", "2") + positions() + two_triangles + "x"; },
     "0: 1 bytes follow the last element; counts and body disagree", false},
    {"NegativeIndex", [] { return ply(little, "4", "1") + positions() + triangle(0, 1, -1); },
     "0: face 0: corner 3 has the index -1", false},
    {"IndexBeyondTheVertices",
     [] {
       return ply(little, "4", "2") + positions() + two_triangles.substr(0, 13) + triangle(0, 4, 1);
     },
     "0: face index 4 is beyond the 4 vertices", false},
    {"NanVertex",
     [] {
       return ply(little, "4", "2") + positions(std::numeric_limits<float>::quiet_NaN()) +
              two_triangles;
     },
     "0: vertex 3: coordinate is not finite", false},
    {"TwoCorners",
     [] {
       std::string bytes = ply(little, "4", "2") + positions() + triangle(0, 1, 2);
       append(bytes, std::uint8_t{2});
       append(bytes, std::int64_t{1});
       return bytes + repeated("x", 4);
     },
     "0: face 1: 2 corners; needs at least 3", false},
    {"MostlyFacesWithoutArea",
     [] {
       return ply(little, "4", "500001") + positions() + triangle(0, 1, 2) +
              repeated(triangle(1, 1, 2), 500'000);
     },
     "read", false},
    {"AnotherFormat", [] { return std::string("solid cube\n"); },
     "1: not a PLY file; the first line must be `ply`", false},
    {"Empty", [] { return std::string(); }, "0: file is empty", false},
};
INSTANTIATE_TEST_SUITE_P(Ply, HostileMesh, testing::ValuesIn(ply_cases),
                         [](const auto& test) { return std::string(test.param.name); });

// What a fast path gives must be what the general one gives.
std::string packed_sample(bool polygons) {
  std::string bytes = ply(little, "4", polygons ? "5" : "4") + positions();
  bytes += triangle(0, 1, 2) + triangle(1, 1, 2);
  if (polygons) {
    append(bytes, std::uint8_t{4});
    for (const std::int32_t index : {0, 1, 2, 3}) append(bytes, index);
  }
  return bytes + triangle(0, 2, 3) + triangle(3, 1, 0);
}

TEST(PackedPly, IsReadAsTheGeneralOne) {
  for (const bool polygons : {false, true}) {
    const auto packed = read_ply(packed_sample(polygons));
    ASSERT_TRUE(packed.ok()) << packed.error().message;
    const std::string text = ply("ascii", "4", polygons ? "5" : "4") +
                             "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 1 1 2\n" +
                             (polygons ? "4 0 1 2 3\n" : "") + "3 0 2 3\n3 3 1 0\n";
    const auto general = read_ply(text);
    ASSERT_TRUE(general.ok()) << general.error().message;
    EXPECT_EQ(packed.value().positions, general.value().positions);
    EXPECT_EQ(packed.value().triangles, general.value().triangles);
    EXPECT_EQ(packed.value().triangles.size(), polygons ? 5U : 3U);
    ASSERT_EQ(packed.value().dropped_faces.size(), 1U);
    EXPECT_EQ(packed.value().dropped_faces[0].face, 1U);
    EXPECT_EQ(general.value().dropped_faces[0].line, 15U);
    EXPECT_EQ(packed.value().parts.size(), 1U);
  }
}

TEST(PackedPly, RefusesEveryPrefixAndSurvivesDamage) {
  const auto read = [](std::string_view bytes) { return read_ply(bytes).ok(); };
  for (const bool polygons : {false, true}) {
    const std::string bytes = packed_sample(polygons);
    EXPECT_EQ(test::read_every_prefix(bytes, read), 0U);
    test::read_with_random_damage(bytes, 21, 20'000, read);
  }
}

}  // namespace
}  // namespace scenec::backend
