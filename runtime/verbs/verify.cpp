// `scenec verify FILE [SCENE]`: is an EXR file the picture its fields say it is? Fields that
// contradict the scene are named; otherwise the scene is rendered again with other random numbers
// and what differs must be explained by noise (backend/verification.hpp).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "backend/verification.hpp"
#include "base/file_system.hpp"
#include "base/hash.hpp"
#include "base/text.hpp"
#include "runtime/cache.hpp"
#include "runtime/claim.hpp"
#include "runtime/cli.hpp"
#include "runtime/picture_metadata.hpp"
#include "runtime/progress.hpp"
#include "runtime/session.hpp"
#include "runtime/settings.hpp"
#include "runtime/signals.hpp"
#include "runtime/verbs.hpp"

namespace scenec::runtime {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t places_told = 5;
constexpr std::string_view channel_names[] = {"red", "green", "blue"};

// Small probabilities are told by their exponent: they are far below the smallest double.
std::string p_text(double log_p) {
  if (std::isinf(log_p)) return "0";
  if (log_p > -600) return fmt::format("{:.2g}", std::exp(log_p));
  return fmt::format("1e{:.0f}", log_p / std::log(10.0));
}

// Where and by how much, the worst first, each pixel told once.
std::vector<std::pair<const backend::Question*, backend::Disagreement>> worst_places(
    const backend::Verification& v) {
  std::vector<std::pair<const backend::Question*, backend::Disagreement>> all;
  for (const backend::Question& q : v.questions) {
    if (!q.refuses()) continue;
    const double limit = std::log(backend::false_alarm) - std::log(static_cast<double>(q.tests));
    // Many places together may say what none says alone.
    for (const backend::Disagreement& d : q.worst)
      if (&d == q.worst.data() || d.log_p < limit) all.emplace_back(&q, d);
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.second.log_p < b.second.log_p; });
  std::vector<std::pair<const backend::Question*, backend::Disagreement>> told;
  for (const auto& one : all) {
    const ir::Region& r = one.second.place;
    const bool overlaps = std::any_of(told.begin(), told.end(), [&](const auto& other) {
      const ir::Region& o = other.second.place;
      return r.x0 < o.x1 && o.x0 < r.x1 && r.y0 < o.y1 && o.y0 < r.y1;
    });
    if (!overlaps && told.size() < places_told) told.push_back(one);
  }
  return told;
}

std::string table_of(const backend::Verification& v, std::uint64_t seed) {
  std::string text =
      fmt::format("{}: p = {}; an honest picture is refused once in {:.0f}\n",
                  v.accepted() ? "accepted" : "refused", p_text(v.log_p), 1 / backend::false_alarm);
  text += fmt::format(
      "rendered again: the frame with {} samples a pixel; {} tiles, {:.0f} % of it, with {}; "
      "seed {}\n",
      v.frame_samples, v.tiles, 100 * v.tile_area, v.tile_samples, seed);
  for (const backend::Question& q : v.questions) {
    text += fmt::format("  {:<18}{:>8} test{} p {:<10}{}\n", q.name, q.tests,
                        q.tests == 1 ? " " : "s", p_text(q.log_p), q.refuses() ? q.says : "");
  }
  for (const auto& [question, d] : worst_places(v)) {
    text +=
        fmt::format("worst: {},{} to {},{} {}: {:.4g} in the file, {:.4g} again, {:.1f} sigma\n",
                    d.place.x0, d.place.y0, d.place.x1, d.place.y1, channel_names[d.channel],
                    d.first, d.second, d.deviations);
  }
  return text;
}

std::string json_of(const backend::Verification& v, std::uint64_t seed) {
  // JSON has no infinity.
  const auto finite = [](double value) { return std::max(value, -1e300); };
  Json json{{"accepted", v.accepted()},
            {"log_p", finite(v.log_p)},
            {"false_alarm", backend::false_alarm},
            {"seed", seed},
            {"frame_samples", v.frame_samples},
            {"tile_samples", v.tile_samples},
            {"tiles", v.tiles},
            {"tile_area", v.tile_area}};
  json["questions"] = Json::array();
  for (const backend::Question& q : v.questions)
    json["questions"].push_back({{"name", q.name}, {"tests", q.tests}, {"log_p", finite(q.log_p)}});
  json["worst"] = Json::array();
  for (const auto& [question, d] : worst_places(v)) {
    json["worst"].push_back({{"question", question->name},
                             {"region", {d.place.x0, d.place.y0, d.place.x1, d.place.y1}},
                             {"channel", channel_names[d.channel]},
                             {"file", d.first},
                             {"again", d.second},
                             {"sigma", std::min(d.deviations, 1e300)}});
  }
  return json.dump(2) + "\n";
}

class VerifyRun {
 public:
  VerifyRun(const Options& options, const Environment& environment)
      : options_(options),
        environment_(environment),
        signals_(environment.handle_signals ? SignalWatch::Mode::watch : SignalWatch::Mode::ignore),
        pool_(static_cast<unsigned>(options.threads.value_or(0))) {
    if (auto kept = cache_options_of(options, environment)) cache_.emplace(std::move(*kept));
  }

  ExitCode run() {
    const std::string& path = options_.operands.at(0);
    RealFileSystem disk;
    const auto content = disk.read(path, backend::ImageLimits(options_.limits).file_bytes);
    if (!content.ok()) return complain(path, std::string(text_of(content.error())));
    seed_ = options_.seed ? static_cast<std::uint64_t>(*options_.seed)
                          : hash_bytes(content.value().bytes).low;
    auto claim = read_claim(content.value().bytes);
    if (!claim.ok()) return complain(path, claim.error());
    if (claim.value().software != version_text)
      return contradict("build", claim.value().software, std::string(version_text));
    return compile(claim.value());
  }

 private:
  ExitCode complain(const std::string& path, const std::string& problem) {
    environment_.err << fmt::format("scenec: `{}`: {}\n", printable(path), problem);
    return ExitCode::file_error;
  }
  ExitCode contradict(std::string_view field, const std::string& file, const std::string& here) {
    if (options_.json) {
      environment_.out
          << Json{{"accepted", false}, {"field", field}, {"file", file}, {"here", here}}.dump(2)
          << '\n';
    }
    environment_.err << fmt::format("scenec: refused: its `{}` is `{}`; here it is `{}`\n", field,
                                    printable(file), printable(here));
    return ExitCode::scene_error;
  }

  ExitCode compile(const Claim& claim) {
    Options render = claim.options;
    const std::string scene_path =
        options_.operands.size() > 1 ? options_.operands[1] : claim.scene;
    if (scene_path.empty()) {
      environment_.err << "scenec: the picture does not name its scene, as one made with `--stamp` "
                          "does; name it behind the file\n";
      return ExitCode::usage;
    }
    render.operands = {scene_path};
    render.root = options_.root;
    render.strict_links = options_.strict_links;
    render.limits = options_.limits;
    render.color = options_.color;
    render.diagnostics = options_.diagnostics;
    Session session(render);
    const auto scene = session.load_and_compile(pool_);
    if (!scene) return session.finish(environment_);
    if (scene->hash.hex() != claim.scene_hash)
      return contradict("scene_hash", claim.scene_hash, scene->hash.hex());
    const auto settings = settings_of(render, *scene, environment_);
    if (!settings) return ExitCode::usage;
    const backend::PreparedPtr prepared =
        backend::prepare(*scene, session.files(), pool_, session.sink(),
                         cache_ ? &*cache_ : nullptr, options_.limits);
    if (!prepared) return session.finish(environment_);
    if (const ExitCode code = session.finish(environment_); code != ExitCode::ok) return code;
    return compare(claim, render, *settings, *prepared);
  }

  ExitCode compare(const Claim& claim, const Options& render, const ir::RenderSettings& settings,
                   const backend::PreparedScene& prepared) {
    const ir::Region region =
        settings.region.value_or(ir::Region{0, 0, settings.size.width, settings.size.height});
    const auto size_text = [](std::int64_t width, std::int64_t height) {
      return fmt::format("{}x{}", width, height);
    };
    const std::string size = size_text(region.x1 - region.x0, region.y1 - region.y0);
    const auto& picture = claim.picture.picture;
    const std::string file_size = size_text(static_cast<std::int64_t>(picture.width),
                                            static_cast<std::int64_t>(picture.height));
    if (size != file_size) return contradict("size", file_size, size);
    if (settings.seed != claim.seed)
      return contradict("seed", std::to_string(claim.seed), std::to_string(settings.seed));
    const backend::RenderScenePtr built = backend::build(
        prepared, pool_, {.cache = cache_ ? &*cache_ : nullptr, .precision = render.precision});
    const ir::EffectSet effects = backend::find_effects(*built, settings).simulated();
    if (names_of(effects) != claim.effects)
      return contradict("effects", claim.effects, names_of(effects));
    signals_.allow_graceful_stop();
    ProgressPrinter printer(options_.progress, environment_);
    backend::VerifyOptions how{.seed = seed_, .progress = {}};
    how.progress = [&](double part) {
      backend::Progress progress;
      progress.fraction = part;
      printer.update(progress);
    };
    const auto result = backend::verify_picture(*built, settings, effects, claim.picture, pool_,
                                                how, signals_.stop());
    printer.finish();
    if (!result) return static_cast<ExitCode>(128 + signals_.signal_received());
    environment_.out << (options_.json ? json_of(*result, seed_) : table_of(*result, seed_));
    return result->accepted() ? ExitCode::ok : ExitCode::scene_error;
  }

  const Options& options_;
  const Environment& environment_;
  SignalWatch signals_;  // before the pool: its threads inherit the blocked signals
  ThreadPool pool_;
  std::optional<ContentCache> cache_;
  std::uint64_t seed_ = 0;
};

}  // namespace

ExitCode verbs::verify(const Options& options, const Environment& environment) {
  return VerifyRun(options, environment).run();
}

}  // namespace scenec::runtime
