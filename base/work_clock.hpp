// Seconds that a kind of work has taken, added up by any threads.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>

namespace scenec {

class WorkClock {
 public:
  [[nodiscard]] double seconds() const { return 1e-9 * static_cast<double>(nanoseconds_.load()); }

  // Adds the time of its life; null: takes none.
  class Running {
   public:
    explicit Running(WorkClock* clock) : clock_(clock), start_(Clock::now()) {}
    ~Running() {
      if (clock_ == nullptr) return;
      clock_->nanoseconds_ +=
          std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now() - start_).count();
    }
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;

   private:
    using Clock = std::chrono::steady_clock;
    WorkClock* clock_;
    Clock::time_point start_;
  };

 private:
  std::atomic<std::int64_t> nanoseconds_{0};
};

}  // namespace scenec
