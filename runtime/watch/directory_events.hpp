// What the system tells of changes in directories (inotify). Directories are watched, never files:
// a watch on a file dies with the first editor that saves by renaming. Events are hints, to be
// checked against the disk.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "base/file_descriptor.hpp"

namespace scenec::runtime {

enum class Attention : std::uint8_t {
  entries,  // what comes and goes
  writes,   // and who writes to its files
};

struct DirectoryEvent {
  enum class Kind : std::uint8_t {
    created,  // opened for the first time, or a link
    written,  // not closed yet
    closed,
    moved_here,
    gone,
    attributes,  // with an empty name: of the directory itself
    lost,        // the directory itself is gone or elsewhere; its path must be looked up again
  };
  Kind kind = Kind::attributes;
  std::string directory;
  std::string name;  // empty: the directory itself
};

class DirectoryEvents {
 public:
  DirectoryEvents();

  // False where the system has no more of these to give.
  [[nodiscard]] bool valid() const { return queue_.valid(); }
  // To wait on.
  [[nodiscard]] int descriptor() const { return queue_.number(); }

  // Watches exactly these directories from now on, each as its path leads there now. Returns those
  // for which the system had no watch left; missing ones are none of them.
  [[nodiscard]] std::vector<std::string> watch(const std::map<std::string, Attention>& directories);
  [[nodiscard]] std::size_t watch_count() const { return watches_.size(); }

  struct Batch {
    std::vector<DirectoryEvent> events;
    bool overflow = false;  // events were lost: everything may have changed
  };
  // What has happened since; never blocks.
  [[nodiscard]] Batch read();

 private:
  struct Watch {
    int number = -1;
    Attention attention = Attention::entries;
  };
  Descriptor queue_;
  std::map<std::string, Watch> watches_;
  std::map<int, std::string> directories_;
};

}  // namespace scenec::runtime
