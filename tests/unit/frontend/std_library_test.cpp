#include "frontend/lower/std_library.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/support/paths.hpp"
#include "tests/unit/frontend/compile_fixture.hpp"

namespace scenec::frontend {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST(StdLibrary, HoldsTheFilesOfItsFolder) {
  std::size_t count = 0;
  for (const auto& entry :
       fs::directory_iterator(scenec::test::source_directory() / "stdlib-scenes")) {
    if (entry.path().extension() != ".sdl") continue;
    std::ifstream stream(entry.path(), std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    EXPECT_EQ(find_library("std:" + entry.path().filename().string()), text) << entry.path();
    ++count;
  }
  EXPECT_EQ(library_files().size(), count);
  EXPECT_FALSE(find_library("std:materials").has_value());
  EXPECT_FALSE(find_library("materials.sdl").has_value());
  EXPECT_FALSE(find_library("std:examples/materials.sdl").has_value());
}

TEST(StdLibrary, EveryLibraryIsIncludedByItsName) {
  for (const std::string& name : library_names()) {
    const auto result = test::compiled(
        test::scene_with("include \"" + name + "\" as a;\ninclude \"" + name + ".sdl\" as b;\n"));
    EXPECT_EQ(result.codes, "L0201 L0201") << name << "\n" << result.rendered;
    EXPECT_TRUE(result.scene.has_value()) << name;
  }
}

TEST(StdLibrary, AnUnknownNameHasANearestOneAndAList) {
  const auto result = test::compiled(test::scene_with("include \"std:matrials\" as a;\n"));
  EXPECT_EQ(result.codes, "E0603");
  EXPECT_THAT(result.rendered, HasSubstr("did you mean `std:materials`?"));
  EXPECT_THAT(result.rendered, HasSubstr("`std:lights`"));
  for (const char* const written :
       {"std:", "std:../secret", "std:/etc/passwd", "std:examples/lights", "std:materials.sdl.sdl",
        "std:materials.txt"}) {
    EXPECT_EQ(
        test::compiled(test::scene_with("include \"" + std::string(written) + "\" as a;\n")).codes,
        "E0603")
        << written;
  }
}

TEST(StdLibrary, NothingIsReadForIt) {
  test::Compiler compile;
  compile.files.put("std:materials.sdl", "sdl 1;\nlet mine = 1;\n");
  const auto result = compile(test::scene_with(
      "include \"std:materials\" as library;\ninclude \"./std:materials.sdl\" as file;\n"
      "sphere { radius = file.mine; material = library.mine; }\n"));
  EXPECT_EQ(result.codes, "E0245") << result.rendered;
}

TEST(StdLibrary, AMistakeInsideNamesTheLibrary) {
  const auto result =
      test::compiled(test::scene_with("include \"std:shapes\" as s;\n"
                                      "s.gear([0m, 0m, 0m], grey, teeth = 1000);\n"));
  EXPECT_THAT(result.rendered, HasSubstr("std:shapes.sdl:")) << result.rendered;
}

}  // namespace
}  // namespace scenec::frontend
