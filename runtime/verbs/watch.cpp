// `scenec watch`: renders scenes again whenever a file they are made from changes, and shows them
// on a page of the browser.
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <limits>
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
#include "runtime/watch/scene_folder.hpp"
#include "runtime/watch/watch_reporter.hpp"

namespace scenec::runtime {

namespace {

// Folders are watched under a number that no scene has.
constexpr auto folders_owner = std::numeric_limits<std::size_t>::max();

void watch_folders(FileWatcher& watcher, const std::vector<std::string>& operands) {
  std::vector<FileRecord> listings;
  for (const std::string& operand : operands) {
    if (is_folder(operand) || is_listing(operand)) listings.push_back(listing_of(operand));
  }
  if (!listings.empty()) watcher.watch(folders_owner, std::move(listings));
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
  const bool one_scene = names == options.operands && names.size() == 1;
  if (!one_scene && !options.output.empty())
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
  Board board;
  JobQueue jobs;
  WatchReporter reporter(options, environment, jobs);
  RenderLoop loop(options, names, environment, board, reporter);
  std::optional<PreviewServer> server;
  PreviewApi api(gate, loop, jobs, [&](PreviewServer::RequestId id, HttpResponse response) {
    server->reply(id, std::move(response));
  });
  server.emplace(std::move(listening).value(), gate, board,
                 [&](PreviewServer::RequestId id, HttpRequest request) {
                   api.handle(id, std::move(request));
                 });
  FileWatcher watcher(
      {.poll = options.poll},
      [&](FilesSettled settled) {
        settled.touched.erase(folders_owner);
        if (settled.changed.erase(folders_owner) > 0) {
          loop.set_scenes(scenes_of(options.operands));
          watch_folders(watcher, options.operands);
        }
        loop.files_settled(settled);
      },
      [&](const std::string& text) {
        loop.add_notice(text);
        reporter.noticed(text);
      });
  const std::string address = fmt::format("http://127.0.0.1:{}/#token={}", gate.port, gate.token);
  reporter.begin(address);
  if (options.open_page && !open_in_browser(address))
    loop.add_notice("no browser could be opened: `xdg-open` is missing");
  signals.allow_graceful_stop();
  watch_folders(watcher, options.operands);
  loop.start(watcher);
  jobs.run(signals.stop());
  loop.stop();
  server->stop();  // before what its handler uses goes
  reporter.end();
  const int signal = signals.signal_received();
  return signal == 0 ? ExitCode::ok : static_cast<ExitCode>(128 + signal);
}

}  // namespace scenec::runtime
