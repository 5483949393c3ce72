#include "runtime/options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>

#include "base/shell_words.hpp"
#include "base/text.hpp"

namespace scenec::runtime {

namespace {

using Problem = std::optional<std::string>;

constexpr VerbSet render_only{Verb::render};
constexpr VerbSet picturing{Verb::render, Verb::watch};
constexpr VerbSet timed{Verb::render, Verb::watch, Verb::study};
constexpr VerbSet sampled{Verb::render, Verb::watch, Verb::stress};
constexpr VerbSet rendering{Verb::render, Verb::watch, Verb::study, Verb::stress};
constexpr VerbSet compiling{Verb::render,  Verb::watch, Verb::check,  Verb::dump,
                            Verb::explain, Verb::study, Verb::stress, Verb::verify};
constexpr VerbSet parametric{Verb::render,  Verb::watch, Verb::check, Verb::dump,
                             Verb::explain, Verb::study, Verb::stress};
constexpr VerbSet reading{Verb::render, Verb::watch,   Verb::check, Verb::dump,  Verb::convert,
                          Verb::fmt,    Verb::explain, Verb::study, Verb::stress};
constexpr VerbSet colored{Verb::render, Verb::watch,   Verb::check, Verb::dump,   Verb::convert,
                          Verb::fmt,    Verb::explain, Verb::study, Verb::stress, Verb::verify};
constexpr VerbSet diagnosing{Verb::render,  Verb::check, Verb::dump,  Verb::convert,
                             Verb::explain, Verb::study, Verb::stress};
constexpr VerbSet printing{Verb::render,  Verb::check, Verb::dump,   Verb::convert,
                           Verb::explain, Verb::study, Verb::stress, Verb::verify};
constexpr VerbSet rooted{Verb::render,  Verb::watch, Verb::check,  Verb::dump,  Verb::convert,
                         Verb::explain, Verb::study, Verb::stress, Verb::verify};
constexpr VerbSet writing{Verb::render, Verb::watch, Verb::dump,  Verb::convert,
                          Verb::diff,   Verb::study, Verb::stress};
constexpr VerbSet sampling{Verb::render, Verb::watch, Verb::study, Verb::stress, Verb::verify};
constexpr VerbSet caching{Verb::render, Verb::watch, Verb::check, Verb::verify};
constexpr VerbSet working{Verb::render, Verb::watch,  Verb::check,
                          Verb::study,  Verb::stress, Verb::verify};
constexpr VerbSet watch_only{Verb::watch};

constexpr std::int64_t largest_sample_count = 1048576;
constexpr std::int64_t largest_thread_count = 1024;
constexpr std::int64_t largest_port = 65535;

// `Target` is the optional member that takes the value.
template <class Target, class T>
Problem store_parsed(Target& target, Parsed<T> value) {
  if (!value) return value.error();
  target = std::move(value).value();
  return std::nullopt;
}

// The enumerator whose name is `text`; else the list of names, the nearest one first.
template <class E, std::size_t count, class Target>
Problem store_choice(Target& target, std::string_view text,
                     const std::array<std::string_view, count>& names) {
  const auto found = std::find(names.begin(), names.end(), text);
  if (found != names.end()) {
    target = static_cast<E>(found - names.begin());
    return std::nullopt;
  }
  const std::string list = "one of " + quoted_list(names);
  const std::optional<std::string_view> nearest = nearest_name(text, names);
  return nearest ? fmt::format("{}; did you mean `{}`?", list, *nearest) : list;
}

Problem store_stats(Options& options, std::string_view text) {
  constexpr std::string_view json_prefix = "json:";
  if (text.empty() || text == "table") {
    options.stats = StatsForm::table;
    return std::nullopt;
  }
  if (!text.starts_with(json_prefix) || text.size() == json_prefix.size()) {
    return "`table` or `json:FILE`";
  }
  options.stats = StatsForm::json;
  options.stats_file = text.substr(json_prefix.size());
  return std::nullopt;
}

Problem store_setting(Options& options, std::string_view text) {
  Parsed<NameAndValue> setting = parse_setting(text);
  if (!setting) return setting.error();
  const auto same_name = [&](const NameAndValue& other) {
    return other.name == setting.value().name;
  };
  if (std::any_of(options.settings.begin(), options.settings.end(), same_name)) {
    return fmt::format("one value for each parameter; `{}` has two", setting.value().name);
  }
  options.settings.push_back(std::move(setting).value());
  return std::nullopt;
}

Problem store_path(std::string& target, std::string_view text) {
  if (text.empty()) return "the name of a file";
  target = text;
  return std::nullopt;
}

Problem store_root(Options& options, std::string_view text) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(text, ignored)) return "the name of a directory";
  options.root = text;
  return std::nullopt;
}

Problem store_target(Options& options, std::string_view text) {
  options.target = backend::find_target(text);
  if (options.target) return std::nullopt;
  std::vector<std::string_view> names{"auto"};
  for (const backend::Target target : backend::available_targets())
    names.push_back(backend::name_of(target));
  return fmt::format("an instruction set of this machine: one of {}", quoted_list(names));
}

std::optional<std::string> store_limit(std::uint64_t& place, std::string_view text,
                                       std::int64_t lowest, std::int64_t highest) {
  std::optional<std::int64_t> value;
  auto problem = store_parsed(value, parse_whole_number(text, lowest, highest));
  if (value) place = static_cast<std::uint64_t>(*value);
  return problem;
}

Problem store_display_server(Options& options, std::string_view text) {
  const std::size_t colon = text.rfind(':');
  const auto port =
      colon == std::string_view::npos ? std::nullopt : parse_int(text.substr(colon + 1));
  if (colon == 0 || !port || *port < 1 || *port > largest_port)
    return "a host and a port, as in `127.0.0.1:14158`";
  options.display_server = {std::string(text.substr(0, colon)), static_cast<int>(*port)};
  return std::nullopt;
}

using Text = std::string_view;
constexpr std::array option_table{
    OptionRow{"-o,--output", "FILE",
              "where to write (pictures: .png, .exr or .bmp; study: a folder)", writing,
              [](Options& o, Text v) { return store_path(o.output, v); }},
    OptionRow{"--size", "WxH", "width and height in pixels", rendering,
              [](Options& o, Text v) { return store_parsed(o.size, parse_size(v)); }},
    OptionRow{"--samples", "N", "samples a pixel; replaces the scene's samples and stop", sampled,
              [](Options& o, Text v) {
                return store_parsed(o.samples, parse_whole_number(v, 1, largest_sample_count));
              }},
    OptionRow{"--error", "E", "stop at this relative error of the picture: 1%", render_only,
              [](Options& o, Text v) { return store_parsed(o.error, parse_share(v)); }},
    OptionRow{"--time", "TIME", "stop after this time: 500ms, 30s, 2min, 1h", timed,
              [](Options& o, Text v) { return store_parsed(o.time, parse_duration(v)); }},
    OptionRow{"--adaptive", "", "more samples where the error is; the numbers are means",
              render_only,
              [](Options& o, Text) -> Problem {
                o.adaptive = true;
                return std::nullopt;
              },
              ValueNeed::none},
    OptionRow{"--seed", "N", "seed of all random choices", sampling,
              [](Options& o, Text v) {
                return store_parsed(
                    o.seed, parse_whole_number(v, 0, std::numeric_limits<std::int64_t>::max()));
              }},
    OptionRow{"--method", "NAME", "path, whitted or phong", parametric,
              [](Options& o, Text v) {
                return store_choice<ir::Method>(o.method, v, ir::EnumNames<ir::Method>::names);
              }},
    OptionRow{"--camera", "NAME", "which camera of the scene", rendering,
              [](Options& o, Text v) -> Problem {
                o.camera = std::string(v);
                return std::nullopt;
              }},
    OptionRow{"--region", "x0,y0,x1,y1", "render these pixels only", picturing,
              [](Options& o, Text v) { return store_parsed(o.region, parse_region(v)); }},
    OptionRow{"-D", "NAME=VALUE", "set a parameter of the scene; may be repeated", parametric,
              store_setting, ValueNeed::required, Repeat::many},
    OptionRow{"--params", "FILE", "set parameters from a JSON object; -D wins", parametric,
              [](Options& o, Text v) { return store_path(o.params_file, v); }},
    OptionRow{"--frames", "a..b", "render these frames, setting the `@clock` parameter for each",
              render_only,
              [](Options& o, Text v) { return store_parsed(o.frames, parse_frames(v)); }},
    OptionRow{"--fps", "N", "frames a second of --frames (default 24)", render_only,
              [](Options& o, Text v) {
                return store_parsed(o.frame_rate, parse_whole_number(v, 1, largest_frame_rate));
              }},
    OptionRow{"--dialect", "NAME", "sdl or course; else decided by the file", reading,
              [](Options& o, Text v) {
                constexpr std::array<Text, 2> names{"sdl", "course"};
                return store_choice<grammar::Dialect>(o.dialect, v, names);
              }},
    OptionRow{"--half", "", "16-bit floats in EXR files", picturing,
              [](Options& o, Text) -> Problem {
                o.half = true;
                return std::nullopt;
              },
              ValueNeed::none},
    OptionRow{"--precision", "NAME", "vertices of meshes: mixed (default) or double", sampled,
              [](Options& o, Text v) {
                constexpr std::array<Text, 2> names{"mixed", "double"};
                std::optional<backend::Precision> precision;
                const Problem problem = store_choice<backend::Precision>(precision, v, names);
                o.precision = precision.value_or(o.precision);
                return problem;
              }},
    OptionRow{"--target", "NAME",
              "auto (default), baseline, sse4, avx2 or avx512: the same picture", picturing,
              store_target},
    OptionRow{"--effects", "NAME", "found (default) or all: the same picture, slower", render_only,
              [](Options& o, Text v) {
                constexpr std::array<Text, 2> names{"found", "all"};
                std::optional<SimulatedEffects> effects;
                const Problem problem = store_choice<SimulatedEffects>(effects, v, names);
                o.effects = effects.value_or(o.effects);
                return problem;
              }},
    OptionRow{"--stamp", "", "write date, host, threads and paths into the picture", render_only,
              [](Options& o, Text) -> Problem {
                o.stamp = true;
                return std::nullopt;
              },
              ValueNeed::none},
    OptionRow{"--stage", "NAME", "tree, ast, effects or ir (default)", VerbSet{Verb::dump},
              [](Options& o, Text v) {
                constexpr std::array<Text, 4> names{"tree", "ast", "ir", "effects"};
                return store_choice<DumpStage>(o.stage, v, names);
              }},
    OptionRow{"--root", "DIR", "read files beneath this directory only", rooted, store_root},
    OptionRow{"--strict-links", "", "read no file that has a second name (a hard link)", rooted,
              [](Options& o, Text) -> Problem {
                o.strict_links = true;
                return std::nullopt;
              },
              ValueNeed::none},
#define SCENEC_LIMIT(member, option, value, lowest, highest, unit, what)       \
  OptionRow{option, unit, "limit of " what " (default " #value ")", compiling, \
            [](Options& o, Text v) { return store_limit(o.limits.member, v, lowest, highest); }},
#include "base/limits.def"
#undef SCENEC_LIMIT
    OptionRow{"--cache", "DIR|off", "where decoded meshes are kept (default: the user's cache)",
              caching,
              [](Options& o, Text v) -> Problem {
                if (v.empty()) return "`off` or the name of a directory";
                o.cache = v;
                return std::nullopt;
              }},
    OptionRow{"--cache-limit", "SIZE", "bytes the cache may take (default 2GiB)", caching,
              [](Options& o, Text v) { return store_parsed(o.cache_budget, parse_byte_count(v)); }},
    OptionRow{"--threads", "N", "threads to work with (default: all)", working,
              [](Options& o, Text v) {
                return store_parsed(o.threads, parse_whole_number(v, 1, largest_thread_count));
              }},
    OptionRow{"--checkpoint", "FILE|off",
              "keep the samples here (default: beside the picture until it is done)", render_only,
              [](Options& o, Text v) { return store_path(o.checkpoint, v); }},
    OptionRow{
        "--checkpoint-interval", "TIME", "how often the checkpoint is written (default 1min)",
        render_only,
        [](Options& o, Text v) { return store_parsed(o.checkpoint_interval, parse_duration(v)); }},
    OptionRow{"--resume", "", "go on from the checkpoint", render_only,
              [](Options& o, Text) -> Problem {
                o.resume = true;
                return std::nullopt;
              },
              ValueNeed::none},
    OptionRow{"--tolerance", "E", "exit code 1 if the relative error is above this: 1%",
              VerbSet{Verb::diff},
              [](Options& o, Text v) { return store_parsed(o.tolerance, parse_share(v)); }},
    OptionRow{"--progress", "STYLE", "auto, plain, json or none", sampling,
              [](Options& o, Text v) {
                constexpr std::array<Text, 4> names{"auto", "plain", "json", "none"};
                return store_choice<ProgressStyle>(o.progress, v, names);
              }},
    OptionRow{"--stats", "table|json:FILE", "say where time and rays went", render_only,
              store_stats, ValueNeed::optional},
    OptionRow{"--color", "WHEN", "auto, always or never", colored,
              [](Options& o, Text v) {
                constexpr std::array<Text, 3> names{"auto", "always", "never"};
                return store_choice<ColorChoice>(o.color, v, names);
              }},
    OptionRow{"--diagnostics", "FORM", "text, json (one object a line) or sarif", printing,
              [](Options& o, Text v) {
                constexpr std::array<Text, 3> names{"text", "json", "sarif"};
                return store_choice<DiagnosticsForm>(o.diagnostics, v, names);
              }},
    OptionRow{"--deny", "LINT", "count a lint, or all `warnings`, as errors; may be repeated",
              diagnosing, [](Options& o, Text v) { return o.denials.add(v); }, ValueNeed::required,
              Repeat::many},
    OptionRow{"-MD", "", "write the files that were read as a rule for make or ninja", diagnosing,
              [](Options& o, Text) -> Problem {
                o.dependencies = true;
                return std::nullopt;
              },
              ValueNeed::none},
    OptionRow{"-MF", "FILE", "where -MD writes (default: the output's name with `.d`)", diagnosing,
              [](Options& o, Text v) { return store_path(o.dependency_file, v); }},
    OptionRow{"-MT", "TARGET", "target of -MD's rule (default: the output); may be repeated",
              diagnosing,
              [](Options& o, Text v) { return store_path(o.dependency_targets.emplace_back(), v); },
              ValueNeed::required, Repeat::many},
    OptionRow{"-MP", "", "an empty rule for every file of -MD but the scene", diagnosing,
              [](Options& o, Text) -> Problem {
                o.phony_dependencies = true;
                return std::nullopt;
              },
              ValueNeed::none},
    OptionRow{"--port", "N", "where the page is (default 7727, or any that is free)", watch_only,
              [](Options& o, Text v) {
                return store_parsed(o.port, parse_whole_number(v, 1, largest_port));
              }},
    OptionRow{"--open", "", "open the page in the browser", watch_only,
              [](Options& o, Text) -> Problem {
                o.open_page = true;
                return std::nullopt;
              },
              ValueNeed::none},
    OptionRow{"--display-server", "HOST:PORT", "show tiles in tev or HDRView too", watch_only,
              [](Options& o, Text v) { return store_display_server(o, v); }},
    OptionRow{"--poll", "", "look at the files every second instead of asking the system",
              watch_only,
              [](Options& o, Text) -> Problem {
                o.poll = true;
                return std::nullopt;
              },
              ValueNeed::none},
    OptionRow{"--check", "", "name the files that are not formatted, change none",
              VerbSet{Verb::fmt},
              [](Options& o, Text) -> Problem {
                o.check_layout = true;
                return std::nullopt;
              },
              ValueNeed::none},
    OptionRow{"--diff", "", "show what would change, change nothing", VerbSet{Verb::fmt},
              [](Options& o, Text) -> Problem {
                o.diff = true;
                return std::nullopt;
              },
              ValueNeed::none},
    OptionRow{"--list", "", "one line for every diagnostic", VerbSet{Verb::explain},
              [](Options& o, Text) -> Problem {
                o.list = true;
                return std::nullopt;
              },
              ValueNeed::none},
    OptionRow{
        "--json", "", "as JSON (the default of schema); watch: events, one object a line",
        VerbSet{Verb::schema, Verb::explain, Verb::watch, Verb::diff, Verb::verify, Verb::stress},
        [](Options& o, Text) -> Problem {
          o.markdown = false;
          o.json = true;
          return std::nullopt;
        },
        ValueNeed::none},
    OptionRow{"--markdown", "", "as Markdown tables", VerbSet{Verb::schema},
              [](Options& o, Text) -> Problem {
                o.markdown = true;
                return std::nullopt;
              },
              ValueNeed::none},
};

}  // namespace

std::span<const OptionRow> all_options() {
  return option_table;
}

std::string output_of(const Options& options) {
  if (options.verb != Verb::render || !options.output.empty()) return options.output;
  return std::filesystem::path(options.operands.at(0)).stem().string() + ".png";
}

std::string picture_command(const Options& options) {
  std::string text = "scenec render";
  const auto add = [&](std::string_view name, const std::string& value) {
    text += fmt::format(" {} {}", name, shell_word(value));
  };
  if (options.size) {
    add("--size", fmt::format("{}x{}", options.size->width, options.size->height));
  }
  if (options.samples) add("--samples", std::to_string(*options.samples));
  if (options.error) add("--error", short_number_text(*options.error));
  if (options.time) add("--time", short_number_text(options.time->value) + "s");
  if (options.seed) add("--seed", std::to_string(*options.seed));
  if (options.method) {
    const auto index = static_cast<std::size_t>(*options.method);
    add("--method", std::string(ir::EnumNames<ir::Method>::names[index]));
  }
  if (options.camera) add("--camera", *options.camera);
  if (const auto& region = options.region) {
    add("--region", fmt::format("{},{},{},{}", region->x0, region->y0, region->x1, region->y1));
  }
  std::vector<NameAndValue> settings = options.settings;
  std::sort(settings.begin(), settings.end(),
            [](const NameAndValue& a, const NameAndValue& b) { return a.name < b.name; });
  for (const NameAndValue& setting : settings) add("-D", setting.name + "=" + setting.value);
  if (options.frame) {
    add("--frames", fmt::format("{0}..{0}", *options.frame));
    if (options.frame_rate) add("--fps", std::to_string(*options.frame_rate));
  }
  if (options.dialect) {
    add("--dialect", *options.dialect == grammar::Dialect::sdl ? "sdl" : "course");
  }
  if (options.adaptive) text += " --adaptive";
  if (options.half) text += " --half";
  if (options.precision == backend::Precision::full) text += " --precision double";
  return text;
}

}  // namespace scenec::runtime
