// Golden texts: parse/ (the lossless tree), lower/ (the IR), effects/ (what the picture depends
// on), course/ (course scenes as native text), cli/ (command lines and what they print).
// `golden_test --update` writes `<input>.expected` anew.
#include <filesystem>
#include <string>
#include <vector>

#include "tests/golden/runner.hpp"
#include "tests/support/paths.hpp"

namespace {

namespace fs = std::filesystem;
using scenec::test::Golden;

// Runs `scenec WORDS... INPUT` in the input's folder for every input there.
void compare_folder(Golden& golden, const fs::path& folder,
                    const std::vector<std::string>& extensions,
                    const std::vector<std::string>& words) {
  if (!fs::is_directory(folder)) return;
  fs::current_path(folder);
  for (const fs::path& input : scenec::test::files_in(folder, extensions)) {
    if (!golden.wants(input)) continue;
    std::vector<std::string> line = words;
    line.push_back(input.filename().string());
    golden.compare(input, scenec::test::transcript_of(scenec::test::run_scenec(line)));
  }
}

void compare_command_lines(Golden& golden, const fs::path& folder) {
  if (!fs::is_directory(folder)) return;
  fs::current_path(folder);
  for (const fs::path& input : scenec::test::files_in(folder, {".args"})) {
    if (golden.wants(input)) golden.compare(input, scenec::test::transcript_of_args(input));
  }
}

}  // namespace

int main(int argument_count, char** arguments) {
  Golden golden(argument_count, arguments);
  const fs::path root = scenec::test::source_directory() / "tests" / "golden";
  compare_folder(golden, root / "parse", {".sdl", ".txt"}, {"dump", "--stage", "tree"});
  compare_folder(golden, root / "lower", {".sdl"}, {"dump", "--stage", "ir"});
  compare_folder(golden, root / "effects", {".sdl"}, {"dump", "--stage", "effects"});
  compare_folder(golden, root / "course", {".txt"}, {"convert"});
  compare_command_lines(golden, root / "cli");
  return golden.finish();
}
