// `scenec watch`: renders scenes again whenever a file they are made from changes, and shows them
// on a page of the browser.
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "runtime/output.hpp"
#include "runtime/signals.hpp"
#include "runtime/verbs.hpp"
#include "runtime/watch/file_watcher.hpp"
#include "runtime/watch/gate.hpp"
#include "runtime/watch/job_queue.hpp"
#include "runtime/watch/kept_token.hpp"
#include "runtime/watch/preview_api.hpp"
#include "runtime/watch/preview_server.hpp"
#include "runtime/watch/render_loop.hpp"
#include "runtime/watch/watch_reporter.hpp"

namespace scenec::runtime {

namespace {

namespace fs = std::filesystem;

// A folder stands for the scenes in it.
std::vector<std::string> scenes_of(const std::vector<std::string>& operands) {
  std::vector<std::string> scenes;
  for (const std::string& operand : operands) {
    std::error_code error;
    if (!fs::is_directory(operand, error)) {
      scenes.push_back(operand);
      continue;
    }
    std::vector<std::string> found;
    for (fs::directory_iterator at(operand, error), end; !error && at != end; at.increment(error)) {
      if (extension_of(at->path().string()) == ".sdl" && at->is_regular_file(error))
        found.push_back(at->path().string());
    }
    std::sort(found.begin(), found.end());
    scenes.insert(scenes.end(), found.begin(), found.end());
  }
  return scenes;
}

std::vector<Options> options_by_scene(const Options& options,
                                      const std::vector<std::string>& scenes) {
  std::vector<Options> result;
  for (const std::string& scene : scenes) {
    result.push_back(options);
    result.back().operands = {scene};
  }
  return result;
}

ExitCode refuse(const Environment& environment, const std::string& message, ExitCode code) {
  environment.err << "scenec: " << message << '\n';
  return code;
}

bool open_in_browser(std::string address) {
  std::string program = "xdg-open";
  char* const words[] = {program.data(), address.data(), nullptr};
  pid_t child = 0;
  if (::posix_spawnp(&child, program.c_str(), nullptr, nullptr, words, environ) != 0) return false;
  // Nobody waits for it: it belongs to the desktop from here on.
  std::thread([child] { ::waitpid(child, nullptr, 0); }).detach();
  return true;
}

// Of the port asked for, or of the usual one if it is free, or of any.
Result<Listening, std::string> listen(const Options& options) {
  constexpr std::uint16_t usual_port = 7727;
  if (options.port) return listen_on_loopback(static_cast<std::uint16_t>(*options.port));
  auto usual = listen_on_loopback(usual_port);
  return usual ? std::move(usual) : listen_on_loopback(0);
}

}  // namespace

ExitCode verbs::watch(const Options& options, const Environment& environment) {
  SignalWatch signals(environment.handle_signals ? SignalWatch::Mode::watch
                                                 : SignalWatch::Mode::ignore);
  const std::vector<std::string> names = scenes_of(options.operands);
  if (names.empty())
    return refuse(environment, "there is no `.sdl` file in the folder", ExitCode::usage);
  if (names.size() > 1 && !options.output.empty())
    return refuse(environment, "`-o` takes the picture of one scene", ExitCode::usage);
  if (!options.output.empty()) {
    DiagnosticSink sink;
    if (!check_picture_output(options.output, sink))
      return refuse(environment, sink.sorted().front().message, ExitCode::file_error);
  }
  auto listening = listen(options);
  if (!listening) return refuse(environment, listening.error(), ExitCode::file_error);

  const Gate gate{.port = listening.value().port,
                  .token = kept_token(environment, listening.value().port)};
  Board board(names.size());
  JobQueue jobs;
  WatchReporter reporter(options, environment, jobs);
  RenderLoop loop(options_by_scene(options, names), environment, board, reporter);
  std::optional<PreviewServer> server;
  PreviewApi api(gate, loop, jobs, [&](PreviewServer::RequestId id, HttpResponse response) {
    server->reply(id, std::move(response));
  });
  server.emplace(std::move(listening).value(), gate, board,
                 [&](PreviewServer::RequestId id, HttpRequest request) {
                   api.handle(id, std::move(request));
                 });
  FileWatcher watcher(
      {.poll = options.poll}, [&](const FilesSettled& settled) { loop.files_settled(settled); },
      [&](const std::string& text) {
        loop.add_notice(text);
        reporter.noticed(text);
      });
  const std::string address = fmt::format("http://127.0.0.1:{}/#token={}", gate.port, gate.token);
  reporter.begin(address);
  if (options.open_page && !open_in_browser(address))
    loop.add_notice("no browser could be opened: `xdg-open` is missing");
  signals.allow_graceful_stop();
  loop.start(watcher);
  jobs.run(signals.stop());
  loop.stop();
  reporter.end();
  const int signal = signals.signal_received();
  return signal == 0 ? ExitCode::ok : static_cast<ExitCode>(128 + signal);
}

}  // namespace scenec::runtime
