// `scenec stress SCENE`: does the picture hold when the scene is moved far from the origin, made
// large or small, turned, or displaced by an ulp? Each is rendered with the same random numbers and
// must agree with the scene as written within the noise of both (backend/film/agreement.hpp); where
// it does not, the item there is named with its line.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "backend/image/write_image.hpp"
#include "backend/probe.hpp"
#include "backend/render_session.hpp"
#include "base/text.hpp"
#include "ir/similarity.hpp"
#include "runtime/output.hpp"
#include "runtime/ready_scene.hpp"
#include "runtime/session.hpp"
#include "runtime/settings.hpp"
#include "runtime/signals.hpp"
#include "runtime/stress_report.hpp"
#include "runtime/verbs.hpp"

namespace scenec::runtime {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::int64_t usual_samples = 64;
constexpr double false_alarm = 1e-4;  // of a whole run
constexpr std::size_t sides[] = {4, 8, 16, 64};
// Of pixels that count as the same: rounding decided nothing in them.
constexpr double same_share = 1e-3;

struct Variant {
  std::string_view name;
  std::string_view what;
  ir::Similarity by;
  bool jittered = false;
};
constexpr double far = 1e4;
constexpr double turn = 0.6;  // rad; no symmetry of anything
const Variant variants[] = {
    {"moved", "moved by 1e4 m along every axis", {.scale = 1, .turn = {}, .move = {far, far, far}}},
    {"large", "a thousand times as large", {.scale = 1e3, .turn = {}, .move = {}}},
    {"small", "a thousandth as large", {.scale = 1e-3, .turn = {}, .move = {}}},
    {"turned", "turned about the y axis by 0.6 rad", {.scale = 1, .turn = Angle{turn}, .move = {}}},
    {"jittered", "every item displaced by an ulp", {}, true},
};

std::string place_text(const SourceMap& sources, Span span) {
  const Span written = sources.resolve(span);
  if (!written.valid()) return {};
  const Position position = sources.position(written.file, written.begin);
  return fmt::format("{}:{}", sources.path(written.file), position.line);
}

class StressRun {
 public:
  StressRun(const Options& options, const Environment& environment)
      : options_(options),
        environment_(environment),
        signals_(environment.handle_signals ? SignalWatch::Mode::watch : SignalWatch::Mode::ignore),
        session_(options),
        pool_(static_cast<unsigned>(options.threads.value_or(0))) {}

  ExitCode run() {
    if (!options_.output.empty() && !make_folder(options_.output, environment_))
      return ExitCode::file_error;
    ReadyScene ready;
    if (const ExitCode code = make_ready(ready, session_, options_, environment_, pool_);
        code != ExitCode::ok)
      return code;
    ir::RenderSettings& settings = *ready.settings;
    if (!options_.size) settings.size = small_size(settings.size);
    settings.region.reset();
    settings.aovs = {ir::Aov::variance};
    signals_.allow_graceful_stop();
    return compare_all(*ready.scene, settings, *ready.prepared);
  }

 private:
  ExitCode compare_all(const ir::Scene& scene, const ir::RenderSettings& settings,
                       const backend::PreparedScene& prepared) {
    const backend::RenderScenePtr built =
        backend::build(prepared, pool_, {.precision = options_.precision});
    const auto base = render(*built, settings);
    if (!base) return stopped();
    bool all_agree = true;
    Json rows = Json::array();
    for (std::size_t i = 0; i < std::size(variants); ++i) {
      tell(i);
      const auto picture = render_variant(variants[i], settings);
      if (!picture) return stopped();
      StressOutcome outcome = compare(*base, *picture, *built, scene, settings);
      outcome.name = variants[i].name;
      outcome.what = variants[i].what;
      all_agree = all_agree && outcome.agrees;
      if (options_.json)
        rows.push_back(json_of(outcome));
      else
        environment_.out << text_of(outcome);
      if (!options_.output.empty() && !write(variants[i], *base, *picture))
        return ExitCode::file_error;
    }
    if (options_.json) {
      environment_.out << Json{{"agrees", all_agree}, {"variants", rows}}.dump(
                              2, ' ', false, Json::error_handler_t::replace)
                       << '\n';
    }
    return all_agree ? ExitCode::ok : ExitCode::scene_error;
  }

  ExitCode stopped() const { return static_cast<ExitCode>(128 + signals_.signal_received()); }

  void tell(std::size_t variant) const {
    if (options_.progress == ProgressStyle::none) return;
    environment_.err << fmt::format("{} of {}: {}\n", variant + 1, std::size(variants),
                                    variants[variant].what)
                     << std::flush;
  }

  std::optional<backend::NoisyPicture> render(const backend::RenderScene& scene,
                                              const ir::RenderSettings& settings) {
    const ir::EffectSet effects = backend::find_effects(scene, settings).simulated();
    backend::RenderSession session(scene, settings, effects, pool_);
    if (!session.advance(options_.samples.value_or(usual_samples), signals_.stop()))
      return std::nullopt;
    backend::NoisyPicture picture = backend::noisy_picture_of(session.picture());
    // A picture without chance may be off by no sample at all, but for rounding at edges.
    backend::look_at_contrast(picture);
    return picture;
  }

  // Scenes cannot be copied, so each variant is compiled anew and then changed.
  std::optional<backend::NoisyPicture> render_variant(const Variant& variant,
                                                      const ir::RenderSettings& settings) {
    Session again(options_);
    auto scene = again.load_and_compile(pool_);
    if (!scene) return std::nullopt;
    if (variant.jittered)
      ir::jitter(*scene, static_cast<std::uint64_t>(settings.seed) + 1);
    else
      ir::transform(*scene, variant.by);
    const backend::PreparedPtr prepared =
        backend::prepare(*scene, again.files(), pool_, again.sink(), nullptr, options_.limits);
    if (!prepared) return std::nullopt;
    const backend::RenderScenePtr built =
        backend::build(*prepared, pool_, {.precision = options_.precision});
    return render(*built, settings);
  }

  static bool is_same(const backend::NoisyPicture& a, const backend::NoisyPicture& b,
                      std::size_t pixel) {
    for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i) {
      const double x = static_cast<double>(a.rgb[i]);
      const double y = static_cast<double>(b.rgb[i]);
      if (!(std::abs(x - y) <= same_share * std::abs(x))) return false;
    }
    return true;
  }

  StressOutcome compare(const backend::NoisyPicture& base, const backend::NoisyPicture& other,
                        const backend::RenderScene& built, const ir::Scene& scene,
                        const ir::RenderSettings& settings) {
    StressOutcome outcome;
    for (const std::size_t side : sides) join(outcome.agreement, compare_blocks(base, other, side));
    const std::size_t pixels = base.width * base.height;
    std::size_t same = 0;
    for (std::size_t i = 0; i < pixels; ++i) same += is_same(base, other, i) ? 1U : 0U;
    outcome.same = static_cast<double>(same) / static_cast<double>(pixels);
    const double limit = std::log(false_alarm / static_cast<double>(std::size(variants)));
    outcome.agrees = outcome.agreement.log_p >= limit;
    const double limit_of_place = limit - std::log(static_cast<double>(outcome.agreement.tests));
    for (const backend::Disagreement& d : outcome.agreement.worst) {
      if (d.log_p >= limit_of_place) break;
      StressOutcome::Place place = place_of(d, base, other);
      name_item(place, built, scene, settings);
      const bool is_known =
          std::any_of(outcome.places.begin(), outcome.places.end(),
                      [&](const auto& seen) { return seen.x == place.x && seen.y == place.y; });
      if (!is_known) outcome.places.push_back(std::move(place));
    }
    return outcome;
  }

  static StressOutcome::Place place_of(const backend::Disagreement& d,
                                       const backend::NoisyPicture& base,
                                       const backend::NoisyPicture& other) {
    StressOutcome::Place place;
    place.block = d;
    double furthest = -1;
    for (std::int64_t y = d.place.y0; y < d.place.y1; ++y) {
      for (std::int64_t x = d.place.x0; x < d.place.x1; ++x) {
        const std::size_t i =
            3 * (static_cast<std::size_t>(y) * base.width + static_cast<std::size_t>(x)) +
            d.channel;
        const double off =
            std::abs(static_cast<double>(base.rgb[i]) - static_cast<double>(other.rgb[i]));
        if (!(off <= furthest)) {
          furthest = off;
          place.x = x;
          place.y = y;
        }
      }
    }
    return place;
  }

  void name_item(StressOutcome::Place& place, const backend::RenderScene& built,
                 const ir::Scene& scene, const ir::RenderSettings& settings) const {
    const auto hit = backend::probe(built, settings, place.x, place.y);
    if (!hit || hit->path.empty()) return;
    const auto& step = hit->path.back();
    const ir::Item& item =
        step.proto ? scene.protos[*step.proto].items[step.item] : scene.items[step.item];
    if (item.name.valid()) place.name = scene.names[item.name];
    if (item.origin.valid())
      place.line = place_text(session_.sources(), scene.origins[item.origin].span);
  }

  // Changed minus as written, and that over its standard deviation.
  bool write(const Variant& variant, const backend::NoisyPicture& base,
             const backend::NoisyPicture& other) {
    std::vector<float> difference(base.rgb.size());
    std::vector<float> sigma(base.rgb.size() / 3);
    for (std::size_t i = 0; i < difference.size(); ++i) {
      difference[i] = other.rgb[i] - base.rgb[i];
      const float noise = std::sqrt(base.variance[i] + other.variance[i]);
      if (noise > 0) sigma[i / 3] = std::max(sigma[i / 3], std::abs(difference[i]) / noise);
    }
    const std::span<const float> view(difference);
    const std::vector<backend::ExrChannel> channels{{"R", view, 3},
                                                    {"G", view.subspan(1), 3},
                                                    {"B", view.subspan(2), 3},
                                                    {"sigma.Y", sigma, 1}};
    const auto bytes = backend::encode_exr(static_cast<std::uint32_t>(base.width),
                                           static_cast<std::uint32_t>(base.height), channels, {});
    const fs::path path = fs::path(options_.output) / (std::string(variant.name) + ".exr");
    DiagnosticSink sink;
    const bool written = bytes.ok() && write_output(path.string(), bytes.value(), sink);
    for (const Diagnostic& d : sink.sorted()) session_.print_late(d, environment_);
    return written;
  }

  const Options& options_;
  const Environment& environment_;
  SignalWatch signals_;  // before the pool: its threads inherit the blocked signals
  Session session_;
  ThreadPool pool_;
};

}  // namespace

ExitCode verbs::stress(const Options& options, const Environment& environment) {
  return StressRun(options, environment).run();
}

}  // namespace scenec::runtime
