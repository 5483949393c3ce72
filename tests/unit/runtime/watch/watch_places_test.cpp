#include "runtime/watch/watch_places.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/unit/base/temporary_directory.hpp"

namespace scenec::runtime {
namespace {

namespace fs = std::filesystem;
using test::TemporaryDirectory;

bool contains(const std::vector<Place>& places, const Place& place) {
  return std::find(places.begin(), places.end(), place) != places.end();
}

TEST(watch_places, every_directory_entry_on_the_way_is_a_place) {
  const TemporaryDirectory folder;
  fs::create_directory(folder / "sub");
  const std::string path = folder.write("sub/a.sdl", "x");
  const auto places = places_of(path);
  ASSERT_GE(places.size(), 3U);
  EXPECT_EQ(places.front().directory, "/");
  EXPECT_EQ(places.back(), (Place{folder / "sub", "a.sdl"}));
  EXPECT_TRUE(contains(places, {folder.path(), "sub"}));
}

TEST(watch_places, both_ends_of_a_link_are_places) {
  const TemporaryDirectory folder;
  folder.write("real.sdl", "x");
  fs::create_symlink("real.sdl", folder / "link.sdl");
  const auto places = places_of(folder / "link.sdl");
  EXPECT_TRUE(contains(places, {folder.path(), "link.sdl"}));
  EXPECT_EQ(places.back(), (Place{folder.path(), "real.sdl"}));
}

TEST(watch_places, what_is_missing_ends_the_way) {
  const TemporaryDirectory folder;
  EXPECT_EQ(places_of(folder / "no/such/a.sdl").back(), (Place{folder.path(), "no"}));
}

TEST(watch_places, links_in_a_circle_end) {
  const TemporaryDirectory folder;
  fs::create_symlink("b", folder / "a");
  fs::create_symlink("a", folder / "b");
  EXPECT_TRUE(contains(places_of(folder / "a"), {folder.path(), "b"}));
}

TEST(watch_places, a_step_back_is_taken_behind_links) {
  const TemporaryDirectory folder;
  fs::create_directories(folder / "x/y");
  fs::create_directory_symlink("x/y", folder / "to_y");
  folder.write("x/a.sdl", "");
  EXPECT_EQ(places_of(folder / "to_y/../a.sdl").back(), (Place{folder / "x", "a.sdl"}));
}

}  // namespace
}  // namespace scenec::runtime
