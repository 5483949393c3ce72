// SIGINT, SIGTERM and SIGHUP as a stop request. Before allow_graceful_stop() the first signal ends
// the process at once (there is nothing to save); after it the first asks for a stop and the second
// ends the process. Make one before any thread is started: threads inherit the blocked signals.
#pragma once

#include <atomic>
#include <stop_token>
#include <thread>

namespace scenec::runtime {

class SignalWatch {
 public:
  enum class Mode { watch, ignore };  // `ignore`: inside a test or another program
  explicit SignalWatch(Mode mode);
  ~SignalWatch();
  SignalWatch(const SignalWatch&) = delete;
  SignalWatch& operator=(const SignalWatch&) = delete;

  void allow_graceful_stop() { graceful_ = true; }
  [[nodiscard]] std::stop_token stop() const { return source_.get_token(); }
  // The signal that asked for the stop, or 0.
  [[nodiscard]] int signal_received() const { return received_; }

 private:
  void wait_for_signals();

  std::stop_source source_;
  std::atomic<bool> graceful_ = false;
  std::atomic<int> received_ = 0;
  int signal_descriptor_ = -1;
  int wake_descriptor_ = -1;
  std::thread thread_;
};

}  // namespace scenec::runtime
