#include "frontend/course/mtl.hpp"

#include <gtest/gtest.h>

#include "base/limits.hpp"
#include "tests/support/hostile.hpp"

namespace scenec::frontend::course {
namespace {

constexpr std::string_view sample =
    "# library\nnewmtl red paint\n  Ns 10.0\n  Ni 1.5\n  Tr 0.25  illum 2\n  Ka 1 1 1  Kd 0.5\n"
    "  Ks 0.1 0.2 0.3\n Ke 4 4 4\n map_Kd -s 2 2 -o 0.5 -clamp on my wood.png\n"
    "map_bump -bm 0.2 bump.png\nmap_d mask.png\nKm 1\nnewmtl b\nd 0.5\n";

std::string problem_of(std::string_view text) {
  const auto library = read_mtl(text, Limits{}.line_bytes);
  if (library) return "read";
  return std::to_string(library.error().line) + ": " + library.error().message;
}

TEST(Mtl, ReadsItsStatements) {
  const auto library = read_mtl(sample, Limits{}.line_bytes);
  ASSERT_TRUE(library.ok()) << library.error().message;
  ASSERT_EQ(library.value().size(), 2u);
  const MtlMaterial& red = library.value()[0];
  EXPECT_EQ(red.name, "red paint");
  EXPECT_EQ(red.shininess, 10.0);
  EXPECT_EQ(red.diffuse, (std::array<double, 3>{0.5, 0.5, 0.5}));
  EXPECT_EQ(red.specular, (std::array<double, 3>{0.1, 0.2, 0.3}));
  EXPECT_EQ(red.emission, (std::array<double, 3>{4, 4, 4}));
  EXPECT_EQ(red.diffuse_map, "my wood.png");
  EXPECT_FALSE(library.value()[1].diffuse);
}

TEST(Mtl, LocatesWhatIsWrong) {
  EXPECT_EQ(problem_of("Kd 1 1 1\n"), "1: `Kd` before the first `newmtl`");
  EXPECT_EQ(problem_of("newmtl\n"), "1: `newmtl` without a name");
  EXPECT_EQ(problem_of("newmtl a\nKd 1 1\n"), "2: value of `Kd` is missing");
  EXPECT_EQ(problem_of("newmtl a\nKd 1 1 1 1\n"), "2: unexpected `1` behind `Kd`");
  EXPECT_EQ(problem_of("newmtl a\nNs much\n"), "2: value of `Ns` is `much`; needs a number");
  EXPECT_EQ(problem_of("newmtl a\nKe nan\n"), "2: value of `Ke` is `nan`; needs a finite number");
  EXPECT_EQ(problem_of("newmtl a\nmap_Kd -s 1 1 1\n"), "2: `map_Kd` without a file name");
  EXPECT_EQ(problem_of(""), "read");
}

TEST(Mtl, SurvivesPrefixesAndRandomDamage) {
  const auto read = [](std::string_view bytes) { return read_mtl(bytes, Limits{}.line_bytes).ok(); };
  test::read_every_prefix(sample, read);
  test::read_with_random_damage(sample, 5, 20'000, read);
}

}  // namespace
}  // namespace scenec::frontend::course
