// The inputs of tests/golden/parse: they cover every rule of both grammars.
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "grammar/parse.hpp"
#include "tests/support/paths.hpp"

namespace scenec::grammar {

struct GoldenInput {
  std::string name;
  Dialect dialect;
  std::string text;
};

inline std::vector<GoldenInput> golden_inputs() {
  std::vector<GoldenInput> inputs;
  for (const auto& entry :
       std::filesystem::directory_iterator(test::source_directory() / "tests/golden/parse")) {
    const std::filesystem::path extension = entry.path().extension();
    if (extension != ".sdl" && extension != ".txt") continue;
    std::ifstream file(entry.path(), std::ios::binary);
    inputs.push_back({entry.path().filename().string(),
                      extension == ".sdl" ? Dialect::sdl : Dialect::course,
                      std::string(std::istreambuf_iterator<char>(file), {})});
  }
  std::sort(inputs.begin(), inputs.end(),
            [](const GoldenInput& a, const GoldenInput& b) { return a.name < b.name; });
  return inputs;
}

}  // namespace scenec::grammar
