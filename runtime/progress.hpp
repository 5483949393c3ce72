// Tells a person or a program how far the rendering is. Called from worker threads; prints at most
// ten times a second and never makes a worker wait for another.
#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>

#include "backend/backend.hpp"
#include "runtime/environment.hpp"
#include "runtime/options.hpp"

namespace scenec::runtime {

class ProgressPrinter {
 public:
  // `automatic` is one rewritten line on a terminal and one line every 10 % elsewhere.
  ProgressPrinter(ProgressStyle style, const Environment& environment);

  void update(const backend::Progress& progress);
  // Leaves the terminal's line empty.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  enum class Form : std::uint8_t { rewritten_line, plain, json, none };

  void print_rewritten(const backend::Progress& progress, Clock::time_point now);
  void print_plain(const backend::Progress& progress);
  void print_json(const backend::Progress& progress, Clock::time_point now);

  Form form_;
  std::ostream& err_;
  std::mutex mutex_;
  Clock::time_point start_;
  Clock::time_point last_;
  bool printed_ = false;
  int last_tenth_ = 0;
};

// "3 s", "4 min 10 s", "2 h 5 min".
[[nodiscard]] std::string duration_text(double seconds);
// "2.13 % ± 0.04": the relative error with half its band.
[[nodiscard]] std::string error_text(const backend::ErrorBand& error);
// "1 % in 41 s": the next lower round figure of the error and when it will be reached, as errors
// fall with the square root of the samples; empty when that cannot be told.
[[nodiscard]] std::string outlook_text(const backend::Progress& progress);

}  // namespace scenec::runtime
