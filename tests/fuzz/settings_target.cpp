// What the command line and a file of parameters say: parsing the words, reading the JSON, and
// setting the params of a scene that has one of every type.
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/render_diagnostic.hpp"
#include "frontend/compile.hpp"
#include "ir/dump.hpp"
#include "runtime/cli.hpp"
#include "runtime/params_file.hpp"
#include "tests/fuzz/require.hpp"
#include "tests/fuzz/targets.hpp"

namespace scenec::fuzz {

namespace {

const std::string scene_text = R"(sdl 1;
param n: int = 3 in 0 .. 10;
param x: num = 0.5 in 0 .. 1;
param on: bool = true;
param name: string = "plain";
param size: length = 1m in 1mm .. 10m;
param turn: angle = 10deg;
param after: time = 1s;
param strength: power = 60W;
param warmth: temperature = 4000K in 1000K .. 20000K;
param tint: color = #f80;
param flat: vec2 = [1, 2];
param up: vec3 = [0, 1, 0];
param place: point = [0, 1, 0];
param numbers: [num] = [1, 2];
param names: [string] = ["a", "b"];
@clock param t: time = 0s in 0s .. 6s;
material m: diffuse { color = select(on, tint, blackbody(warmth)) * x; }
for i in 0 ..< n {
  group {
    transform = [rotate_y(turn * i), move([flat.x, flat.y, (t + after) / 1s])];
    sphere { center = place; radius = size; material = m; }
  }
}
assert len(name) < 100 && len(names) < 100 && len(numbers) < 100, "too long";
light: point { position = [0, 5, 0]; power = strength; }
camera main: pinhole { eye = [0, 1, 5]; aim = [0, 1, 0]; up = up; fov = 40deg; }
)";

std::optional<ir::Scene> compile(MemoryFileSystem& files, const std::string& path,
                                 const frontend::CompileOptions& options) {
  SourceMap sources;
  DiagnosticSink sink;
  auto scene = frontend::compile(path, options, files, sources, sink);
  require(scene.has_value() != sink.has_errors(), "a scene or an error, never both");
  for (const Diagnostic& diagnostic : sink.sorted()) {
    require(!render_terminal(diagnostic, sources, {}).empty(), "a message");
  }
  return scene;
}

// The words, one a line, up to an empty line; `rest` is what stands behind it.
std::vector<std::string> words_of(std::string_view bytes, std::string_view& rest) {
  std::vector<std::string> words;
  while (!bytes.empty() && bytes.front() != '\n') {
    const std::size_t end = std::min(bytes.find('\n'), bytes.size());
    words.emplace_back(bytes.substr(0, end));
    bytes.remove_prefix(std::min(end + 1, bytes.size()));
  }
  rest = bytes.empty() ? bytes : bytes.substr(1);
  return words;
}

std::vector<frontend::ParamSetting> settings_of_file(std::string_view json) {
  MemoryFileSystem files;
  files.put("params.json", std::string(json));
  SourceMap sources;
  DiagnosticSink sink;
  auto settings = runtime::read_params_file("params.json", files, sources, sink);
  require(settings.has_value() != sink.has_errors(), "settings or an error, never both");
  for (const Diagnostic& diagnostic : sink.sorted()) {
    require(!render_terminal(diagnostic, sources, {}).empty(), "a message");
  }
  // The places of names are of a source map that ends here.
  std::vector<frontend::ParamSetting> result =
      settings ? *std::move(settings) : std::vector<frontend::ParamSetting>{};
  for (frontend::ParamSetting& setting : result) setting.span = {};
  return result;
}

void apply(const runtime::Options& options, frontend::CompileOptions& compile_options) {
  for (const runtime::NameAndValue& setting : options.settings) {
    compile_options.params.push_back({.name = setting.name, .value = setting.value});
  }
  if (options.frames) {
    compile_options.frame = frontend::Frame{.number = options.frames->first,
                                            .last = options.frames->last,
                                            .per_second = options.frame_rate.value_or(24)};
  }
}

}  // namespace

void fuzz_settings(std::string_view bytes) {
  std::string_view json;
  const std::vector<std::string> words = words_of(bytes, json);
  const runtime::CommandLine command = runtime::parse_command_line(words);
  frontend::CompileOptions options;
  options.limits.items = 100;
  options.limits.steps = 100'000;
  options.params = settings_of_file(json);
  if (const auto* usage = std::get_if<runtime::UsageError>(&command)) {
    require(!usage->message.empty() && usage->message.size() < 10'000, "a message", usage->message);
  } else if (const auto* parsed = std::get_if<runtime::Options>(&command)) {
    require(runtime::picture_command(*parsed).starts_with("scenec render"), "a command");
    apply(*parsed, options);
  }
  MemoryFileSystem files;
  files.put("scene.sdl", scene_text);
  const auto scene = compile(files, "scene.sdl", options);
  if (!scene) return;
  const std::string printed = ir::dump_text(*scene, {});
  files.put("again.sdl", printed);
  const auto again = compile(files, "again.sdl", {});
  require(again && again->hash == scene->hash, "printed IR has the same hash", printed);
}

}  // namespace scenec::fuzz
