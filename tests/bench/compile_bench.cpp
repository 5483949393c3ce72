// The front end on large scenes: placed spheres as text, from bytes to tree and from bytes to
// validated IR, and a million instances placed by a loop; and on a small one with includes, as a
// daemon compiles it again and again.
#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <sys/resource.h>

#include <iterator>
#include <string>

#include "base/file_system.hpp"
#include "base/parallel.hpp"
#include "base/source_map.hpp"
#include "frontend/compile.hpp"
#include "frontend/frontend_cache.hpp"
#include "grammar/parse.hpp"

namespace {

constexpr int small_count = 100'000;
constexpr int large_count = 1'000'000;

std::string spheres(int count) {
  std::string built =
      "sdl 1;\n"
      "material red: diffuse { color = rgb(0.8, 0.1, 0.1); }\n"
      "material blue: diffuse { color = rgb(0.1, 0.1, 0.8); }\n"
      "light key: point { position = [0, 100m, 0]; power = 60W; }\n"
      "camera main: pinhole { eye = [0, 1m, 5m]; aim = [0, 0, 0]; fov = 40deg; }\n";
  for (int i = 0; i < count; ++i) {
    fmt::format_to(
        std::back_inserter(built),
        "sphere {{ center = [{:.3f}m, {:.3f}m, {:.3f}m]; radius = 12.5mm; material = {}; }}\n",
        i % 317 * 0.25, i % 89 * 0.125, i % 1009 * 0.0625, i % 2 == 0 ? "red" : "blue");
  }
  return built;
}

double peak_mebibytes() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

void parse_100k_spheres(benchmark::State& state) {
  const std::string text = spheres(small_count);
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

void compile(benchmark::State& state, scenec::FileSystem& files, std::size_t items,
             const scenec::frontend::CompileOptions& options) {
  for (auto _ : state) {
    scenec::SourceMap sources;
    scenec::DiagnosticSink sink;
    const auto scene = scenec::frontend::compile("scene.sdl", options, files, sources, sink);
    if (!scene || scene->items.size() != items) state.SkipWithError("the scene did not compile");
  }
  state.counters["peak_MiB"] = peak_mebibytes();
}

void compile_spheres(benchmark::State& state) {
  const int count = static_cast<int>(state.range(0));
  scenec::ThreadPool pool(static_cast<unsigned>(state.range(1)));
  scenec::MemoryFileSystem files;
  files.put("scene.sdl", spheres(count));
  scenec::frontend::CompileOptions options;
  options.pool = &pool;
  compile(state, files, static_cast<std::size_t>(count), options);
}
BENCHMARK(compile_spheres)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Args({small_count, 1})
    ->Args({large_count, 1})
    ->Args({large_count, 2});

void compile_1m_instances(benchmark::State& state, const char* place) {
  scenec::MemoryFileSystem files;
  files.put("scene.sdl", fmt::format("{}proto pair {{ sphere {{ material = red; }} }}\n"
                                     "for i in 0 ..< 1000 {{ for j in 0 ..< 1000 {{\n"
                                     "  instance {{ of = pair; transform = {}; }}\n}} }}\n",
                                     spheres(0), place));
  compile(state, files, large_count, {});
}
BENCHMARK_CAPTURE(compile_1m_instances, on_a_grid, "move([i * 0.01, 0, j * 0.01])")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(compile_1m_instances, at_random,
                  "[rotate_y(random(0, i) * 360deg), move([random(1, j), random(2, i), 0])]")
    ->Unit(benchmark::kMillisecond);

// 200 lines in all, ten included files; `warm` keeps trees from one compilation to the next.
void check_10_includes(benchmark::State& state, bool warm) {
  scenec::MemoryFileSystem files;
  std::string scene = "sdl 1;\n";
  for (int i = 0; i < 10; ++i) {
    std::string library = "sdl 1;\n";
    for (int line = 0; line < 12; ++line) {
      library +=
          fmt::format("material m{0}: diffuse {{ color = rgb(0.{0}, 0.5, 0.{1}); }}\n", line, i);
    }
    files.put(fmt::format("lib{}.sdl", i), library);
    scene += fmt::format("include \"lib{0}.sdl\" as lib{0};\n", i);
    for (int line = 0; line < 6; ++line) {
      scene += fmt::format(
          "sphere {{ center = [{0}, {1}, 0]; radius = 0.25; material = lib{0}.m{1}; }}\n", i, line);
    }
  }
  files.put("scene.sdl", scene + spheres(0).substr(7));
  scenec::frontend::FrontendCache cache;
  scenec::frontend::CompileOptions options;
  if (warm) options.cache = &cache;
  compile(state, files, 60, options);
}
BENCHMARK_CAPTURE(check_10_includes, cold, false)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(check_10_includes, warm, true)->Unit(benchmark::kMicrosecond);

}  // namespace
