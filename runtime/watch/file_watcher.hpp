// Waits for changes of the files that scenes are made from and says which scenes they concern, once
// a burst of changes is over and only if bytes have changed. Where the system's notification falls
// short (its limits, files of other machines) it looks at the files itself and says so.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "base/file_descriptor.hpp"
#include "base/file_system.hpp"
#include "runtime/watch/directory_events.hpp"
#include "runtime/watch/settle.hpp"
#include "runtime/watch/tracked_files.hpp"

namespace scenec::runtime {

struct FilesSettled {
  std::set<std::size_t> changed;  // scenes whose files are others now
  std::set<std::size_t> touched;  // scenes whose files were touched, changed or not
  Settle::Time first;             // of the events
  Settle::Time last;
  bool forced = false;  // the longest wait was over: somebody may still be writing
};

struct WatcherOptions {
  Settle::Limits settle{};
  bool poll = false;  // look at the files only; do not ask the system
  std::chrono::milliseconds poll_every{1000};
};

class FileWatcher {
 public:
  using Listener = std::function<void(const FilesSettled&)>;
  using Notice = std::function<void(const std::string&)>;
  // Both are called on the watcher's thread.
  FileWatcher(WatcherOptions options, Listener listener, Notice notice);
  ~FileWatcher();
  FileWatcher(const FileWatcher&) = delete;
  FileWatcher& operator=(const FileWatcher&) = delete;

  // What the scene has read and missed in its last run; takes effect soon after.
  void watch(std::size_t scene, std::vector<FileRecord> files);

  // Returns when all that has been given to watch() is watched.
  void wait_until_armed();

  // Whether a burst of changes is going on that concerns the scene: what is made now may be a
  // mixture, and an event will come.
  [[nodiscard]] bool is_restless(std::size_t scene) const;

 private:
  // Size, times and identity: enough to see that somebody was at a file.
  struct Signature {
    std::uint64_t words[6] = {};
    friend bool operator==(const Signature&, const Signature&) = default;
  };
  [[nodiscard]] static Signature signature_of(const std::string& path);

  void run(const std::stop_token& stop);
  void wait(Settle::Time now);
  void wake() const;
  void take_new_sets(Settle::Time now);
  void arm();
  void read_events(Settle::Time now);
  void handle(const DirectoryEvent& event, Settle::Time now);
  void touch(const std::string& path, Settle::Touch touch, Settle::Time now);
  void poll(Settle::Time now);
  void finish_burst(Settle::Time now);

  WatcherOptions options_;
  Listener listener_;
  Notice notice_;
  DirectoryEvents events_;
  Descriptor wake_;

  mutable std::mutex mutex_;
  std::map<std::size_t, std::vector<FileRecord>> new_sets_;
  std::set<std::size_t> restless_;
  bool arming_ = false;
  std::condition_variable armed_;

  // Of the thread alone.
  TrackedFiles files_;
  Settle settle_;
  bool lost_directory_ = false;
  std::map<std::string, Signature> polled_;
  Settle::Time next_poll_{};
  std::set<std::string> told_;  // notices, each once

  std::jthread thread_;
};

}  // namespace scenec::runtime
