#include "base/ids.hpp"

#include <gtest/gtest.h>

#include <type_traits>

#include "base/result.hpp"
#include "base/span.hpp"

namespace scenec {
namespace {

struct Shape {
  int sides = 0;
};
struct Light {};

static_assert(!std::is_convertible_v<Id<Shape>, Id<Light>>);
static_assert(!std::is_convertible_v<std::uint32_t, Id<Shape>>);
static_assert(!std::is_constructible_v<Id<Shape>, Id<Light>>);

TEST(Ids, AreHandedOutInOrder) {
  Table<Shape> shapes;
  EXPECT_TRUE(shapes.empty());
  const Id<Shape> first = shapes.push({3});
  const Id<Shape> second = shapes.push({4});
  EXPECT_EQ(first.value(), 0U);
  EXPECT_LT(first, second);
  EXPECT_EQ(shapes[second].sides, 4);
  shapes[first].sides = 5;
  int sum = 0;
  for (const Shape& shape : shapes) sum += shape.sides;
  EXPECT_EQ(sum, 9);
  EXPECT_EQ(shapes.size(), 2U);
}

TEST(Ids, InvalidOnesAreCaught) {
  const Table<Shape> shapes;
  EXPECT_FALSE(Id<Shape>().valid());
  EXPECT_DEATH((void)shapes[Id<Shape>()], "internal failure");
  EXPECT_DEATH((void)shapes[Id<Shape>(0)], "internal failure");
}

TEST(Spans, JoinAndCompare) {
  const FileId file(2);
  EXPECT_EQ(join({file, 5, 9}, {file, 2, 6}), (Span{file, 2, 9}));
  EXPECT_EQ(join({file, 2, 9}, {file, 3, 4}), (Span{file, 2, 9}));
  EXPECT_FALSE(Span{}.valid());
  EXPECT_LT((Span{FileId(0), 50, 60}), (Span{FileId(1), 0, 1}));
}

TEST(Results, HoldOneOfBoth) {
  const Result<int, std::string> good(3);
  const Result<int, std::string> bad(Failure{std::string("why")});
  EXPECT_TRUE(good);
  EXPECT_EQ(good.value(), 3);
  EXPECT_FALSE(bad.ok());
  EXPECT_EQ(bad.error(), "why");
  EXPECT_DEATH((void)bad.value(), "internal failure");
  EXPECT_DEATH((void)good.error(), "internal failure");
}

}  // namespace
}  // namespace scenec
