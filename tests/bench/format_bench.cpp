// `scenec fmt` without reading and writing: parse a megabyte of text and lay it out.
#include <benchmark/benchmark.h>

#include <string>

#include "base/source_map.hpp"
#include "frontend/format/formatter.hpp"
#include "grammar/parse.hpp"

namespace {

// Items as people write them, not laid out yet: nested blocks, long calls, lists and comments.
std::string megabyte_of_native_text() {
  std::string text = "sdl 1;\n";
  for (int i = 0; text.size() < (std::size_t{1} << 20); ++i) {
    const std::string n = std::to_string(i);
    text += "/// number " + n + "\nfn f" + n + "(x: num, y: length = 2cm): length = y*(x+" + n +
            ")/3;\n";
    text += "group g { transform=[scale(2),rotate_y(" + n + "deg),move([" + n +
            ",0,1])]; // placed\n  sphere { center = [" + n +
            ",1*2+3,0];radius=0.5; }\n if x > 1 { box { min = [0, 0, 0]; max = [1, 1, 1]; } } }\n";
  }
  return text;
}
std::string megabyte_of_course_text() {
  std::string text;
  for (int i = 0; text.size() < (std::size_t{1} << 20); ++i) {
    text += "Transform { Translate 1 0 " + std::to_string(i) +
            " Sphere {\ncenter 0 0 0   radius 1.5 } } // placed\n";
  }
  return text;
}

void format(benchmark::State& state, const std::string& text, scenec::grammar::Dialect dialect) {
  const bool native = dialect == scenec::grammar::Dialect::sdl;
  for (auto _ : state) {
    scenec::SourceMap sources;
    scenec::DiagnosticSink sink;
    const scenec::FileId file = sources.add("scene", text);
    const auto tree = native ? scenec::grammar::parse_sdl(file, sources.text(file), sink)
                             : scenec::grammar::parse_course(file, sources.text(file), sink);
    benchmark::DoNotOptimize(scenec::frontend::format(tree));
  }
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(text.size()));
}

void format_native_megabyte(benchmark::State& state) {
  format(state, megabyte_of_native_text(), scenec::grammar::Dialect::sdl);
}
BENCHMARK(format_native_megabyte)->Unit(benchmark::kMillisecond);

void format_course_megabyte(benchmark::State& state) {
  format(state, megabyte_of_course_text(), scenec::grammar::Dialect::course);
}
BENCHMARK(format_course_megabyte)->Unit(benchmark::kMillisecond);

}  // namespace
