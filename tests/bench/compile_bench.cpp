// The front end on a large scene: 100,000 placed spheres, about 9 MB of text, from bytes to
// validated IR; and its first part alone, from bytes to tree.
#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <sys/resource.h>

#include <iterator>
#include <string>

#include "base/file_system.hpp"
#include "base/source_map.hpp"
#include "frontend/compile.hpp"
#include "grammar/parse.hpp"

namespace {

constexpr int sphere_count = 100'000;

const std::string& scene_text() {
  static const std::string text = [] {
    std::string built =
        "sdl 1;\n"
        "material red: diffuse { color = rgb(0.8, 0.1, 0.1); }\n"
        "material blue: diffuse { color = rgb(0.1, 0.1, 0.8); }\n"
        "light key: point { position = [0, 100m, 0]; power = 60W; }\n"
        "camera main: pinhole { eye = [0, 1m, 5m]; aim = [0, 0, 0]; fov = 40deg; }\n";
    for (int i = 0; i < sphere_count; ++i) {
      fmt::format_to(
          std::back_inserter(built),
          "sphere {{ center = [{:.3f}m, {:.3f}m, {:.3f}m]; radius = 12.5mm; material = {}; }}\n",
          i % 317 * 0.25, i % 89 * 0.125, i % 1009 * 0.0625, i % 2 == 0 ? "red" : "blue");
    }
    return built;
  }();
  return text;
}

double peak_mebibytes() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

void parse_100k_spheres(benchmark::State& state) {
  const std::string& text = scene_text();
  for (auto _ : state) {
    scenec::SourceMap sources;
    scenec::DiagnosticSink sink;
    const scenec::FileId file = sources.add("spheres.sdl", text, nullptr);
    const auto tree = scenec::grammar::parse_sdl(file, sources.text(file), sink);
    benchmark::DoNotOptimize(tree.nodes().data());
    if (sink.has_errors()) state.SkipWithError("the text has errors");
  }
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(text.size()));
}
BENCHMARK(parse_100k_spheres)->Unit(benchmark::kMillisecond);

void compile_100k_spheres(benchmark::State& state) {
  scenec::MemoryFileSystem files;
  files.put("spheres.sdl", scene_text());
  for (auto _ : state) {
    scenec::SourceMap sources;
    scenec::DiagnosticSink sink;
    const auto scene = scenec::frontend::compile("spheres.sdl", {}, files, sources, sink);
    if (!scene || scene->items.size() != sphere_count)
      state.SkipWithError("the scene did not compile");
  }
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(scene_text().size()));
  state.counters["peak_MiB"] = peak_mebibytes();
}
BENCHMARK(compile_100k_spheres)->Unit(benchmark::kMillisecond);

}  // namespace
