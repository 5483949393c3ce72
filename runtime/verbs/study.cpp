// `scenec study SCENE -o DIR`: what accuracy costs in time, measured on the author's own scene.
// report.html is for people, report.json and curves.csv for programs. A study that was interrupted
// goes on where it was when it is started again with the same scene and options.
#include <fmt/format.h>
#include <sys/utsname.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <thread>

#include "base/text.hpp"
#include "runtime/checkpoint.hpp"
#include "runtime/cli.hpp"
#include "runtime/output.hpp"
#include "runtime/progress.hpp"
#include "runtime/ready_scene.hpp"
#include "runtime/session.hpp"
#include "runtime/settings.hpp"
#include "runtime/signals.hpp"
#include "runtime/study/study.hpp"
#include "runtime/verbs.hpp"

namespace scenec::runtime {

namespace {

namespace fs = std::filesystem;

constexpr double usual_seconds = 60;

std::string machine_text() {
  utsname name{};
  return ::uname(&name) == 0
             ? fmt::format("{}, {} cores", name.machine, std::thread::hardware_concurrency())
             : "unknown";
}

// What was measured before of the same scene and settings.
Json earlier_study(const fs::path& file, const Json& identity) {
  std::ifstream stream(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  Json document = Json::parse(text, nullptr, false);
  const bool fits =
      document.is_object() && document.contains("identity") && document["identity"] == identity;
  return fits ? document : Json{{"identity", identity}};
}

class StudyRun {
 public:
  StudyRun(const Options& options, const Environment& environment)
      : options_(options),
        environment_(environment),
        signals_(environment.handle_signals ? SignalWatch::Mode::watch : SignalWatch::Mode::ignore),
        session_(options),
        pool_(static_cast<unsigned>(options.threads.value_or(0))),
        directory_(options.output.empty()
                       ? fs::path(options.operands.at(0)).stem().string() + "-study"
                       : options.output) {}

  ExitCode run() {
    if (!make_folder(directory_.string(), environment_)) return ExitCode::file_error;
    ReadyScene ready;
    if (const ExitCode code = make_ready(ready, session_, options_, environment_, pool_);
        code != ExitCode::ok)
      return code;
    ir::RenderSettings& settings = *ready.settings;
    if (!options_.size) settings.size = small_size(settings.size);
    if (!options_.region) settings.region.reset();
    settings.stop = {};
    return measure(*ready.scene, settings, *ready.prepared);
  }

 private:
  ExitCode measure(const ir::Scene& scene, const ir::RenderSettings& settings,
                   const backend::PreparedScene& prepared) {
    Json identity = Json::object();
    for (const auto& [name, value] : identity_of(scene, settings, {}, options_))
      identity[name] = value;
    Json document = earlier_study(directory_ / "report.json", identity);
    document["scene"] = fs::path(options_.operands.at(0)).filename().string();
    document["version"] = version_text;
    document["machine"] = machine_text();
    document["method"] =
        ir::EnumNames<ir::Method>::names[static_cast<std::size_t>(settings.method)];
    signals_.allow_graceful_stop();
    bool written = true;
    const auto compile_again = [&](const std::function<void(ir::Scene&, FileSystem&)>& use) {
      Session again(options_);
      auto copy = again.load_and_compile(pool_);
      if (copy) use(*copy, again.files());
    };
    StudyPlan plan{scene,         prepared,
                   settings,      options_.operands.at(0),
                   compile_again, options_.time ? options_.time->value : usual_seconds};
    plan.stop = signals_.stop();
    plan.progress = [&](double part, const std::string& what) { tell(part, what); };
    plan.save = [&](const Json& so_far) { written = write(so_far) && written; };
    measure_study(plan, pool_, document);
    written = write(document) && written;
    if (!written) return ExitCode::file_error;
    if (const int signal = signals_.signal_received(); signal != 0)
      return static_cast<ExitCode>(128 + signal);
    if (options_.progress != ProgressStyle::none)
      environment_.err << fmt::format("{}\n", printable((directory_ / "report.html").string()));
    return ExitCode::ok;
  }

  void tell(double part, const std::string& what) {
    if (options_.progress == ProgressStyle::none || what == told_) return;
    told_ = what;
    const double seconds = options_.time ? options_.time->value : usual_seconds;
    environment_.err << fmt::format("{:3.0f} %  {}, {} left\n", 100 * part, what,
                                    duration_text((1 - part) * seconds))
                     << std::flush;
  }

  bool write(const Json& document) {
    DiagnosticSink sink;
    const bool written =
        write_output((directory_ / "report.json").string(), document.dump(1) + "\n", sink) &&
        write_output((directory_ / "curves.csv").string(), study_curves(document), sink) &&
        write_output((directory_ / "report.html").string(), study_page(document), sink);
    for (const Diagnostic& d : sink.sorted()) session_.print_late(d, environment_);
    return written;
  }

  const Options& options_;
  const Environment& environment_;
  SignalWatch signals_;  // before the pool: its threads inherit the blocked signals
  Session session_;
  ThreadPool pool_;
  fs::path directory_;
  std::string told_;
};

}  // namespace

ExitCode verbs::study(const Options& options, const Environment& environment) {
  return StudyRun(options, environment).run();
}

}  // namespace scenec::runtime
