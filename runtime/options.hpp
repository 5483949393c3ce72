// What a command line asks for, as plain values; and the table every option stands in once: from it
// come parsing, help and the complaint about an option that a verb does not take.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "backend/accel/precision.hpp"
#include "backend/accel/target.hpp"
#include "base/limits.hpp"
#include "base/units.hpp"
#include "grammar/parse.hpp"
#include "ir/render_settings.hpp"
#include "runtime/denials.hpp"
#include "runtime/environment.hpp"
#include "runtime/frames.hpp"
#include "runtime/option_values.hpp"
#include "runtime/verbs.hpp"

namespace scenec::runtime {

enum class ProgressStyle : std::uint8_t { automatic, plain, json, none };
enum class DumpStage : std::uint8_t { tree, ast, ir, effects };
enum class DiagnosticsForm : std::uint8_t { text, json, sarif };
enum class StatsForm : std::uint8_t { none, table, json };

// What a picture is simulated with: all is for pricing what the analysis saves.
enum class SimulatedEffects : std::uint8_t { found, all };

struct Options {
  Verb verb = Verb::render;
  std::vector<std::string> operands;
  std::string output;  // empty: the verb's default

  // What changes the picture.
  std::optional<ir::ImageSize> size;
  std::optional<std::int64_t> samples;
  std::optional<double> error;
  std::optional<Time> time;
  std::optional<std::int64_t> seed;
  std::optional<ir::Method> method;
  std::optional<std::string> camera;
  std::optional<ir::Region> region;
  std::vector<NameAndValue> settings;  // -D
  std::string params_file;             // --params
  std::optional<FrameRange> frames;
  std::optional<std::int64_t> frame_rate;  // --fps
  std::optional<std::int64_t> frame;       // the one of `frames` that is being made
  std::optional<grammar::Dialect> dialect;
  bool half = false;
  SimulatedEffects effects = SimulatedEffects::found;
  backend::Precision precision = backend::Precision::mixed;
  bool adaptive = false;

  // What does not.
  std::optional<backend::Target> target;  // the best of this machine
  std::string root;                       // empty: where the scene lies (runtime/root.hpp)
  bool strict_links = false;
  Limits limits;
  std::string cache;  // `off` or a directory; empty: runtime/cache.hpp decides
  std::optional<std::uint64_t> cache_budget;
  std::optional<std::int64_t> threads;
  bool stamp = false;
  ColorChoice color = ColorChoice::automatic;
  DiagnosticsForm diagnostics = DiagnosticsForm::text;
  Denials denials;
  bool dependencies = false;                    // -MD
  std::string dependency_file;                  // -MF; empty: named after the output
  std::vector<std::string> dependency_targets;  // -MT; empty: the output
  bool phony_dependencies = false;              // -MP
  std::string checkpoint;  // `off` or a file; empty: beside the output while it is made
  std::optional<Time> checkpoint_interval;
  bool resume = false;
  std::optional<double> tolerance;  // diff
  ProgressStyle progress = ProgressStyle::automatic;
  StatsForm stats = StatsForm::none;
  std::string stats_file;  // of StatsForm::json
  DumpStage stage = DumpStage::ir;
  std::optional<std::int64_t> port;  // watch
  bool open_page = false;
  bool poll = false;
  struct HostAndPort {
    std::string host;
    int port = 0;
  };
  std::optional<HostAndPort> display_server;
  bool check_layout = false;  // fmt: name the files that would change, change none
  bool diff = false;
  bool list = false;
  bool markdown = false;
  bool json = false;  // explain, watch
};

class VerbSet {
 public:
  constexpr VerbSet(std::initializer_list<Verb> verbs) {
    for (const Verb verb : verbs) bits_ |= bit(verb);
  }
  [[nodiscard]] constexpr bool contains(Verb verb) const { return (bits_ & bit(verb)) != 0; }

 private:
  static constexpr unsigned bit(Verb verb) { return 1u << static_cast<unsigned>(verb); }
  unsigned bits_ = 0;
};

enum class ValueNeed : std::uint8_t {
  required,
  optional,  // only as `--name=VALUE`
  none,
};
enum class Repeat : std::uint8_t { once, many };

struct OptionRow {
  std::string_view names;  // "-o,--output"
  std::string_view value;  // how help names the value
  std::string_view help;
  VerbSet verbs;
  // Stores the value; returns what the value would have had to be.
  std::optional<std::string> (*store)(Options& options, std::string_view value);
  ValueNeed need = ValueNeed::required;
  Repeat repeat = Repeat::once;
};
[[nodiscard]] std::span<const OptionRow> all_options();

// The file the verb writes; empty: standard output, or nothing is written.
[[nodiscard]] std::string output_of(const Options& options);

// The options that change the picture in a fixed order and form: the same picture has the same
// command, whatever was typed.
[[nodiscard]] std::string picture_command(const Options& options);

}  // namespace scenec::runtime
