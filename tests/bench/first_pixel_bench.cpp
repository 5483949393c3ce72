// From the command line to a picture of 16x16 pixels with one sample: what stands before the first
// pixel of a large binary PLY. `cold` decodes it and keeps nothing; `cached` finds it decoded.
#include <benchmark/benchmark.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "runtime/cli.hpp"
#include "tests/bench/mesh_files.hpp"

namespace {

namespace fs = std::filesystem;
using scenec::bench::Sheet;

constexpr Sheet sheet_of_810k{.columns = 675, .rows = 600};
constexpr Sheet sheet_of_10m{.columns = 2500, .rows = 2000};

double peak_mebibytes() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

class Desk {
 public:
  explicit Desk(const Sheet& sheet)
      : path_(fs::temp_directory_path() / ("scenec-bench-" + std::to_string(::getpid()))) {
    fs::create_directories(path_);
    std::ofstream(path_ / "sheet.ply", std::ios::binary) << scenec::bench::binary_ply_of(sheet);
    std::ofstream(path_ / "scene.sdl")
        << "sdl 1;\n"
           "material grey: diffuse { color = gray(0.8); }\n"
           "mesh { file = \"sheet.ply\"; material = grey; }\n"
           "light: point { position = [1, 5, 1]; power = 60W; }\n"
           "camera main: pinhole { eye = [1.2, 2, 4]; aim = [1.2, 0, 1]; fov = 40deg; }\n"
           "render { size = [16, 16]; samples = 1; }\n";
  }
  ~Desk() { fs::remove_all(path_); }
  Desk(const Desk&) = delete;
  Desk& operator=(const Desk&) = delete;

  [[nodiscard]] bool render(const std::string& cache) const {
    std::ostringstream out, err;
    const scenec::runtime::Environment environment{
        .out = out, .err = err, .variable = [](std::string_view) -> std::optional<std::string> {
          return std::nullopt;
        }};
    const std::vector<std::string> words{"render",  (path_ / "scene.sdl").string(),
                                         "-o",      (path_ / "out.png").string(),
                                         "--root",  path_.string(),
                                         "--cache", cache};
    return scenec::runtime::run(words, environment) == scenec::runtime::ExitCode::ok;
  }
  [[nodiscard]] std::string cache() const { return (path_ / "cache").string(); }

 private:
  fs::path path_;
};

void first_pixel(benchmark::State& state, const Sheet& sheet, bool cached) {
  const Desk desk(sheet);
  const std::string cache = cached ? desk.cache() : "off";
  if (cached && !desk.render(cache)) state.SkipWithError("the scene was not rendered");
  for (auto _ : state) {
    if (!desk.render(cache)) state.SkipWithError("the scene was not rendered");
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(sheet.triangle_count()));
  state.counters["peak_MiB"] = peak_mebibytes();
}

void first_pixel_810k_cold(benchmark::State& state) {
  first_pixel(state, sheet_of_810k, false);
}
BENCHMARK(first_pixel_810k_cold)->Unit(benchmark::kMillisecond)->UseRealTime();
void first_pixel_810k_cached(benchmark::State& state) {
  first_pixel(state, sheet_of_810k, true);
}
BENCHMARK(first_pixel_810k_cached)->Unit(benchmark::kMillisecond)->UseRealTime();
void first_pixel_10m(benchmark::State& state) {
  first_pixel(state, sheet_of_10m, false);
}
BENCHMARK(first_pixel_10m)->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(1);

}  // namespace
