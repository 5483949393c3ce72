#include "tests/numerics/light_cases.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string_view>
#include <vector>

#include "tests/support/paths.hpp"

namespace scenec::numerics {
namespace {

struct LightCase {
  std::string_view id;
  std::string_view claim;
  std::string_view tests;  // FILE:Suite.Name, or a file that is a case by itself
};
#define SCENEC_LIGHT_CASE(id, claim, tests) LightCase{id, claim, tests},
constexpr std::array all_cases{
#include "tests/numerics/light_cases.def"
};
#undef SCENEC_LIGHT_CASE

struct Family {
  char letter;
  int last;
};
// Shading, sampling, camera and film, textures, statistics, determinism, effects.
constexpr Family families[] = {{'S', 15}, {'P', 15}, {'C', 9}, {'T', 4},
                               {'X', 7},  {'D', 4},  {'E', 8}};

struct Holder {
  std::string file;
  std::string suite;
  std::string name;  // empty: the file itself is the case
};
std::vector<Holder> holders_of(const LightCase& c) {
  std::istringstream words{std::string(c.tests)};
  std::vector<Holder> out;
  for (std::string word; words >> word;) {
    const std::size_t colon = word.find(':');
    if (colon == std::string::npos) {
      out.push_back({word, "", ""});
      continue;
    }
    const std::size_t dot = word.find('.', colon);
    out.push_back(
        {word.substr(0, colon), word.substr(colon + 1, dot - colon - 1), word.substr(dot + 1)});
  }
  return out;
}

std::string text_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

bool exists(const Holder& h) {
  const std::filesystem::path path = test::source_directory() / "tests" / h.file;
  if (h.name.empty()) return std::filesystem::exists(path);
  const std::string text = text_of(path);
  for (const char* const macro : {"TEST", "TEST_P", "TEST_F"})
    if (text.find(fmt::format("{}({}, {})", macro, h.suite, h.name)) != std::string::npos)
      return true;
  return false;
}

TEST(LightCases, EveryIdIsThereOnceAndInOrder) {
  std::size_t at = 0;
  for (const Family& family : families)
    for (int i = 1; i <= family.last; ++i, ++at) {
      ASSERT_LT(at, all_cases.size());
      EXPECT_EQ(all_cases[at].id, fmt::format("{}{:02}", family.letter, i));
    }
  EXPECT_EQ(at, all_cases.size());
}

TEST(LightCases, EveryTestThatIsNamedExists) {
  for (const LightCase& c : all_cases) {
    const std::vector<Holder> holders = holders_of(c);
    EXPECT_FALSE(holders.empty()) << c.id;
    for (const Holder& h : holders)
      EXPECT_TRUE(exists(h)) << c.id << ": " << h.file << " has no " << h.suite << "." << h.name;
  }
}

}  // namespace

std::string light_case_table() {
  std::string out = "\n| case | what must hold | tests, below `tests/` |\n|---|---|---|\n";
  for (const LightCase& c : all_cases) {
    out += fmt::format("| {} | {} |", c.id, c.claim);
    std::string file;
    for (const Holder& h : holders_of(c)) {
      if (h.name.empty())
        out += fmt::format(" `{}`", h.file);
      else if (h.file == file)
        out += fmt::format(", `{}`", h.name);
      else
        out += fmt::format("{} `{}`: `{}.{}`", file.empty() ? "" : ";", h.file, h.suite, h.name);
      file = h.file;
    }
    out += " |\n";
  }
  return out;
}

}  // namespace scenec::numerics
