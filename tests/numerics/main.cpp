// Runs the cases; with --docs=DIR also checks that DIR/numerics.md says what they found. With
// --times it prints what the solvers of revolve cost, with --precision what vertices in double
// cost and change, and runs nothing.
#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "tests/numerics/document.hpp"
#include "tests/numerics/precision.hpp"
#include "tests/numerics/times.hpp"

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  std::string docs;
  constexpr std::string_view option = "--docs=";
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    if (argument == "--times") {
      std::fputs(scenec::numerics::solver_times().c_str(), stdout);
      return 0;
    }
    if (argument == "--precision") {
      std::fputs(scenec::numerics::precision_table().c_str(), stdout);
      return 0;
    }
    if (!argument.starts_with(option)) {
      std::fprintf(stderr,
                   "usage: scenec-numerics [--docs=DIR | --times | --precision] [--gtest_...]\n");
      return 2;
    }
    docs = argument.substr(option.size());
  }
  int result = RUN_ALL_TESTS();
  std::vector<std::string> complaints;
  if (!docs.empty() && !scenec::numerics::document_agrees(docs, complaints)) result = 1;
  for (const std::string& complaint : complaints) std::fprintf(stderr, "%s\n", complaint.c_str());
  return result;
}
