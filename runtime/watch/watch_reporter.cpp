#include "runtime/watch/watch_reporter.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/atomic_file.hpp"
#include "base/render_diagnostic.hpp"
#include "base/text.hpp"
#include "runtime/diagnostic_formats.hpp"
#include "runtime/picture_metadata.hpp"
#include "runtime/watch/state_json.hpp"

namespace scenec::runtime {

namespace {

using Json = nlohmann::json;

}  // namespace

void WatchReporter::begin(const std::string& address) {
  const std::lock_guard lock(mutex_);
  environment_.err << "scenec: watching; the pictures are at\n  " << address << std::endl;
  if (options_.json) environment_.out << Json{{"event", "watching"}, {"url", address}} << std::endl;
}

void WatchReporter::end() {
  const std::lock_guard lock(mutex_);
  clear_status();
}

void WatchReporter::clear_status() {
  if (!status_shown_) return;
  environment_.err << "\r\x1b[K";
  status_shown_ = false;
}

void WatchReporter::write_line(const std::string& text) {
  const std::lock_guard lock(mutex_);
  clear_status();
  environment_.err << text << std::endl;
}

void WatchReporter::attempted(const WatchedScene& scene) {
  if (options_.json) {
    print_event(scene, "made");
    return;
  }
  const Attempt& attempt = *scene.latest();
  std::string text;
  const RenderOptions form{.color = use_color(options_.color, environment_)};
  for (const Finding& finding : attempt.findings) {
    RenderOptions one = form;
    one.severity = finding.severity;
    text += render_terminal(finding.diagnostic, attempt.sources(), one);
    if (!text.ends_with('\n')) text += '\n';
  }
  text += attempt.problem;
  while (text.ends_with('\n')) text.pop_back();
  if (!text.empty()) write_line(text);
}

void WatchReporter::pictured(const WatchedScene& scene,
                             const std::shared_ptr<const backend::Picture>& picture) {
  if (options_.json) {
    print_event(scene, scene.finished() ? "finished" : "picture");
  } else {
    print_status(scene);
  }
  if (viewer_) viewer_->show(scene.path(), picture, scene.frame_info());
  const FrameInfo info = scene.frame_info();
  if (options_.output.empty() || info.step > 1 || scene.is_stale()) return;
  if (info.generation == written_ && !scene.finished()) return;
  written_ = info.generation;
  write_output(scene, picture);
}

// The first whole picture after a change, and the one at which the stop rule holds.
void WatchReporter::write_output(const WatchedScene& scene,
                                 std::shared_ptr<const backend::Picture> picture) {
  jobs_.put(
      [this, picture = std::move(picture), attempt = scene.shown(), settings = *scene.settings(),
       effects = scene.effects().simulated()] {
        const backend::EncodeOptions encode = encode_options(
            attempt->reading->options, attempt->scene(), settings, effects, *picture, 0);
        const std::string bytes =
            backend::encode(*picture, settings, *backend::image_format_of(options_.output), encode);
        const auto problem = write_file_atomically(options_.output, bytes);
        if (problem)
          write_line(fmt::format("scenec: `{}`: {}", printable(options_.output), *problem));
      },
      "output");
}

void WatchReporter::print_status(const WatchedScene& scene) {
  const WatchTimes& times = scene.times();
  std::string line = fmt::format("{}: first picture {:.0f} ms", printable(scene.path()),
                                 times.first_picture.value_or(0));
  if (times.finished) {
    line +=
        fmt::format(", {} samples a pixel after {:.1f} s", scene.samples(), *times.finished / 1000);
  } else {
    line += fmt::format(", {} samples a pixel", scene.samples());
  }
  const std::lock_guard lock(mutex_);
  if (environment_.err_is_terminal) {
    environment_.err << "\r\x1b[K" << line << std::flush;
    status_shown_ = true;
  } else if (times.finished) {
    environment_.err << line << std::endl;
  }
}

// Version 1; keys may be added.
void WatchReporter::print_event(const WatchedScene& scene, std::string_view event) {
  Json json{{"event", event}, {"scene", scene.path()}, {"ms_after_change", scene.times().made}};
  if (event == "made") {
    const Attempt& attempt = *scene.latest();
    json["failed"] = attempt.failed();
    json["change"] = scene.change();
    json["findings"] = Json::array();
    for (const Finding& finding : attempt.findings)
      json["findings"].push_back(Json::parse(json_line(finding, attempt.sources())));
    if (!attempt.problem.empty()) json["problem"] = attempt.problem;
  } else {
    const FrameInfo info = scene.frame_info();
    json["generation"] = info.generation;
    json["step"] = info.step;
    json["samples"] = scene.samples();
    json["changes"] = changes_json(scene.changes());
    const auto& finished = scene.times().finished;
    json["ms_after_change"] =
        event == "finished" && finished ? *finished : scene.since_change(WatchClock::now());
    if (!scene.curve().empty()) json["error"] = scene.curve().back().error.relative.value;
  }
  const std::lock_guard lock(mutex_);
  environment_.out << json.dump(-1, ' ', true, Json::error_handler_t::replace) << std::endl;
}

void WatchReporter::noticed(const std::string& text) {
  write_line("scenec: " + text);
}

}  // namespace scenec::runtime
