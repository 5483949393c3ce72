// Every kind of diagnostic has one case named after it that produces it, and every case a kind:
// `<name>.sdl` and `<name>.txt` are checked, `<name>.args` holds command lines. What is printed is
// compared with `<input>.expected`; `diagnostics_test --update` writes that anew.
#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "base/diagnostic.hpp"
#include "tests/golden/runner.hpp"
#include "tests/support/paths.hpp"

namespace {

namespace fs = std::filesystem;
using scenec::test::Golden;

std::string transcript_of_case(const fs::path& input) {
  if (input.extension() == ".args") return scenec::test::transcript_of_args(input);
  return scenec::test::transcript_of(
      scenec::test::run_scenec({"check", input.filename().string()}));
}

}  // namespace

int main(int argument_count, char** arguments) {
  Golden golden(argument_count, arguments);
  const fs::path root = scenec::test::source_directory() / "tests" / "diagnostics";
  fs::current_path(root);
  std::map<std::string, const scenec::DiagnosticKindInfo*> kinds_without_case;
  std::map<std::string, const scenec::DiagnosticKindInfo*> kinds;
  for (const scenec::DiagnosticKindInfo& kind : scenec::all_diagnostic_kinds()) {
    kinds.emplace(kind.name, &kind);
  }
  kinds_without_case = kinds;
  for (const fs::path& input : scenec::test::files_in(root, {".sdl", ".txt", ".args"})) {
    const auto kind = kinds.find(input.stem().string());
    if (kind == kinds.end()) {
      golden.fail(input, "is named after no kind of diagnostic");
      continue;
    }
    kinds_without_case.erase(kind->first);
    if (!golden.wants(input)) continue;
    const std::string transcript = transcript_of_case(input);
    if (transcript.find(fmt::format("[{}]", kind->second->code)) == std::string::npos) {
      golden.fail(input, fmt::format("does not produce {}:\n{}", kind->second->code, transcript));
    }
    golden.compare(input, transcript);
  }
  for (const auto& [name, kind] : kinds_without_case) {
    golden.fail(root / name, fmt::format("{} has no case", kind->code));
  }
  return golden.finish();
}
