#include "tests/course/corpus_index.hpp"

#include <fstream>
#include <optional>
#include <sstream>
#include <string_view>

namespace scenec::test {

namespace {

std::string trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(' ');
  if (begin == std::string_view::npos) return "";
  return std::string(text.substr(begin, text.find_last_not_of(' ') - begin + 1));
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line.substr(1));
  std::string cell;
  while (std::getline(stream, cell, '|')) cells.push_back(trimmed(cell));
  return cells;
}

std::optional<CourseClass> class_of(std::string_view expected) {
  if (expected.starts_with("valid base + curves")) return CourseClass::curves;
  if (expected.starts_with("valid base")) return CourseClass::base;
  if (expected.starts_with("valid extended")) return CourseClass::extended;
  if (expected.starts_with("known-broken")) return CourseClass::broken;
  return std::nullopt;
}

// "... Assets absent here: a.obj (not in snapshot), b.jpg (type not carried)"
std::vector<std::string> absent_assets_of(std::string_view expected) {
  constexpr std::string_view heading = "Assets absent here:";
  std::vector<std::string> names;
  std::size_t at = expected.find(heading);
  if (at == std::string_view::npos) return names;
  at += heading.size();
  while (at < expected.size()) {
    const std::size_t reason = expected.find(" (", at);
    if (reason == std::string_view::npos) break;
    names.push_back(trimmed(expected.substr(at, reason - at)));
    const std::size_t comma = expected.find("), ", reason);
    if (comma == std::string_view::npos) break;
    at = comma + 2;
    at = expected.find_first_not_of(", ", at);
  }
  return names;
}

}  // namespace

std::vector<CourseScene> read_corpus_index(const std::filesystem::path& course) {
  std::vector<CourseScene> scenes;
  std::ifstream stream(course / "INDEX.md");
  std::string line;
  std::string folder;
  while (std::getline(stream, line)) {
    if (line.starts_with("## ")) folder = trimmed(line.substr(3));
    if (!line.starts_with("| ")) continue;
    const std::vector<std::string> cells = cells_of(line);
    if (cells.size() < 5) continue;
    const std::optional<CourseClass> expected = class_of(cells[4]);
    if (!expected) continue;
    scenes.push_back({folder, cells[0], *expected, absent_assets_of(cells[4])});
  }
  return scenes;
}

}  // namespace scenec::test
