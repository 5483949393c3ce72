// When a burst of changes is over. Editors write in steps and "save all" writes several files; a
// picture of half of them helps nobody. Times come from the caller: nothing here looks at a clock.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <set>
#include <string>

namespace scenec::runtime {

class Settle {
 public:
  using Time = std::chrono::steady_clock::time_point;
  using Duration = std::chrono::steady_clock::duration;

  struct Limits {
    Duration quiet = std::chrono::milliseconds(30);
    // After, and in, bursts over several files, and while a file is missing: it is probably about
    // to be put back.
    Duration quiet_after_burst = std::chrono::milliseconds(100);
    Duration most = std::chrono::seconds(1);
  };
  Settle() = default;
  explicit Settle(Limits limits) : limits_(limits) {}

  enum class Touch {
    changed,  // an event after which the file may be whole
    writing,  // somebody has written to it and not closed it yet
    closed,   // ... and has closed it now
    missing,  // it is gone, for now
  };
  void touch(const std::string& path, Touch touch, Time now);

  [[nodiscard]] bool pending() const { return first_.has_value(); }
  // When to call `take`; nothing while nothing is pending.
  [[nodiscard]] std::optional<Time> deadline() const;

  struct Burst {
    std::set<std::string> paths{};
    Time first;  // of its events
    Time last;
    bool forced = false;  // the longest wait was over; the files may still be changing
  };
  // Ends the burst. Precondition: pending().
  [[nodiscard]] Burst take(Time now);

 private:
  [[nodiscard]] Duration quiet() const;

  Limits limits_{};
  std::optional<Time> first_;
  Time last_{};
  std::set<std::string> paths_;
  std::set<std::string> writing_;
  std::set<std::string> missing_;
  bool last_was_wide_ = false;  // the burst before went over several files
};

}  // namespace scenec::runtime
