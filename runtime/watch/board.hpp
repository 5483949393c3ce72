// What pages are to show, newest first and only: the state of every scene (JSON) and its picture,
// and the list of the scenes where there is one. The render thread puts, the server takes; nobody
// waits for the other. Scenes keep their numbers; more may come.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace scenec::runtime {

class Board {
 public:
  using Bytes = std::shared_ptr<const std::string>;
  struct Slot {
    Bytes state{};
    std::uint64_t state_version = 0;  // 0: nothing yet
    Bytes frame{};
    std::uint64_t frame_version = 0;
    int viewers = 0;
  };

  struct List {
    Bytes bytes;  // null: there is but one scene
    std::uint64_t version = 0;
  };

  explicit Board(std::size_t scenes = 0) : slots_(scenes) {}
  [[nodiscard]] std::size_t size() const {
    const std::lock_guard lock(mutex_);
    return slots_.size();
  }
  void add_scene() {
    const std::lock_guard lock(mutex_);
    slots_.emplace_back();
  }
  // From here on pages that ask for all scenes get the list and every state, and no picture.
  void put_list(std::string list) {
    change([&] { list_ = {std::make_shared<const std::string>(std::move(list)), ++version_}; });
  }
  [[nodiscard]] List list() const {
    const std::lock_guard lock(mutex_);
    return list_;
  }

  void put_state(std::size_t scene, std::string state) {
    change([&] {
      slots_[scene].state = std::make_shared<const std::string>(std::move(state));
      slots_[scene].state_version = ++version_;
    });
  }
  void put_frame(std::size_t scene, std::string frame) {
    change([&] {
      slots_[scene].frame = std::make_shared<const std::string>(std::move(frame));
      slots_[scene].frame_version = ++version_;
    });
  }
  // Of a scene, or of all that are and come.
  void add_viewers(std::optional<std::size_t> scene, int count) {
    const std::lock_guard lock(mutex_);
    (scene ? slots_[*scene].viewers : viewers_of_all_) += count;
  }
  [[nodiscard]] Slot slot(std::size_t scene) const {
    const std::lock_guard lock(mutex_);
    Slot slot = slots_[scene];
    slot.viewers += viewers_of_all_;
    return slot;
  }
  void clear(std::size_t scene) {
    const std::lock_guard lock(mutex_);
    slots_[scene] = {.viewers = slots_[scene].viewers};
  }

  // Called after every change, on the thread that made it.
  void on_change(std::function<void()> listener) {
    const std::lock_guard lock(mutex_);
    listener_ = std::move(listener);
  }

 private:
  template <class F>
  void change(F&& f) {
    std::function<void()> listener;
    {
      const std::lock_guard lock(mutex_);
      f();
      listener = listener_;
    }
    if (listener) listener();
  }

  mutable std::mutex mutex_;
  std::vector<Slot> slots_;
  List list_;
  int viewers_of_all_ = 0;
  std::uint64_t version_ = 0;
  std::function<void()> listener_;
};

}  // namespace scenec::runtime
