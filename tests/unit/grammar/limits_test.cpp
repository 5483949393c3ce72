// Depth, size and stack: hostile texts end soon, say one thing, and need a bounded stack.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pthread.h>

#include <functional>

#include "tests/unit/grammar/parsing.hpp"

namespace scenec::grammar {
namespace {

using testing::ElementsAre;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(NDEBUG)
constexpr std::size_t stack_bytes = 8u << 20;
#else
constexpr std::size_t stack_bytes = 512u << 10;
#endif

void run_on_small_stack(std::function<void()> work) {
  pthread_attr_t attributes;
  ASSERT_EQ(pthread_attr_init(&attributes), 0);
  ASSERT_EQ(pthread_attr_setstacksize(&attributes, stack_bytes), 0);
  pthread_t thread{};
  const auto entry = [](void* argument) -> void* {
    (*static_cast<std::function<void()>*>(argument))();
    return nullptr;
  };
  ASSERT_EQ(pthread_create(&thread, &attributes, entry, &work), 0);
  pthread_join(thread, nullptr);
  pthread_attr_destroy(&attributes);
}

std::string repeated(std::string_view piece, std::size_t count) {
  std::string text;
  text.reserve(piece.size() * count);
  for (std::size_t i = 0; i < count; ++i) text += piece;
  return text;
}

TEST(Limits, nesting_is_one_error_on_a_small_stack) {
  run_on_small_stack([] {
    for (std::string_view piece : {"(", "[", "f(", "-(", "a[", "[for i in ", "1 < 2 + 3 * !("}) {
      const Parsed parsed(Dialect::sdl, "sdl 1; let a = " + repeated(piece, 200000));
      ASSERT_EQ(parsed.errors().size(), 1u) << piece;
      EXPECT_TRUE(parsed.errors()[0].starts_with("E0701")) << parsed.errors()[0];
      EXPECT_TRUE(parsed.sink.only_limits());
    }
    for (std::string_view piece :
         {"group {", "if a {", "for i in 0 .. 1 {", "sphere {", "if a { } else "}) {
      const Parsed parsed(Dialect::sdl, "sdl 1; " + repeated(piece, 200000));
      ASSERT_EQ(parsed.errors().size(), 1u) << piece;
      EXPECT_TRUE(parsed.errors()[0].starts_with("E0701")) << parsed.errors()[0];
      EXPECT_EQ(reassembled_text(parsed.tree), parsed.text);
    }
    EXPECT_THAT(Parsed(Dialect::course, repeated("{ ", 200000)).errors(),
                ElementsAre("E0701 512..513"));
    EXPECT_EQ(Parsed(Dialect::sdl, "sdl 1; let a: " + repeated("[", 200000)).errors().size(), 1u);
    EXPECT_EQ(Parsed(Dialect::sdl, repeated("{", 200000)).errors().size(), 1u);
    EXPECT_EQ(Parsed(Dialect::sdl, repeated(")", 200000)).errors().size(), 1u);
  });
}

TEST(Limits, nesting_up_to_the_limit_is_fine) {
  run_on_small_stack([] {
    for (std::size_t depth : {255u, 256u, 257u}) {
      const std::size_t errors = depth > 256 ? 1 : 0;
      const Parsed parens(Dialect::sdl, "sdl 1; let a = " + repeated("-(1 + 2 * ", depth) + "1" +
                                            repeated(")", depth) + ";");
      EXPECT_EQ(parens.sink.error_count(), errors);
      const Parsed blocks(Dialect::sdl,
                          "sdl 1; " + repeated("group {", depth) + repeated("}", depth));
      EXPECT_EQ(blocks.sink.error_count(), errors);
      const Parsed members(Dialect::sdl, "sdl 1; let a = b" + repeated(".c", depth) + ";");
      EXPECT_EQ(members.sink.error_count(), errors);
    }
  });
}

TEST(Limits, a_hit_limit_keeps_what_was_read_before) {
  const Parsed parsed(Dialect::sdl, "sdl 1; let a = 1; let b = ((((1)))); let c = 2;",
                      {.nesting = 3});
  EXPECT_EQ(outline(parsed.tree).substr(0, 60),
            "(file (edition sdl 1) (let let a (number_literal 1)) (error ");
  EXPECT_EQ(reassembled_text(parsed.tree), parsed.text);
}

TEST(Limits, long_chains_are_flat) {
  run_on_small_stack([] {
    for (const std::string& text :
         {"1" + repeated("+1", 1000000), repeated("-", 1000000) + "1",
          "[" + repeated("1,", 200000) + "]", "a" + repeated("&&a*a||a", 100000)}) {
      const Parsed parsed(Dialect::sdl, "sdl 1; let a = " + text + ";");
      EXPECT_EQ(parsed.sink.error_count(), 0u);
    }
  });
}

TEST(Limits, tokens_and_files) {
  EXPECT_THAT(Parsed(Dialect::sdl, "sdl 1; let abcd = 1; let abcde = 1;", {.token = 4}).errors(),
              ElementsAre("E0702 25..30"));
  EXPECT_THAT(Parsed(Dialect::sdl, "sdl 1; a = \"12\"; b = \"123\";", {.string = 5}).errors(),
              testing::IsEmpty());
  EXPECT_THAT(
      Parsed(Dialect::sdl, "sdl 1; a = \"12\"; b = \"123\";", {.token = 3, .string = 4}).errors(),
      ElementsAre("E0703 21..26"));
  const Parsed large(Dialect::sdl, "sdl 1; let a = 1;", {.file = 16});
  EXPECT_THAT(large.errors(), ElementsAre("E0702 0..0"));
  const Parsed wide(Dialect::sdl, "sdl 1;\nlet a = 1 + 1 + 1;\n", {.line = 16});
  EXPECT_THAT(wide.errors(), ElementsAre("E0702 7..8"));
  EXPECT_EQ(reassembled_text(wide.tree), wide.text);
  EXPECT_EQ(reassembled_text(large.tree), large.text);
}

TEST(Limits, megabytes_of_one_thing) {
  EXPECT_EQ(Parsed(Dialect::sdl, "sdl 1; let " + std::string(15u << 20, 'a') + " = 1;")
                .sink.error_count(),
            1u);
  EXPECT_EQ(
      Parsed(Dialect::sdl, "sdl 1; let a = 1;" + std::string(15u << 20, ' ')).sink.error_count(),
      0u);
  EXPECT_EQ(Parsed(Dialect::sdl, "sdl 1; //" + std::string(15u << 20, 'x')).sink.error_count(), 0u);
  EXPECT_EQ(Parsed(Dialect::sdl, "sdl 1; let a = \"" + std::string(15u << 20, 'x') + "\";")
                .sink.error_count(),
            1u);
}

}  // namespace
}  // namespace scenec::grammar
