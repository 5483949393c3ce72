// Work for the main thread, which has nothing else to do: whatever may wait for a disk, so that
// neither pictures nor pages wait with it.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <stop_token>
#include <string>
#include <utility>

namespace scenec::runtime {

class JobQueue {
 public:
  using Job = std::function<void()>;

  // A job with a key replaces a waiting one with the same key: only the newest counts.
  void put(Job job, std::string key = {}) {
    {
      const std::lock_guard lock(mutex_);
      if (!key.empty()) std::erase_if(jobs_, [&](const auto& one) { return one.first == key; });
      jobs_.emplace_back(std::move(key), std::move(job));
    }
    awake_.notify_all();
  }

  // Runs jobs until the stop, and then those that are left.
  void run(const std::stop_token& stop) {
    while (true) {
      Job job;
      {
        std::unique_lock lock(mutex_);
        awake_.wait(lock, stop, [&] { return !jobs_.empty(); });
        if (jobs_.empty()) return;
        job = std::move(jobs_.front().second);
        jobs_.pop_front();
      }
      job();
    }
  }

 private:
  std::mutex mutex_;
  std::condition_variable_any awake_;
  std::deque<std::pair<std::string, Job>> jobs_;
};

}  // namespace scenec::runtime
