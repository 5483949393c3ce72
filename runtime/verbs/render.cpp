// `scenec render`: compile, prepare, build, render, write. Whatever can be refused is refused
// before the first ray; a stop request writes what there is.
#include <fmt/format.h>

#include <chrono>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "backend/backend.hpp"
#include "backend/stop_rule.hpp"
#include "base/parallel.hpp"
#include "base/text.hpp"
#include "runtime/cache.hpp"
#include "runtime/checkpoint.hpp"
#include "runtime/cli.hpp"
#include "runtime/output.hpp"
#include "runtime/picture_metadata.hpp"
#include "runtime/progress.hpp"
#include "runtime/session.hpp"
#include "runtime/settings.hpp"
#include "runtime/signals.hpp"
#include "runtime/stats.hpp"
#include "runtime/stats_sources.hpp"
#include "runtime/verbs.hpp"

namespace scenec::runtime {

namespace {

// Where a program reads the diagnostics, no other lines are mixed in unless asked for.
ProgressStyle progress_style_of(const Options& options) {
  const bool for_people = options.diagnostics == DiagnosticsForm::text;
  const bool is_default = options.progress == ProgressStyle::automatic;
  return is_default && !for_people ? ProgressStyle::none : options.progress;
}

// What the runs of one `--frames` share.
struct Sequence {
  std::vector<std::string> unguarded;  // outputs that have not been compared with the inputs
  std::set<std::string> told;          // lints that have been printed
  std::optional<SharedDependencies> dependencies;
};

class RenderRun {
 public:
  RenderRun(const Options& options, const Environment& environment, Sequence& sequence)
      : options_(options),
        environment_(environment),
        signals_(environment.handle_signals ? SignalWatch::Mode::watch : SignalWatch::Mode::ignore),
        sequence_(sequence),
        session_(options),
        output_(output_of(options)),
        is_one_document_(options.diagnostics == DiagnosticsForm::sarif),
        progress_(progress_style_of(options)),
        clock_(stats_),
        pool_(static_cast<unsigned>(options.threads.value_or(0))) {
    if (auto kept = cache_options_of(options, environment)) cache_.emplace(std::move(*kept));
    session_.leave_out(sequence.told);
    if (sequence.dependencies) session_.share_dependencies(*sequence.dependencies);
  }

  ExitCode run() {
    const auto format = check_picture_output(output_, session_.sink());
    const bool stats_fit =
        options_.stats_file.empty() || check_output(options_.stats_file, session_.sink());
    const bool others_fit = check_outputs(options_, session_.sink());
    if (!format || !stats_fit || !others_fit) return refuse_output();
    const std::uint64_t before = tells_stats() ? allocated_bytes() : 0;
    const auto scene = session_.load_and_compile(pool_);
    finish_compiling(session_, before, clock_, stats_);
    if (!scene) return session_.finish(environment_);
    const auto settings = settings_of(options_, *scene, environment_);
    if (!settings) return ExitCode::usage;
    const backend::PreparedPtr prepared = backend::prepare(
        *scene, session_.files(), pool_, session_.sink(), cache(), options_.limits);
    clock_.finish("prepare");
    if (!prepared) return session_.finish(environment_);
    if (!outputs_are_no_inputs()) return refuse_output();
    if (session_.has_errors()) return session_.finish(environment_);
    if (is_one_document_) return render_then_finish(*scene, *settings, *prepared, *format);
    // Lints before the long wait.
    if (const ExitCode code = session_.finish(environment_); code != ExitCode::ok) return code;
    return render(*scene, *settings, *prepared, *format);
  }

 private:
  ContentCache* cache() { return cache_ ? &*cache_ : nullptr; }

  // The outputs of later frames count from the first frame on.
  bool outputs_are_no_inputs() {
    bool sound = check_output_is_no_input(output_, session_);
    for (const std::string& output : std::exchange(sequence_.unguarded, {}))
      sound = check_output_is_no_input(output, session_) && sound;
    return sound;
  }

  ExitCode refuse_output() {
    static_cast<void>(session_.finish(environment_));
    return ExitCode::file_error;
  }

  // A SARIF log is one document: it is printed when there is nothing left to go wrong.
  ExitCode render_then_finish(const ir::Scene& scene, const ir::RenderSettings& settings,
                              const backend::PreparedScene& prepared, backend::ImageFormat format) {
    const ExitCode code = render(scene, settings, prepared, format);
    const ExitCode finished = session_.finish(environment_);
    return code == ExitCode::ok ? finished : code;
  }

  ExitCode render(const ir::Scene& scene, const ir::RenderSettings& settings,
                  const backend::PreparedScene& prepared, backend::ImageFormat format) {
    const backend::RenderScenePtr built =
        backend::build(prepared, pool_,
                       {.cache = cache(),
                        .precision = options_.precision,
                        .target = options_.target.value_or(backend::best_target())});
    clock_.finish("build");
    ir::EffectSet effects = backend::find_effects(*built, settings).simulated();
    if (options_.effects == SimulatedEffects::all) effects = ir::EffectSet::all();
    stats_.kernel = backend::kernel_for(settings.method, effects).name;
    backend::RenderSession session(
        *built, settings, effects, pool_, backend::KernelChoice::smallest, nullptr,
        options_.adaptive ? backend::SampleSpread::adaptive : backend::SampleSpread::even);
    backend::StopState state;
    const bool keeps = !checkpoint_path_of(options_).empty();
    CheckpointKeeper keeper(
        options_, keeps ? identity_of(scene, settings, effects, options_) : RenderIdentity{});
    if (!take_up(session, settings, keeper, state)) return ExitCode::file_error;
    signals_.allow_graceful_stop();
    ProgressPrinter progress(progress_, environment_);
    const backend::RenderHooks hooks{[&](const backend::Progress& done) { progress.update(done); },
                                     [&] { keeper.save_now_and_then(session, state); }};
    const backend::StopReason reason =
        backend::render_to_end(session, settings, signals_.stop(), hooks, state);
    progress.finish();
    const bool complete = reason != backend::StopReason::request;
    if (!complete) keeper.save(session, state);
    backend::Picture picture = session.picture();
    picture.complete = complete;
    stats_.error = session.error();
    clock_.finish("render");
    if (tells_stats() && complete) {
      stats_.profile = backend::profile_of(*built, settings, effects, pool_, session.samples());
      clock_.finish("profile");
    }
    add_memory(backend::memory_use_of(prepared, *built), session.memory(), keeper.memory(), stats_);
    const ExitCode code = write(scene, settings, effects, picture, format);
    if (code == ExitCode::ok && complete) keeper.finish(session, state);
    return told_of(keeper) ? ExitCode::file_error : code;
  }

  [[nodiscard]] bool tells_stats() const { return options_.stats != StatsForm::none; }

  // Goes on from the checkpoint when that is asked for; false: it cannot (said).
  bool take_up(backend::RenderSession& session, const ir::RenderSettings& settings,
               CheckpointKeeper& keeper, backend::StopState& state) {
    if (!options_.resume) return true;
    std::optional<std::string> problem = keeper.restore(session, state);
    const std::int64_t cap = backend::sample_cap_of(settings);
    if (!problem && session.samples() > cap)
      problem = fmt::format("has {} samples a pixel; {} are asked for", session.samples(), cap);
    if (!problem) return true;
    environment_.err << fmt::format("scenec: the checkpoint `{}` cannot be taken up: {}\n",
                                    printable(keeper.path()), *problem);
    return false;
  }

  bool told_of(const CheckpointKeeper& keeper) {
    if (!keeper.problem()) return false;
    environment_.err << fmt::format("scenec: the checkpoint `{}` could not be written: {}\n",
                                    printable(keeper.path()), *keeper.problem());
    return true;
  }

  ExitCode write(const ir::Scene& scene, const ir::RenderSettings& settings,
                 const ir::EffectSet& effects, const backend::Picture& picture,
                 backend::ImageFormat format) {
    if (picture.samples == 0) {
      environment_.err << "scenec: stopped before the first sample; nothing written\n";
      return exit_code();
    }
    Options told = options_;
    told.settings = session_.settings();  // those of the file of parameters too
    const std::string bytes = backend::encode(
        picture, settings, format,
        encode_options(told, scene, settings, effects, picture, pool_.size(), stats_.error));
    if (const auto problem = write_file(output_, bytes)) return *problem;
    clock_.finish("write");
    if (progress_ != ProgressStyle::none && progress_ != ProgressStyle::json) {
      environment_.err << fmt::format(
          "{}: {}x{}, {} sample{} a pixel, {}{}{}\n", printable(output_), picture.width,
          picture.height, picture.samples, picture.samples == 1 ? "" : "s",
          stats_.error.known ? "error " + error_text(stats_.error.relative) + ", " : "",
          duration_text(stats_.seconds_of("render")), picture.complete ? "" : early_end());
    }
    if (const auto problem = write_stats(picture)) return *problem;
    return exit_code();
  }

  [[nodiscard]] std::string_view early_end() const {
    return checkpoint_path_of(options_).empty() ? ", stopped early"
                                                : ", stopped early; `--resume` goes on from here";
  }

  // What was found before has been printed; a failure to write is all that is left to say.
  std::optional<ExitCode> write_file(const std::string& path, std::string_view bytes) {
    DiagnosticSink sink;
    if (write_output(path, bytes, sink)) return std::nullopt;
    for (const Diagnostic& diagnostic : sink.sorted()) {
      if (is_one_document_) {
        session_.sink().report(diagnostic);
      } else {
        session_.print_late(diagnostic, environment_);
      }
    }
    return ExitCode::file_error;
  }

  std::optional<ExitCode> write_stats(const backend::Picture& picture) {
    add_picture(picture, stats_);
    if (cache_) stats_.cache = cache_->counts();
    if (options_.stats == StatsForm::table) environment_.err << stats_table(stats_);
    if (options_.stats != StatsForm::json) return std::nullopt;
    return write_file(options_.stats_file, stats_json(stats_));
  }

  [[nodiscard]] ExitCode exit_code() const {
    const int signal = signals_.signal_received();
    return signal == 0 ? ExitCode::ok : static_cast<ExitCode>(128 + signal);
  }

  const Options& options_;
  const Environment& environment_;
  SignalWatch signals_;  // before the pool: its threads inherit the blocked signals
  Sequence& sequence_;
  Session session_;
  std::string output_;
  bool is_one_document_;
  ProgressStyle progress_;
  RunStats stats_;
  PhaseClock clock_;
  ThreadPool pool_;
  std::optional<ContentCache> cache_;
};

// Whether the files of all frames can be written (else reported and printed).
bool frames_are_writable(const Options& options, Sequence& sequence,
                         const Environment& environment) {
  Session session(options);
  for (std::int64_t frame = options.frames->first; frame <= options.frames->last; ++frame) {
    const Options one = options_in_frame(options, frame);
    static_cast<void>(check_picture_output(one.output, session.sink()));
    if (!one.stats_file.empty()) check_output(one.stats_file, session.sink());
    check_outputs(one, session.sink());
    sequence.unguarded.push_back(one.output);
  }
  if (!session.sink().has_errors()) return true;
  static_cast<void>(session.finish(environment));
  return false;
}

}  // namespace

ExitCode verbs::render(const Options& options, const Environment& environment) {
  Sequence sequence;
  if (!options.frames) return RenderRun(options, environment, sequence).run();
  if (!frames_are_writable(options, sequence, environment)) return ExitCode::file_error;
  if (share_dependencies(options)) {
    const bool are_named = !options.dependency_targets.empty();
    sequence.dependencies.emplace();
    sequence.dependencies->targets = are_named ? options.dependency_targets : sequence.unguarded;
  }
  for (std::int64_t frame = options.frames->first; frame <= options.frames->last; ++frame) {
    const Options one = options_in_frame(options, frame);
    const ExitCode code = RenderRun(one, environment, sequence).run();
    if (code != ExitCode::ok) return code;
  }
  return ExitCode::ok;
}

}  // namespace scenec::runtime
