// What the daemon says outside of its pages: errors and one status line on the terminal, events as
// JSON for editors, and the picture in the file of `-o`.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "runtime/environment.hpp"
#include "runtime/options.hpp"
#include "runtime/watch/job_queue.hpp"
#include "runtime/watch/render_loop.hpp"
#include "runtime/watch/tev_client.hpp"

namespace scenec::runtime {

class WatchReporter final : public WatchListener {
 public:
  WatchReporter(const Options& options, const Environment& environment, JobQueue& jobs)
      : options_(options), environment_(environment), jobs_(jobs) {
    if (const auto& viewer = options.display_server) {
      viewer_.emplace(viewer->host, viewer->port,
                      [this](const std::string& text) { noticed(text); });
    }
  }

  void begin(const std::string& address);
  void end();

  // Of the loop's thread.
  void attempted(const WatchedScene& scene) override;
  void pictured(const WatchedScene& scene,
                const std::shared_ptr<const backend::Picture>& picture) override;

  // From any thread: about the daemon itself.
  void noticed(const std::string& text);

 private:
  void print_status(const WatchedScene& scene);
  void print_event(const WatchedScene& scene, std::string_view event);
  void write_output(const WatchedScene& scene, std::shared_ptr<const backend::Picture> picture);
  void clear_status();
  void write_line(const std::string& text);

  const Options& options_;
  const Environment& environment_;
  JobQueue& jobs_;
  std::mutex mutex_;  // of the error stream
  bool status_shown_ = false;
  std::uint32_t written_ = 0;        // generation whose first full picture is in the file of `-o`
  std::optional<TevClient> viewer_;  // last: its thread uses the others
};

}  // namespace scenec::runtime
