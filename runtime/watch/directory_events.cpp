#include "runtime/watch/directory_events.hpp"

#include <sys/inotify.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <utility>

namespace scenec::runtime {

namespace {

constexpr std::uint32_t entry_events = IN_CREATE | IN_DELETE | IN_MOVED_FROM | IN_MOVED_TO |
                                       IN_ATTRIB | IN_DELETE_SELF | IN_MOVE_SELF | IN_ONLYDIR;
constexpr std::uint32_t write_events = entry_events | IN_MODIFY | IN_CLOSE_WRITE;

std::uint32_t mask_of(Attention attention) {
  return attention == Attention::writes ? write_events : entry_events;
}

DirectoryEvent::Kind kind_of(std::uint32_t mask) {
  using enum DirectoryEvent::Kind;
  if ((mask & (IN_DELETE_SELF | IN_MOVE_SELF | IN_UNMOUNT | IN_IGNORED)) != 0) return lost;
  if ((mask & IN_CLOSE_WRITE) != 0) return closed;
  if ((mask & IN_MODIFY) != 0) return written;
  if ((mask & IN_MOVED_TO) != 0) return moved_here;
  if ((mask & IN_CREATE) != 0) return created;
  if ((mask & (IN_DELETE | IN_MOVED_FROM)) != 0) return gone;
  return attributes;
}

}  // namespace

DirectoryEvents::DirectoryEvents() : queue_(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC)) {}

std::vector<std::string> DirectoryEvents::watch(
    const std::map<std::string, Attention>& directories) {
  std::vector<std::string> refused;
  std::map<std::string, Watch> kept;
  for (const auto& [directory, attention] : directories) {
    // Asked again even where nothing changed: the path may lead to another directory by now.
    const int number = ::inotify_add_watch(queue_.number(), directory.c_str(), mask_of(attention));
    if (number >= 0) {
      kept[directory] = {number, attention};
    } else if (errno == ENOSPC || errno == ENOMEM) {
      refused.push_back(directory);
    }
  }
  std::map<int, std::string> numbers;
  for (const auto& [directory, watch] : kept) numbers[watch.number] = directory;
  for (const auto& [number, directory] : directories_) {
    if (!numbers.contains(number)) ::inotify_rm_watch(queue_.number(), number);
  }
  watches_ = std::move(kept);
  directories_ = std::move(numbers);
  return refused;
}

DirectoryEvents::Batch DirectoryEvents::read() {
  Batch batch;
  alignas(inotify_event) std::array<char, 16384> buffer;
  while (true) {
    const ssize_t size = ::read(queue_.number(), buffer.data(), buffer.size());
    if (size < 0 && errno == EINTR) continue;
    if (size <= 0) return batch;
    for (std::size_t at = 0; at < static_cast<std::size_t>(size);) {
      inotify_event event{};
      std::memcpy(&event, buffer.data() + at, sizeof event);
      const char* const name = buffer.data() + at + sizeof event;
      at += sizeof event + event.len;
      if ((event.mask & IN_Q_OVERFLOW) != 0) batch.overflow = true;
      const auto directory = directories_.find(event.wd);
      if (directory == directories_.end()) continue;  // no longer of interest
      batch.events.push_back({kind_of(event.mask), directory->second,
                              event.len == 0 ? std::string{} : std::string(name)});
    }
  }
}

}  // namespace scenec::runtime
