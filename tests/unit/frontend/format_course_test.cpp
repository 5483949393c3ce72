// The layout of course text.
#include <gtest/gtest.h>

#include "tests/unit/frontend/format_support.hpp"

namespace scenec::frontend::test {
namespace {

void expect_format(const std::string& before, const std::string& after) {
  EXPECT_EQ(formatted_course(before), after);
  EXPECT_EQ(formatted_course(after), after);
}

TEST(FormatCourse, AKeyAndItsValuesALine) {
  expect_format("PerspectiveCamera{ center 0 0\n10 angle   30\nwidth 200 }",
                "PerspectiveCamera {\n    center 0 0 10\n    angle 30\n    width 200\n}\n");
}

TEST(FormatCourse, AShortBlockStaysOnItsLine) {
  expect_format("Background{color 0 0 0}", "Background { color 0 0 0 }\n");
  expect_format("Group {\nSphere{radius 1}Empty{}}",
                "Group {\n    Sphere { radius 1 }\n    Empty { }\n}\n");
}

TEST(FormatCourse, BracketsKeepTheBlanksTheOriginalReaderNeeds) {
  expect_format("BezierCurve{controls[0 0 0][1 1 0]}",
                "BezierCurve { controls [ 0 0 0 ] [ 1 1 0 ] }\n");
}

TEST(FormatCourse, WordsThatAreValues) {
  expect_format("Material{\ntype SPEC texture a.bmp color 1 1 1}",
                "Material {\n    type SPEC\n    texture a.bmp\n    color 1 1 1\n}\n");
  expect_format("TriangleMesh{\nsmooth obj_file a.obj}",
                "TriangleMesh {\n    smooth\n    obj_file a.obj\n}\n");
}

TEST(FormatCourse, RowsOfAMatrixAndOfPointsAreTheAuthors) {
  expect_format("Transform {\nMatrix4f 1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n}",
                "Transform {\n    Matrix4f 1 0 0 0\n        0 1 0 0\n        0 0 1 0\n"
                "        0 0 0 1\n}\n");
  expect_format("BezierCurve {\ncontrols\n[ 0 0 0 ]\n  [ 1 1 0 ] }",
                "BezierCurve {\n    controls\n        [ 0 0 0 ]\n        [ 1 1 0 ]\n}\n");
}

TEST(FormatCourse, LongRowsAreWrapped) {
  std::string numbers;
  for (int i = 0; i < 40; ++i) numbers += " 100";
  const std::string text = formatted_course("A {\nb" + numbers + "\n}");
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    EXPECT_LE(end - begin, 100u);
    begin = end + 1;
  }
  EXPECT_EQ(formatted_course(text), text);
}

TEST(FormatCourse, CommentsAndBlankLinesStay) {
  expect_format("# a\n\n\nGroup { // b\n\n# c\nnumObjects 1 # d\n\n\nSphere{radius 1}\n# e\n}# f",
                "# a\n\nGroup { // b\n\n    # c\n    numObjects 1 # d\n\n    Sphere { radius 1 }\n"
                "    # e\n} # f\n");
}

TEST(FormatCourse, AnEmptyFile) {
  EXPECT_EQ(formatted_course(""), "");
  EXPECT_EQ(formatted_course("  \n\n"), "");
}

}  // namespace
}  // namespace scenec::frontend::test
