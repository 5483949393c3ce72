// Runs the kept inputs of every fuzz target in the normal build: `fuzz_replay CORPUS_DIRECTORY`.
// Each file is also cut at some places, since most mistakes are made at the end of the text.
// A target that finds something aborts; the name of the input stands above its message.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/fuzz/targets.hpp"

namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_of(const fs::path& directory) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(directory, error)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

std::string bytes_of(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

int replay(const scenec::fuzz::Target& target, const fs::path& directory) {
  int inputs = 0;
  for (const fs::path& path : files_of(directory)) {
    const std::string bytes = bytes_of(path);
    std::printf("%s\n", path.filename().c_str());
    std::fflush(stdout);
    target.run(bytes);
    for (std::size_t part = 1; part < 8; ++part) {
      target.run(std::string_view(bytes).substr(0, bytes.size() * part / 8));
    }
    ++inputs;
  }
  std::printf("fuzz_%s: %d inputs\n", std::string(target.name).c_str(), inputs);
  return inputs;
}

}  // namespace

int main(int argument_count, char** arguments) {
  if (argument_count != 2) return 2;
  bool every_target_has_inputs = true;
  for (const scenec::fuzz::Target& target : scenec::fuzz::targets) {
    every_target_has_inputs &= replay(target, fs::path(arguments[1]) / target.name) > 0;
  }
  return every_target_has_inputs ? 0 : 1;
}
