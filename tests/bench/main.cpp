// scenec-bench: `rays ...` replays recorded rays, `scaling` measures trees of growing meshes,
// `lights` what the choice among lights brings; anything else goes to Google Benchmark.
#include <benchmark/benchmark.h>

#include <string_view>

#include "tests/bench/lights.hpp"
#include "tests/bench/rays.hpp"
#include "tests/bench/scaling.hpp"

int main(int argc, char** argv) {
  if (argc > 1 && std::string_view(argv[1]) == "rays")
    return scenec::bench::run_rays(argc - 2, argv + 2);
  if (argc > 1 && std::string_view(argv[1]) == "scaling")
    return scenec::bench::run_scaling(argc - 2, argv + 2);
  if (argc > 1 && std::string_view(argv[1]) == "lights")
    return scenec::bench::run_lights(argc - 2, argv + 2);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
