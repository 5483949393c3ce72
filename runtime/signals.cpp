#include "runtime/signals.hpp"

#include <poll.h>
#include <signal.h>
#include <sys/eventfd.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>

namespace scenec::runtime {

namespace {

sigset_t watched_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  // Under nohup it stays ignored.
  struct sigaction hang_up{};
  if (::sigaction(SIGHUP, nullptr, &hang_up) == 0 && hang_up.sa_handler != SIG_IGN)
    sigaddset(&signals, SIGHUP);
  return signals;
}

}  // namespace

SignalWatch::SignalWatch(Mode mode) {
  if (mode == Mode::ignore) return;
  const sigset_t signals = watched_signals();
  signal_descriptor_ = ::signalfd(-1, &signals, SFD_CLOEXEC);
  wake_descriptor_ = ::eventfd(0, EFD_CLOEXEC);
  // Without descriptors the signals keep their usual effect: they end the process.
  if (signal_descriptor_ < 0 || wake_descriptor_ < 0) return;
  ::pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  // A reader of our messages that goes away must not end a long render.
  ::signal(SIGPIPE, SIG_IGN);
  thread_ = std::thread([this] { wait_for_signals(); });
}

SignalWatch::~SignalWatch() {
  if (thread_.joinable()) {
    const std::uint64_t one = 1;
    while (::write(wake_descriptor_, &one, sizeof one) < 0 && errno == EINTR) {
    }
    thread_.join();
  }
  if (signal_descriptor_ >= 0) ::close(signal_descriptor_);
  if (wake_descriptor_ >= 0) ::close(wake_descriptor_);
}

void SignalWatch::wait_for_signals() {
  while (true) {
    std::array<pollfd, 2> waiting{pollfd{signal_descriptor_, POLLIN, 0},
                                  pollfd{wake_descriptor_, POLLIN, 0}};
    if (::poll(waiting.data(), waiting.size(), -1) < 0) {
      if (errno == EINTR) continue;
      return;
    }
    if (waiting[1].revents != 0) return;
    signalfd_siginfo info{};
    if (::read(signal_descriptor_, &info, sizeof info) != sizeof info) continue;
    const int number = static_cast<int>(info.ssi_signo);
    if (!graceful_ || received_ != 0) ::_exit(128 + number);
    received_ = number;
    source_.request_stop();
  }
}

}  // namespace scenec::runtime
