// Where a test finds the project and the shared corpus of scenes. The corpus is not part of the
// repository: a test that needs it skips with `missing_corpus` as its message when it is absent.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string_view>
#include <system_error>

namespace scenec::test {

[[nodiscard]] std::filesystem::path source_directory();

// The folder that holds `course/`: $SCENEC_CORPUS, else `../shared/corpus` beside the project.
[[nodiscard]] inline std::optional<std::filesystem::path> find_corpus() {
  const char* const named = std::getenv("SCENEC_CORPUS");
  const bool is_named = named != nullptr && *named != '\0';
  const std::filesystem::path path = is_named
                                         ? std::filesystem::path(named)
                                         : source_directory().parent_path() / "shared" / "corpus";
  std::error_code error;
  if (!std::filesystem::is_directory(path, error)) return std::nullopt;
  return path;
}

inline constexpr std::string_view missing_corpus =
    "the corpus is absent; set SCENEC_CORPUS to the folder that holds course/";

}  // namespace scenec::test
