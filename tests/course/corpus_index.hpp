// The corpus's own table of its scenes and what a reader is expected to do with each.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace scenec::test {

enum class CourseClass : std::uint8_t { base, curves, extended, broken };

struct CourseScene {
  std::string folder;  // below course/: where its author ran the renderer
  std::string path;    // below folder
  CourseClass expected = CourseClass::base;
  std::vector<std::string> absent_assets;

  [[nodiscard]] std::string name() const { return folder + "/" + path; }
};

// Reads INDEX.md of the corpus's `course` folder.
[[nodiscard]] std::vector<CourseScene> read_corpus_index(const std::filesystem::path& course);

}  // namespace scenec::test
